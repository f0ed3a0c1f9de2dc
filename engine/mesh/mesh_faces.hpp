// The faces of all tets, matched with each other and with the named triangles: what finish_mesh knows of connectivity.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"

namespace nanson {

/// All four faces of all tets in compressed rows by their smallest node, each row sorted by (middle, largest).
struct FaceTable {
  struct Entry {
    std::uint32_t middle, largest;
    int tet;
    std::uint64_t key() const { return std::uint64_t{middle} << 32 | largest; }
  };
  std::vector<std::size_t> first;  // per node, where its row starts; one more at the end
  std::vector<Entry> entries;

  std::span<const Entry> row(int node) const {
    return {entries.data() + first[node], entries.data() + first[node + 1]};
  }
};

FaceTable face_table(std::size_t nodes, const std::vector<std::array<int, 4>>& tets);

/// Fills mesh.faces with the faces of one tet, patch -1. Errors: equal tets, faces of three tets, tets on the same side of a face.
void find_boundary(const FaceTable& table, Mesh& mesh, std::vector<std::string>& errors);

/// Gives boundary faces their patch and drops names without any. Errors: triangles of no tet, triangles of two patches.
void name_boundary(const FaceTable& table, const RawMesh& raw, Mesh& mesh, std::vector<std::string>& errors);

}  // namespace nanson
