// Groups of nodes, their densities and impedances, and the means of the laws on interfaces.
#include "engine/mixture.hpp"

#include <algorithm>
#include <map>

#include "engine/input_error.hpp"
#include "engine/material.hpp"

namespace nanson {
namespace {

std::vector<int> materials_at(const double* volume, int materials) {
  std::vector<int> present;
  for (int r = 0; r < materials; ++r)
    if (volume[r] > 0) present.push_back(r);
  return present;
}

std::vector<MaterialLaw> make_laws(const Scene& scene) {
  std::vector<MaterialLaw> laws;
  for (const MaterialSpec& m : scene.materials) {
    MaterialLaw law;
    law.constants = constants_of(m, scene.physics);
    law.has_state = law_traits(m.law).has_state;
    law.rho_cp = law.constants.rho * law.constants.cp;
    law.rho_cs = law.constants.rho * law.constants.cs;
    if (scene.physics.formulation == Formulation::pFp) law.rho_cp = law.rho_cs;  // no pressure waves
    law.rho_cJ = law.constants.rho * law.constants.cJ;
    law.functions = find_part_functions(scene.physics, m);
    laws.push_back(law);
  }
  return laws;
}

/// Rows in order: every part, and in it every group, padded at its end.
void find_runs(Mixture& m, const Order& order, const std::vector<int>& group) {
  m.group.resize(static_cast<std::size_t>(order.rows));
  for (int n = 0; n < order.rows; ++n) {
    const int node = order.node_of[static_cast<std::size_t>(n)];
    m.group[static_cast<std::size_t>(n)] = node >= 0 ? group[static_cast<std::size_t>(node)]
                                                     : m.group[static_cast<std::size_t>(n - 1)];
  }
  for (const Part& part : order.parts) {
    m.first_run.push_back(static_cast<int>(m.runs.size()));
    for (int n = part.node_begin; n < part.node_end; ++n) {
      const int g = m.group[static_cast<std::size_t>(n)];
      if (n == part.node_begin || g != m.runs.back().group) m.runs.push_back({n, n, 0, g});
      m.runs.back().end = n + 1;
      m.runs.back().nodes += order.node_of[static_cast<std::size_t>(n)] >= 0;
    }
  }
  m.first_run.push_back(static_cast<int>(m.runs.size()));
}

void find_shares(Mixture& m, const Order& order, const std::vector<double>& volume) {
  const std::size_t rows = static_cast<std::size_t>(order.rows), laws = m.laws.size();
  m.share.assign(laws, Aligned<double>(rows, 0.0));
  m.rho.assign(rows, 0.0);
  for (std::size_t n = 0; n < rows; ++n) {
    const std::vector<int>& present = m.groups[static_cast<std::size_t>(m.group[n])];
    const int node = order.node_of[n];
    double total = 0;
    for (std::size_t r = 0; r < laws && node >= 0; ++r) total += volume[laws * static_cast<std::size_t>(node) + r];
    for (const int law : present) {
      const std::size_t r = static_cast<std::size_t>(law);
      m.share[r][n] = present.size() == 1 ? 1
                      : node < 0          ? 1.0 / static_cast<double>(present.size())
                                          : volume[laws * static_cast<std::size_t>(node) + r] / total;
      m.rho[n] += m.share[r][n] * m.laws[r].constants.rho;
    }
  }
}

/// Volume-weighted mean over the laws at a row.
template <class Value>
double mean_at(const Mixture& m, std::size_t n, Value value) {
  double sum = 0;
  for (const int law : m.groups[static_cast<std::size_t>(m.group[n])])
    sum += m.share[static_cast<std::size_t>(law)][n] * value(m.laws[static_cast<std::size_t>(law)]);
  return sum;
}

/// rho c_p, rho c_s and, with an energy of the parting, rho c_J of an edge: means of its two nodes. Padding edges are never used, but their lanes are computed.
void find_impedances(const Mixture& m, Order& o) {
  const std::size_t edges = static_cast<std::size_t>(o.out.back());
  o.rho_cp.assign(o.a.size(), 1.0);
  o.rho_cs.assign(o.a.size(), 1.0);
  const bool parted = std::ranges::any_of(m.laws, [](const MaterialLaw& l) { return l.constants.parting > 0; });
  if (parted) o.rho_cJ.assign(o.a.size(), 1.0);
  for (std::size_t e = 0; e < edges; ++e) {
    const std::size_t a = static_cast<std::size_t>(o.a[e]), b = static_cast<std::size_t>(o.b[e]);
    const auto mean = [&](auto value) { return 0.5 * (mean_at(m, a, value) + mean_at(m, b, value)); };
    o.rho_cp[e] = mean([](const MaterialLaw& l) { return l.rho_cp; });
    o.rho_cs[e] = mean([](const MaterialLaw& l) { return l.rho_cs; });
    if (parted) o.rho_cJ[e] = mean([](const MaterialLaw& l) { return l.rho_cJ; });
  }
}

/// The stress sweep bounds a node's step by its own waves; across an edge to a harder or denser node D^p acts with the speed rho c_p(edge)/rho(node), D^J with
/// (kappa + M)(node)/rho c_J(edge). Where these are larger, the length of the node's step is shortened by as much.
void shorten_steps(const Mixture& m, const Order& o, bool projected, Aligned<double>& step_length) {
  std::vector<double> excess(static_cast<std::size_t>(o.rows), 1.0);
  const double* rho_cJ = o.edges().rho_cJ;
  const auto visit = [&](std::size_t n, std::size_t e) {
    double c = 0, of_J = 0;  // of the law's own waves, and of its J
    for (const int law : m.groups[static_cast<std::size_t>(m.group[n])]) {
      const MaterialLaw& own = m.laws[static_cast<std::size_t>(law)];
      c = std::max(c, projected ? own.constants.cs : own.constants.cp);
      of_J = std::max({of_J, c, (own.constants.kappa + own.constants.parting) / own.rho_cJ});
    }
    excess[n] = std::max(excess[n], o.rho_cp[e] / (m.rho[n] * c));
    if (projected) return;
    const double kappa = mean_at(m, n, [](const MaterialLaw& l) { return l.constants.kappa + l.constants.parting; });
    excess[n] = std::max(excess[n], kappa / (rho_cJ[e] * of_J));
  };
  for (std::size_t e = 0; e < static_cast<std::size_t>(o.out.back()); ++e) {
    visit(static_cast<std::size_t>(o.a[e]), e);
    visit(static_cast<std::size_t>(o.b[e]), e);
  }
  for (std::size_t n = 0; n < excess.size(); ++n) step_length[n] /= excess[n];
}

/// Where laws with a state meet at a node, each of them keeps its states in a set of rows of its own.
void find_states(Mixture& m, std::ptrdiff_t rows) {
  const auto has_state = [&](int law) { return m.laws[static_cast<std::size_t>(law)].has_state; };
  const bool meet = std::ranges::any_of(
      m.groups, [&](const std::vector<int>& present) { return std::ranges::count_if(present, has_state) > 1; });
  if (!meet) return;
  m.state_sets = 0;
  for (MaterialLaw& law : m.laws)
    if (law.has_state) law.states = rows * m.state_sets++;
}

/// The rows that a law keeps its states in.
Rows rows_of_law(const MaterialLaw& law, Rows rows) {
  rows.plastic += row::plastic * law.states;
  if (rows.plastic_new) rows.plastic_new += row::plastic * law.states;
  return rows;
}

Coefficients of_law(Coefficients k, const MaterialLaw& law) {
  k.material = law.constants;
  k.rho_cp = law.rho_cp;
  k.rho_cs = law.rho_cs;
  k.rho_cJ = law.rho_cJ;
  return k;
}

Part part_of(int begin, int end) {
  Part part{};
  part.node_begin = begin;
  part.node_end = end;
  return part;
}

/// {X, 1/Omega_a,r}: a run's rows as material r alone sees them. Returns what stands for row 0.
const double* rows_of_material(const MaterialRun& run, int end, const Rows& rows, const Aligned<double>& share,
                               double* out) {
  for (int n = run.begin; n < end; ++n) {
    double* X = out + row::X * (n - run.begin);
    store4(X, load4(rows.X + row::X * n));
    X[3] /= share[static_cast<std::size_t>(n)];
  }
  return out - row::X * static_cast<std::ptrdiff_t>(run.begin);
}

}  // namespace

std::vector<int> material_of_regions(const Scene& scene, const Mesh& mesh) {
  std::vector<int> material(mesh.region_names.size(), -1);
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    for (const Named& region : scene.materials[m].regions)
      for (std::size_t r = 0; r < material.size(); ++r)
        if (mesh.region_names[r] == region.name) material[r] = static_cast<int>(m);
  return material;
}

NodeMaterials node_materials(const Scene& scene, const Mesh& mesh) {
  NodeMaterials out;
  if (scene.materials.empty()) return out;
  const std::vector<int> material = material_of_regions(scene, mesh);
  for (const int region : mesh.tet_region)
    if (material[static_cast<std::size_t>(region)] < 0)
      throw InputError("region " + mesh.region_names[static_cast<std::size_t>(region)] + " has no material");
  out.materials = static_cast<int>(scene.materials.size());
  const std::size_t m = scene.materials.size();
  out.volume.assign(m * mesh.X.size(), 0.0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& tet = mesh.tets[t];
    const double quarter = 0.25 * tet_volume(mesh.X[tet[0]], mesh.X[tet[1]], mesh.X[tet[2]], mesh.X[tet[3]]);
    for (const int n : tet)
      out.volume[m * static_cast<std::size_t>(n)
                 + static_cast<std::size_t>(material[static_cast<std::size_t>(mesh.tet_region[t])])] += quarter;
  }
  std::map<std::vector<int>, int> known;
  const auto number = [&](const std::vector<int>& present) {
    const auto [at, added] = known.try_emplace(present, static_cast<int>(out.groups.size()));
    if (added) out.groups.push_back(present);
    return at->second;
  };
  for (int r = 0; r < out.materials; ++r) number({r});
  for (std::size_t n = 0; n < mesh.X.size(); ++n)
    out.group.push_back(number(materials_at(&out.volume[m * n], out.materials)));
  return out;
}

std::vector<double> tet_stiffness_of_nodes(const Scene& scene, const NodeMaterials& nodes, std::size_t count) {
  if (scene.physics.tet_stiffness == 0) return {};
  if (nodes.volume.empty())
    return std::vector<double>(count, constants_of(scene.material, scene.physics).tet_stiffness);
  const std::size_t materials = scene.materials.size();
  std::vector<double> modulus(count);
  for (std::size_t n = 0; n < count; ++n) {
    double sum = 0, total = 0;
    for (std::size_t r = 0; r < materials; ++r) {
      const double volume = nodes.volume[materials * n + r];
      sum += volume * constants_of(scene.materials[r], scene.physics).tet_stiffness;
      total += volume;
    }
    modulus[n] = sum / total;
  }
  return modulus;
}

Mixture make_mixture(const Scene& scene, const NodeMaterials& nodes, Order& order, Aligned<double>& step_length) {
  Mixture m;
  if (nodes.group.empty()) return m;
  m.laws = make_laws(scene);
  m.groups = nodes.groups;
  find_runs(m, order, nodes.group);
  find_shares(m, order, nodes.volume);
  find_impedances(m, order);
  shorten_steps(m, order, scene.physics.formulation == Formulation::pFp, step_length);
  find_states(m, order.rows);
  return m;
}

PartReport mixed_stress(const Mixture& m, const MaterialRun& run, const Rows& rows, const Coefficients& k,
                        const double* step_length, double* scratch) {
  const Part part = part_of(run.begin, run.end);
  const std::vector<int>& present = m.groups[static_cast<std::size_t>(run.group)];
  if (present.size() == 1) {
    const MaterialLaw& law = m.laws[static_cast<std::size_t>(present[0])];
    return law.functions.stress(part, rows_of_law(law, rows), of_law(k, law), step_length);
  }
  const int count = run.end - run.begin;
  double *PH = scratch, *W = PH + row::PH * count, *X = W + row::W * count;
  PartReport report;
  for (const int r : present) {
    const MaterialLaw& law = m.laws[static_cast<std::size_t>(r)];
    const Aligned<double>& share = m.share[static_cast<std::size_t>(r)];
    Rows mine = rows_of_law(law, rows);
    mine.PH_new = PH - row::PH * static_cast<std::ptrdiff_t>(run.begin);
    mine.W_new = W - row::W * static_cast<std::ptrdiff_t>(run.begin);
    mine.X = rows_of_material(run, run.end, rows, share, X);
    Coefficients own_k = of_law(k, law);
    own_k.streams = false;  // read again at once
    const PartReport own = law.functions.stress(part, mine, own_k, step_length);
    report.fastest = std::max(report.fastest, own.fastest);
    report.broken = report.broken || own.broken;
    report.plastic_work += own.plastic_work;
    const bool first = r == present.front();
    for (int n = run.begin; n < run.end; ++n) {
      const double w = share[static_cast<std::size_t>(n)];
      const auto add = [&](double* sum, const double* term, Vec4 weight) {
        store4(sum, first ? weight * load4(term) : fma(weight, load4(term), load4(sum)));
      };
      for (int i = 0; i < row::PH; i += 4)
        add(rows.PH_new + row::PH * n + i, mine.PH_new + row::PH * n + i, broadcast4(w));
      const double Sigma_J = first ? 0.0 : rows.W_new[row::W * n + 3];
      store4(rows.W_new + row::W * n, load4(mine.W_new + row::W * n));
      rows.W_new[row::W * n + 3] = Sigma_J + w * mine.W_new[row::W * n + 3];
      for (int I = 0; I < 3; ++I)  // the displacement is no mean
        rows.PH_new[row::PH * n + 8 * I + 7] = mine.PH_new[row::PH * n + 8 * I + 7];
    }
  }
  return report;
}

double mixed_energy(const Mixture& m, const MaterialRun& run, const Rows& rows, const Coefficients& k) {
  const int end = run.begin + run.nodes;
  const std::vector<int>& present = m.groups[static_cast<std::size_t>(run.group)];
  Aligned<double> X(static_cast<std::size_t>(row::X * (run.nodes + 7)), 0.0);  // read eight nodes at a time
  double sum = 0;
  for (const int r : present) {
    const MaterialLaw& law = m.laws[static_cast<std::size_t>(r)];
    Rows mine = rows_of_law(law, rows);
    if (present.size() > 1) mine.X = rows_of_material(run, end, rows, m.share[static_cast<std::size_t>(r)], X.data());
    sum += law.functions.strain_energy(part_of(run.begin, end), mine, of_law(k, law));
  }
  return sum;
}

Aligned<double> means_of_rows(const Mixture& m, double (*value)(const MaterialLaw&)) {
  Aligned<double> means(m.group.size());
  for (std::size_t n = 0; n < means.size(); ++n) means[n] = mean_at(m, n, value);
  return means;
}

double mean_at(const Mixture& m, int n, double MaterialConstants::*constant) {
  return mean_at(m, static_cast<std::size_t>(n), [&](const MaterialLaw& l) { return l.constants.*constant; });
}

double plastic_strain(const Mixture& m, const Aligned<double>& plastic, int n) {
  const auto of = [&](std::ptrdiff_t states) {
    return plastic[static_cast<std::size_t>(row::plastic * (states + n) + 3)];
  };
  if (m.empty()) return of(0);
  double sum = 0;
  for (const int r : m.groups[static_cast<std::size_t>(m.group[static_cast<std::size_t>(n)])]) {
    const MaterialLaw& law = m.laws[static_cast<std::size_t>(r)];
    if (law.has_state) sum += m.share[static_cast<std::size_t>(r)][static_cast<std::size_t>(n)] * of(law.states);
  }
  return sum;
}

std::size_t mixture_bytes(const Mixture& m, const Order& order) {
  std::size_t doubles = m.rho.size() + order.rho_cp.size() + order.rho_cs.size() + order.rho_cJ.size();
  for (const auto& s : m.share) doubles += s.size();
  return 8 * doubles + 4 * m.group.size();
}

}  // namespace nanson
