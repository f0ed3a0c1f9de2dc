// A small mesh with fields that are known functions of node and time, for tests of what is written.
#pragma once
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/output_field.hpp"

namespace nanson::test {

/// A beam of unit cubes along z, six tets each (Kuhn); the upper half is region "top".
inline Mesh beam(int nx, int ny, int nz) {
  Mesh mesh;
  mesh.region_names = {"bottom", "top"};
  const auto node = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) mesh.X.push_back({double(i), double(j), double(k)});
  constexpr std::array<std::array<int, 3>, 6> paths{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (std::size_t p = 0; p < paths.size(); ++p) {
          std::array<int, 3> at{i, j, k};
          std::array<int, 4> tet{node(i, j, k)};
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[std::size_t(paths[p][s])];
            tet[s + 1] = node(at[0], at[1], at[2]);
          }
          if (p >= 3) std::swap(tet[2], tet[3]);  // odd permutations are left-handed
          mesh.tets.push_back(tet);
          mesh.tet_region.push_back(2 * k < nz ? 0 : 1);
        }
  return mesh;
}

/// A bending beam, displacement = (0.02 t Z^2, 0, 0); any other field: 1000 t + node + component/16, exact in float.
inline std::vector<float> sample_values(const Mesh& mesh, const Field& field, double t) {
  std::vector<float> values;
  values.reserve(mesh.X.size() * std::size_t(field.components));
  for (std::size_t a = 0; a < mesh.X.size(); ++a)
    for (int c = 0; c < field.components; ++c)
      values.push_back(field.name == "displacement" ? (c == 0 ? float(0.02 * t * mesh.X[a][2] * mesh.X[a][2]) : 0.0f)
                                                    : float(1000 * t + double(a) + c / 16.0));
  return values;
}

}  // namespace nanson::test
