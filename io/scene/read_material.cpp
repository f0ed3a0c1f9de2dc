// The [material] section, or several [[material]]: regions, elastic constants, the keys of each law, the hardening curve.
#include <cmath>

#include "io/scene/scene_sections.hpp"
#include "kernels/materials/material.hpp"

namespace nanson {

namespace {

/// Point i of the curve: "must ..." when it is wrong, empty when it is right.
std::string point_problem(const std::vector<std::pair<double, double>>& before, double eps_p, double tau_y) {
  if (before.empty()) return eps_p == 0 && tau_y > 0 ? "" : "must start the curve: eps_p = 0, tau_y above 0";
  if (!(eps_p > before.back().first))
    return fmt::format("must come after the point at eps_p = {}", before.back().first);
  return tau_y >= before.back().second
             ? ""
             : fmt::format("softens: tau_y must be at least {}, that of the point before", before.back().second);
}

/// [[eps_p, tau_y], ...].
void read_hardening(Table& t, std::vector<std::pair<double, double>>& points) {
  Diagnostics& d = t.diagnostics();
  const toml::node* node = t.find(key("material.hardening"));
  const auto* list = node->as_array();
  if (!list || list->size() < 2 || list->size() > hardening_points)
    return t.fail("hardening", fmt::format("must be a list of 2 to {} points [eps_p, tau_y]", hardening_points));
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& point = (*list)[i];
    const std::string path = fmt::format("{}.{}", t.path("hardening"), i);
    const auto* pair = point.as_array();
    double eps_p = 0, tau_y = 0;
    if (!pair || pair->size() != 2) {
      report(d, point, path, "must be two numbers [eps_p, tau_y]");
    } else if (read_value(d, (*pair)[0], path + ".0", eps_p) && read_value(d, (*pair)[1], path + ".1", tau_y)) {
      const std::string why = point_problem(points, eps_p, tau_y);
      if (!why.empty()) report(d, point, path, why);
      points.emplace_back(eps_p, tau_y);
    }
  }
}

/// yield_stress with hardening_modulus, or a curve that says both.
void read_plasticity(Table& t, MaterialSpec& m) {
  const bool modulus = t.has("hardening_modulus"), curve = t.has("hardening");
  if (!modulus && !curve)
    t.missing({"hardening_modulus", "hardening"},
              t.path("hardening_modulus") + ": exactly one of hardening_modulus | hardening is needed");
  if (modulus && curve) t.fail("hardening", "stands beside hardening_modulus, exactly one of them is allowed");
  t.read(key("material.hardening_modulus"), m.hardening_modulus);
  if (curve && !modulus) read_hardening(t, m.hardening);
  const bool yield = t.read(key("material.yield_stress"), m.yield_stress);
  if (!curve) {
    if (!t.has("yield_stress")) t.missing({"yield_stress"}, t.path("yield_stress") + ": is missing");
  } else if (yield && t.has("yield_stress") && !m.hardening.empty() && m.yield_stress != m.hardening[0].second) {
    t.fail("yield_stress", fmt::format("is not the curve's first tau_y, {}: leave it out", m.hardening[0].second));
  }
}

void read_material(Table& t, MaterialSpec& m) {
  const bool law = read_kind(t, key("material.law"), m.law);
  t.read(key("material.density"), m.density);
  const bool young = t.read(key("material.youngs_modulus"), m.youngs_modulus);
  const bool poisson = t.read(key("material.poissons_ratio"), m.poissons_ratio);
  if (law && m.law == Law::mooney_rivlin && t.read(key("material.xi"), m.xi) && young && poisson) {
    const double limit = m.youngs_modulus / (2 * (1 + m.poissons_ratio))
                         / (3 * std::sqrt(3.0));  // 2 zeta = mu - 3 sqrt(3) xi stays positive
    if (!(m.xi < limit)) t.fail("xi", fmt::format("must be below mu / (3 sqrt(3)) = {:.6g}", limit));
  }
  if (law && m.law == Law::hencky_j2) read_plasticity(t, m);
  t.read(key("material.volumetric"), m.volumetric);
  t.read(key("material.isochoric"), m.isochoric);
}

/// No region twice.
void check_shared_regions(const std::vector<Word>& regions, Diagnostics& d) {
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (regions[k].text == regions[i].text) {
        report(d, regions[i], fmt::format("has the material of {} already", where(d, regions[k].place)));
        break;
      }
}

}  // namespace

void read_materials(Table& root, Scene& s) {
  const toml::node* node = root.find(key("material"));
  if (!node) return;
  if (!node->is_array())
    return root.section(key("material"), [&](Table& t) {
      if (t.has("region")) t.fail("region", "is a key of [[material]] only, [material] is that of the whole mesh");
      read_material(t, s.material);
    });
  std::vector<Word> regions;
  root.list(key("material"), [&](Table& t) {
    MaterialSpec m;
    std::vector<Word> own;
    read_names(t, key("material.region"), own);
    if (!t.has("region")) t.missing({"region"}, t.path("region") + ": is missing");
    for (const Word& w : own) m.regions.push_back({w.text, where(t.diagnostics(), w.place)});
    regions.insert(regions.end(), own.begin(), own.end());
    read_material(t, m);
    s.materials.push_back(std::move(m));
  });
  check_shared_regions(regions, root.diagnostics());
  if (s.materials.empty())
    return root.fail("material", "must be a table [material], or a list of at least one [[material]]");
  s.material = s.materials[0];
  if (s.materials.size() == 1) s.materials.clear();
}

}  // namespace nanson
