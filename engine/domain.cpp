// Set-up of all that a run does not change: dual, order, nodes, supports and loads, materials, part functions.
#include "engine/domain.hpp"

#include "engine/input_error.hpp"
#include "engine/material.hpp"
#include "engine/node_geometry.hpp"

namespace nanson {
namespace {

constexpr double identity_tolerance = 1e-10;  // round-off on flat tets stays far below

Dual checked_dual(const Mesh& mesh) {
  Dual dual = make_dual(mesh);
  const DualDefects d = check_dual(mesh, dual);
  if (!(d.closure < identity_tolerance && d.volume < identity_tolerance && d.edge < identity_tolerance))
    throw InputError(
        "mesh: its median dual does not close: tets too flat, or too small beside their coordinates, for double "
        "precision");
  return dual;
}

Coefficients coefficients_of(const Scene& scene, const Order& order) {
  Coefficients k;
  k.material = constants_of(scene.material);
  k.material.parting = scene.physics.parting * k.material.mu;
  k.rho_cp = k.material.rho * k.material.cp;
  k.rho_cs = k.material.rho * k.material.cs;
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
  setup.time("dual", [&] { dual = checked_dual(mesh); });
  NodeMaterials materials;
  setup.time("order", [&] {
    materials = node_materials(scene, mesh);
    d.order = make_order(dual, static_cast<int>(mesh.X.size()), true, materials.group);
  });
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
    d.rings = make_tet_rings(scene.physics.description, mesh, d.order);
    d.projection = make_projection_setup(scene, d.order, d.boundary, d.X, d.coefficients.material, d.mixture);
    if (scene.monitor.geometry != GeometryWatch::off) d.tets = make_tets(mesh, d.order, d.X);
    d.manufactured = make_manufactured(scene, mesh, d.order);
    const bool audits = scene.monitor.energy;
    d.functions = find_part_functions(scene.physics, scene.material, audits);
    d.lagged_functions = find_part_functions(scene.physics, scene.material, audits, true);
  });
  return d;
}

std::size_t bytes_of(const Domain& d) {
  const Order& o = d.order;
  std::size_t doubles = d.X.size() + d.step_length.size() + d.lambda.size();
  for (int k = 0; k < 3; ++k) doubles += o.C[k].size() + o.corner_C[k].size();
  const std::size_t ints = o.a.size() + o.b.size() + o.out.size() + o.in.size() + o.in_edges.size() + o.in_nodes.size()
                           + o.corner.size() + o.corner_b.size() + o.corner_c.size() + o.corner_load.size()
                           + o.corner_face.size() + o.row_of.size() + o.node_of.size() + d.rings.ring.size()
                           + d.rings.cd.size() + d.rings.at_b.size() + d.rings.at_c.size() + d.projection.held.size();
  return 8 * doubles + 4 * ints + mixture_bytes(d.mixture, o);
}

}  // namespace nanson
