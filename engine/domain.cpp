// Set-up of all that a run does not change: dual, order, nodes, supports and loads, materials, part functions.
#include "engine/domain.hpp"

#include <cmath>

#include "engine/input_error.hpp"
#include "engine/material.hpp"
#include "engine/node_geometry.hpp"

namespace nanson {
namespace {

constexpr double identity_tolerance = 1e-10;  // round-off on flat tets stays far below

Dual checked_dual(const Mesh& mesh, const std::vector<double>& tet_stiffness) {
  Dual dual = make_dual(mesh, tet_stiffness);
  const DualDefects d = check_dual(mesh, dual);
  if (!(d.closure < identity_tolerance && d.volume < identity_tolerance && d.edge < identity_tolerance))
    throw InputError(
        "mesh: its median dual does not close: tets too flat, or too small beside their coordinates, for double "
        "precision");
  return dual;
}

/// Springs of nearly flat tets may be stiffer than the step of the nodes' own waves allows: where omega^2 <= 2 sum k/mass exceeds 2 (c/l)^2, the length of the node's step
/// is shortened by as much.
void shorten_steps(Domain& d) {
  if (d.order.stiffness.empty()) return;
  std::vector<double> sum(static_cast<std::size_t>(d.order.rows), 0.0);
  for (int a = 0; a < d.order.rows; ++a)
    for (std::int32_t e = d.order.out[a]; e < d.order.out[a + 1]; ++e) sum[a] += d.order.stiffness[e];
  for (int n = 0; n < d.order.rows; ++n)
    for (std::int32_t i = d.order.in[n]; i < d.order.in[n + 1]; ++i) sum[n] += d.order.stiffness[d.order.in_edges[i]];
  const auto wave = d.scene->physics.formulation == Formulation::pFp ? &MaterialConstants::cs : &MaterialConstants::cp;
  for (int n = 0; n < d.order.rows; ++n) {
    if (is_padding(d, n)) continue;
    const double speed = d.mixture.empty() ? d.coefficients.material.*wave : mean_at(d.mixture, n, wave),
                 l = d.step_length[n], excess = sum[n] / mass(d, n) * (l * l) / (speed * speed);
    if (excess > 1) d.step_length[n] /= std::sqrt(excess);
  }
}

Coefficients coefficients_of(const Scene& scene, const Order& order) {
  Coefficients k;
  k.material = constants_of(scene.material, scene.physics);
  k.rho_cp = k.material.rho * k.material.cp;
  k.rho_cs = k.material.rho * k.material.cs;
  k.rho_cJ = k.material.rho * k.material.cJ;
  if (scene.physics.formulation == Formulation::pFp) k.rho_cp = k.rho_cs;  // the pressure waves are the projection's
  k.adjoint = scene.physics.boundary_flux == BoundaryFlux::adjoint;
  k.current_areas = has_current_areas(scene.physics.description);
  k.sweeps_J = scene.physics.stabilisation == Stabilisation::jst;
  k.edge = edge_choices(scene.physics, scene.monitor.energy);
  k.streams = order.nodes >= streaming_nodes;
  return k;
}

}  // namespace

Domain make_domain(const Scene& scene, const Mesh& mesh, Clock& setup) {
  Domain d;
  d.scene = &scene;
  d.mesh = &mesh;
  Dual dual;
  NodeMaterials materials;
  setup.time("dual", [&] {
    materials = node_materials(scene, mesh);
    dual = checked_dual(mesh, tet_stiffness_of_nodes(scene, materials, mesh.X.size()));
  });
  setup.time("order", [&] { d.order = make_order(dual, static_cast<int>(mesh.X.size()), true, materials.group); });
  setup.add("order", -d.order.metis_s);
  setup.add("metis", d.order.metis_s);
  setup.time("state", [&] {
    d.edges = static_cast<long>(dual.edges.size());
    d.X = place_nodes(mesh, dual, d.order);
    d.step_length = step_lengths(scene.time.step, mesh, dual, d.order);
    if (scene.physics.stabilisation == Stabilisation::jst) d.lambda = laplacian_weights(mesh, dual, d.order);
    d.volume = std::move(dual.volume);
    dual = Dual();  // the rows take its place
    d.boundary = make_boundary(scene, mesh, d.order);
    d.mixture = make_mixture(scene, materials, d.order, d.step_length);
    d.coefficients = coefficients_of(scene, d.order);
    shorten_steps(d);
    d.rings = make_tet_rings(scene.physics.description, mesh, d.order);
    d.projection = make_projection_setup(scene, d.order, d.boundary, d.X, d.coefficients.material, d.mixture);
    const bool resists = scene.physics.tet_barrier > 0;
    if (resists || scene.monitor.geometry != GeometryWatch::off) d.tets = make_tets(mesh, d.order, d.X);
    if (resists) find_foreign(d.tets, d.order);
    d.manufactured = make_manufactured(scene, mesh, d.order);
    const bool audits = scene.monitor.energy;
    d.functions = find_part_functions(scene.physics, scene.material, audits);
    d.lagged_functions = find_part_functions(scene.physics, scene.material, audits, true);
  });
  return d;
}

std::size_t bytes_of(const Domain& d) {
  const Order& o = d.order;
  std::size_t doubles = d.X.size() + d.step_length.size() + d.lambda.size() + o.stiffness.size()
                        + d.tets.volume6.size();
  for (int k = 0; k < 3; ++k) doubles += o.C[k].size() + o.corner_C[k].size();
  const std::size_t ints = o.a.size() + o.b.size() + o.out.size() + o.in.size() + o.in_edges.size() + o.in_nodes.size()
                           + o.corner.size() + o.corner_b.size() + o.corner_c.size() + o.corner_load.size()
                           + o.corner_face.size() + o.row_of.size() + o.node_of.size() + d.rings.ring.size()
                           + d.rings.cd.size() + d.rings.at_b.size() + d.rings.at_c.size() + d.projection.held.size()
                           + 4 * d.tets.corner[0].size() + d.tets.foreign.size();
  return 8 * doubles + 4 * ints + mixture_bytes(d.mixture, o);
}

}  // namespace nanson
