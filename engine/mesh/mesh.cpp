// Turns a raw mesh into a checked one: values and indices, then nodes and tets one by one, then faces (mesh_faces).
#include "engine/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/complaints.hpp"
#include "engine/mesh/mesh_faces.hpp"

namespace nanson {
namespace {

constexpr double flat = 1e-12;  // volume / (longest edge)^3 at which a tet counts as degenerate; 0.118 when regular
constexpr double coincident = 1e-12;  // distance / size of the bounding box at which two nodes count as one

std::string at(const Vec3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]); }

/// What the rest relies on to index arrays at all.
void check_sizes(const RawMesh& raw, std::vector<std::string>& errors) {
  if (raw.tets.empty())
    errors.push_back(
        "the mesh has no tetrahedra: mesh the volume (gmsh -3), and put it into a physical group if there are any");
  constexpr auto most = std::size_t(std::numeric_limits<int>::max());
  if (raw.X.size() > most || raw.tets.size() > most)
    errors.push_back(fmt::format("{} nodes and {} tets: more than {} of either cannot be numbered", raw.X.size(),
                                 raw.tets.size(), most));
  const auto bad = [](const std::vector<int>& ids, std::size_t elements, std::size_t names) {
    return ids.size() != elements
           || std::any_of(ids.begin(), ids.end(), [&](int id) { return id < 0 || std::size_t(id) >= names; });
  };
  if (bad(raw.tet_region, raw.tets.size(), raw.region_names.size()))
    errors.push_back("tet_region does not give every tet one of the region names");
  if (bad(raw.triangle_patch, raw.triangles.size(), raw.patch_names.size()))
    errors.push_back("triangle_patch does not give every triangle one of the patch names");
}

void check_coordinates(const std::vector<Vec3>& X, std::vector<std::string>& errors) {
  Complaints infinite("nodes that are not finite");
  for (std::size_t a = 0; a < X.size(); ++a)
    if (!std::isfinite(X[a][0]) || !std::isfinite(X[a][1]) || !std::isfinite(X[a][2]))
      infinite.add([&] { return fmt::format("node {} is at {}: coordinates must be finite", a, at(X[a])); });
  infinite.append_to(errors);
}

/// Node indices of tets or triangles (`what`): in range and no two equal.
template <std::size_t n>
void check_indices(const std::vector<std::array<int, n>>& elements, std::size_t nodes, const char* what,
                   std::vector<std::string>& errors) {
  Complaints outside(fmt::format("{}s with nodes that do not exist", what)),
      repeated(fmt::format("{}s that name a node twice", what));
  for (std::size_t e = 0; e < elements.size(); ++e) {
    bool in_range = true, distinct = true;
    for (std::size_t v = 0; v < n; ++v) {
      in_range = in_range && elements[e][v] >= 0 && std::size_t(elements[e][v]) < nodes;
      for (std::size_t w = 0; w < v; ++w) distinct = distinct && elements[e][v] != elements[e][w];
    }
    if (!in_range)
      outside.add([&] {
        return nodes == 0
                   ? fmt::format("{} {} has the nodes {}, but the mesh has no nodes", what, e, listed(elements[e]))
                   : fmt::format("{} {} has the nodes {}, but the mesh has nodes 0 to {} only", what, e,
                                 listed(elements[e]), nodes - 1);
      });
    else if (!distinct)
      repeated.add([&] {
        return fmt::format("{} {} has the nodes {}, two of them the same: remove it", what, e, listed(elements[e]));
      });
  }
  outside.append_to(errors);
  repeated.append_to(errors);
}

void check_used(const Mesh& mesh, std::vector<std::string>& errors) {
  std::vector<char> used(mesh.X.size(), 0);
  for (const auto& tet : mesh.tets)
    for (const int a : tet) used[a] = 1;
  Complaints unused("nodes of no tet");
  for (std::size_t a = 0; a < used.size(); ++a)
    if (!used[a])
      unused.add([&] { return fmt::format("node {} at {} belongs to no tet: remove it", a, at(mesh.X[a])); });
  unused.append_to(errors);
}

/// Swaps two nodes of every negative tet. Degenerate tets are told and left alone.
void orient(Mesh& mesh, std::vector<std::string>& errors) {
  Complaints degenerate("degenerate tets");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    auto& tet = mesh.tets[t];
    double longest2 = 0;  // [m^2]
    for (int v = 0; v < 4; ++v)
      for (int w = 0; w < v; ++w) {
        const auto &a = mesh.X[tet[v]], &b = mesh.X[tet[w]];
        longest2 = std::max(
            longest2, (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
      }
    const double volume = tet_volume(mesh.X[tet[0]], mesh.X[tet[1]], mesh.X[tet[2]], mesh.X[tet[3]]);
    if (!(std::abs(volume) > flat * longest2 * std::sqrt(longest2)))
      degenerate.add([&] {
        return fmt::format(
            "tet {} with nodes {} near {} is flat: volume {:.3g} m^3 with a longest edge of {:.3g} m; remesh there", t,
            listed(tet), at(mesh.X[tet[0]]), volume, std::sqrt(longest2));
      });
    else if (volume < 0) {
      std::swap(tet[2], tet[3]);
      ++mesh.reoriented;
    }
  }
  degenerate.append_to(errors);
}

struct Place {
  Vec3 X;
  int node;
};

/// Looks for coincident nodes by sorting along x, splitting where neighbours are further apart than the tolerance, and going on
/// with each run along y, then z: n log n whatever the mesh is like.
void find_coincident(Place* begin, Place* end, int axis, double tolerance, Complaints& complaints) {
  if (end - begin < 2) return;
  if (axis < 3) {
    std::sort(begin, end, [axis](const Place& a, const Place& b) {
      return a.X[axis] != b.X[axis] ? a.X[axis] < b.X[axis] : a.node < b.node;
    });
    for (Place* run = begin; run != end;) {
      Place* next = run + 1;
      while (next != end && next->X[axis] - next[-1].X[axis] <= tolerance) ++next;
      find_coincident(run, next, axis + 1, tolerance, complaints);
      run = next;
    }
    return;
  }
  for (Place* b = begin + 1; b != end; ++b)
    for (Place* a = begin; a != b; ++a) {
      if (std::abs(a->X[0] - b->X[0]) > tolerance || std::abs(a->X[1] - b->X[1]) > tolerance
          || std::abs(a->X[2] - b->X[2]) > tolerance)
        continue;
      complaints.add([&] {
        return fmt::format(
            "nodes {} and {} are both at {}: merge them (gmsh: Coherence, or -setnumber Geometry.AutoCoherence 1)",
            std::min(a->node, b->node), std::max(a->node, b->node), at(a->X));
      });
      break;
    }
}

void check_coincident(const std::vector<Vec3>& X, std::vector<std::string>& errors) {
  std::vector<Place> places;
  places.reserve(X.size());
  Vec3 low = X[0], high = X[0];
  for (std::size_t a = 0; a < X.size(); ++a) {
    places.push_back({X[a], int(a)});
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], X[a][c]);
      high[c] = std::max(high[c], X[a][c]);
    }
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  Complaints complaints("pairs of coincident nodes");
  find_coincident(places.data(), places.data() + places.size(), 0, coincident * size, complaints);
  complaints.append_to(errors);
}

}  // namespace

double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Vec3 u, v, w;
  for (int i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
    w[i] = d[i] - a[i];
  }
  return (w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]))
         / 6;
}

Mesh finish_mesh(RawMesh raw, std::vector<std::string>& errors) {
  const std::size_t before = errors.size();
  Mesh mesh;
  check_sizes(raw, errors);
  check_coordinates(raw.X, errors);
  check_indices(raw.tets, raw.X.size(), "tet", errors);
  check_indices(raw.triangles, raw.X.size(), "triangle", errors);
  if (errors.size() != before) return mesh;

  mesh.X = std::move(raw.X);
  mesh.tets = std::move(raw.tets);
  mesh.tet_region = std::move(raw.tet_region);
  mesh.region_names = std::move(raw.region_names);
  mesh.patch_names = raw.patch_names;
  check_used(mesh, errors);
  check_coincident(mesh.X, errors);
  orient(mesh, errors);
  if (errors.size() != before) return mesh;  // faces of flat tets or of doubled nodes would only repeat these errors

  const FaceTable table = face_table(mesh.X.size(), mesh.tets);
  find_boundary(table, mesh, errors);
  name_boundary(table, raw, mesh, errors);
  return mesh;
}

}  // namespace nanson
