// Matches tet faces by sorting: rows by smallest node, some 24 entries each, so the cost is linear in the number of tets.
#include "engine/mesh/mesh_faces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/complaints.hpp"

namespace nanson {
namespace {

using Entry = FaceTable::Entry;
using Entries = std::span<const Entry>;
using Triangle = std::array<int, 3>;

std::array<int, 4> sorted(std::array<int, 4> t) {
  const auto order = [&](int a, int b) {
    const int low = std::min(t[a], t[b]), high = std::max(t[a], t[b]);
    t[a] = low;
    t[b] = high;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return t;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// The corner of the tet that is not on this face.
int opposite_corner(const std::array<int, 4>& tet, const Triangle& face) {
  int corner = 0;
  while (tet[corner] == face[0] || tet[corner] == face[1] || tet[corner] == face[2]) ++corner;
  return corner;
}

Triangle outward(const std::array<int, 4>& tet, const Triangle& face) {
  const auto& local = tet_faces[opposite_corner(tet, face)];
  return {tet[local[0]], tet[local[1]], tet[local[2]]};
}

/// Whether the triangle is an even permutation of its sorted nodes.
bool even(const Triangle& t) { return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2; }

Triangle triangle(int smallest, const Entry& e) { return {smallest, int(e.middle), int(e.largest)}; }

struct FaceComplaints {
  Complaints equal{"pairs of equal tets"}, crowded{"faces of three or more tets"},
      same_side{"pairs of overlapping tets"};
};

void complain_equal(const Mesh& mesh, int s, int t, Complaints& equal) {
  equal.add([&] {
    const auto& region_s = mesh.region_names[mesh.tet_region[s]];
    const auto& region_t = mesh.region_names[mesh.tet_region[t]];
    const std::string both = fmt::format("tets {} and {} have the same nodes {}", s, t, listed(sorted(mesh.tets[s])));
    return region_s == region_t
               ? both + ": remove one"
               : fmt::format(
                   "{}, one in region \"{}\" and one in \"{}\": put every volume into one physical group only", both,
                   region_s, region_t);
  });
}

/// All tets of one face, at least two. Equal tets are told once: at their face of the three smallest nodes.
void check_inner_face(const Mesh& mesh, const Triangle& face, Entries tets, FaceComplaints& complaints) {
  std::vector<std::pair<int, int>> others;  // (node opposite the face, tet)
  for (const auto& e : tets) others.push_back({mesh.tets[e.tet][opposite_corner(mesh.tets[e.tet], face)], e.tet});
  std::sort(others.begin(), others.end());
  for (std::size_t i = 1; i < others.size(); ++i)
    if (others[i].first == others[i - 1].first && others[i].first > face[2])
      complain_equal(mesh, others[i - 1].second, others[i].second, complaints.equal);
  others.erase(
      std::unique(others.begin(), others.end(), [](const auto& s, const auto& t) { return s.first == t.first; }),
      others.end());
  if (others.size() > 2)
    complaints.crowded.add([&] {
      std::vector<int> some;
      for (std::size_t i = 0; i < std::min<std::size_t>(others.size(), 5); ++i) some.push_back(others[i].second);
      return fmt::format(
          "face of nodes {} is shared by {} tets ({}{}): at most two may meet at a face; remove the overlapping ones",
          listed(face), others.size(), listed(some), some.size() < others.size() ? ", ..." : "");
    });
  else if (others.size() == 2
           && even(outward(mesh.tets[others[0].second], face)) == even(outward(mesh.tets[others[1].second], face)))
    complaints.same_side.add([&] {
      return fmt::format(
          "tets {} and {} overlap: both lie on the same side of their face of nodes {}; one of them is turned inside "
          "out, "
          "move its nodes or remesh",
          others[0].second, others[1].second, listed(face));
    });
}

/// The usual inner face: two tets with different fourth nodes, on different sides.
bool is_proper(const Mesh& mesh, const Triangle& face, const Entry& s, const Entry& t) {
  return even(outward(mesh.tets[s.tet], face)) != even(outward(mesh.tets[t.tet], face));
}

const Entry* find(Entries row, const Triangle& face) {
  const std::uint64_t key = Entry{std::uint32_t(face[1]), std::uint32_t(face[2]), 0}.key();
  const auto found = std::lower_bound(row.begin(), row.end(), key,
                                      [](const Entry& e, std::uint64_t k) { return e.key() < k; });
  return found != row.end() && found->key() == key ? &*found : nullptr;
}

Face* find_boundary_face(Mesh& mesh, const Triangle& face) {
  const auto found = std::lower_bound(mesh.faces.begin(), mesh.faces.end(), face,
                                      [](const Face& f, const Triangle& t) { return sorted(f.nodes) < t; });
  return found != mesh.faces.end() && sorted(found->nodes) == face ? &*found : nullptr;
}

void drop_unused_patches(Mesh& mesh) {
  std::vector<int> now(mesh.patch_names.size(), -1);
  for (const auto& face : mesh.faces)
    if (face.patch >= 0) now[face.patch] = 0;
  std::vector<std::string> names;
  for (std::size_t p = 0; p < now.size(); ++p)
    if (now[p] == 0) {
      now[p] = int(names.size());
      names.push_back(mesh.patch_names[p]);
    }
  for (auto& face : mesh.faces)
    if (face.patch >= 0) face.patch = now[face.patch];
  mesh.patch_names = std::move(names);
}

}  // namespace

FaceTable face_table(std::size_t nodes, const std::vector<std::array<int, 4>>& tets) {
  FaceTable table;
  table.first.assign(nodes + 1, 0);
  for (const auto& tet : tets) {  // of the four faces the smallest node has three, the next one has one
    const auto n = sorted(tet);
    table.first[n[0]] += 3;
    table.first[n[1]] += 1;
  }
  std::size_t end = 0;
  for (auto& row : table.first)
    row = end += row;  // the end of each row, moved down to its start while the row is filled
  table.entries.resize(end);
  for (int t = 0; t < int(tets.size()); ++t) {
    const auto n = sorted(tets[t]);
    const auto put = [&](int a, int b, int c) {
      table.entries[--table.first[a]] = {std::uint32_t(b), std::uint32_t(c), t};
    };
    put(n[0], n[1], n[2]);
    put(n[0], n[1], n[3]);
    put(n[0], n[2], n[3]);
    put(n[1], n[2], n[3]);
  }
  const auto before = [](const Entry& s, const Entry& t) {
    return s.key() != t.key() ? s.key() < t.key() : s.tet < t.tet;
  };
  for (std::size_t a = 0; a < nodes; ++a)
    std::sort(table.entries.data() + table.first[a], table.entries.data() + table.first[a + 1], before);
  return table;
}

void find_boundary(const FaceTable& table, Mesh& mesh, std::vector<std::string>& errors) {
  FaceComplaints complaints;
  for (int a = 0; a < int(mesh.X.size()); ++a) {
    const Entries row = table.row(a);
    for (std::size_t begin = 0, end; begin < row.size(); begin = end) {
      end = begin + 1;
      while (end < row.size() && row[end].key() == row[begin].key()) ++end;
      const Triangle face = triangle(a, row[begin]);
      if (end == begin + 1) mesh.faces.push_back({outward(mesh.tets[row[begin].tet], face), row[begin].tet, -1});
      else if (end > begin + 2 || !is_proper(mesh, face, row[begin], row[begin + 1]))
        check_inner_face(mesh, face, row.subspan(begin, end - begin), complaints);
    }
  }
  for (const auto* kind : {&complaints.equal, &complaints.crowded, &complaints.same_side}) kind->append_to(errors);
}

void name_boundary(const FaceTable& table, const RawMesh& raw, Mesh& mesh, std::vector<std::string>& errors) {
  Complaints strangers("triangles that are no face of a tet"), twice("triangles in two patches");
  for (std::size_t i = 0; i < raw.triangles.size(); ++i) {
    const Triangle nodes = sorted(raw.triangles[i]);
    const int patch = raw.triangle_patch[i];
    if (Face* face = find_boundary_face(mesh, nodes)) {
      if (face->patch >= 0 && face->patch != patch)
        twice.add([&] {
          return fmt::format(
              "boundary triangle of nodes {} is in the patches \"{}\" and \"{}\": put it into one of them only",
              listed(nodes), raw.patch_names[face->patch], raw.patch_names[patch]);
        });
      else face->patch = patch;
    } else if (!find(table.row(nodes[0]), nodes)) {
      strangers.add([&] {
        return fmt::format(
            "triangle {} of patch \"{}\" with nodes {} is no face of any tet: mesh surface and volume together", i,
            raw.patch_names[patch], listed(nodes));
      });
    }
  }
  strangers.append_to(errors);
  twice.append_to(errors);
  mesh.unnamed_faces = int(
      std::count_if(mesh.faces.begin(), mesh.faces.end(), [](const Face& f) { return f.patch < 0; }));
  drop_unused_patches(mesh);
}

}  // namespace nanson
