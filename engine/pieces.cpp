#include "engine/pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nanson {
namespace {

constexpr std::size_t most_named = 8;
constexpr double near = 1e-3;  // [-] of the shortest edge: nodes that were meant to be one

/// Of each node, the piece that it belongs to, numbered from 0.
std::vector<int> piece_of_nodes(const Mesh& mesh) {
  std::vector<int> above(mesh.X.size());
  std::iota(above.begin(), above.end(), 0);
  const auto root = [&](int n) {
    while (above[static_cast<std::size_t>(n)] != n) {
      int& up = above[static_cast<std::size_t>(n)];
      up = above[static_cast<std::size_t>(up)];
      n = up;
    }
    return n;
  };
  for (const auto& t : mesh.tets)
    for (std::size_t k = 1; k < 4; ++k) above[static_cast<std::size_t>(root(t[k]))] = root(t[0]);
  std::vector<int> number(mesh.X.size(), -1), piece(mesh.X.size());
  int count = 0;
  for (std::size_t n = 0; n < mesh.X.size(); ++n) {
    int& p = number[static_cast<std::size_t>(root(static_cast<int>(n)))];
    if (p < 0) p = count++;
    piece[n] = p;
  }
  return piece;
}

/// Least distance of each piece's nodes from those of others: from node to node along x, no further than the least that both pieces know.
void find_gaps(const Mesh& mesh, const std::vector<int>& piece_of, std::vector<Piece>& pieces) {
  std::vector<std::size_t> along_x(mesh.X.size());
  std::iota(along_x.begin(), along_x.end(), std::size_t{0});
  std::ranges::sort(along_x, [&](std::size_t a, std::size_t b) { return mesh.X[a] < mesh.X[b]; });
  for (Piece& p : pieces) p.gap = 1e300;
  for (std::size_t i = 0; i < along_x.size(); ++i)
    for (std::size_t j = i + 1; j < along_x.size(); ++j) {
      const Vec3 &a = mesh.X[along_x[i]], &b = mesh.X[along_x[j]];
      double& mine = pieces[static_cast<std::size_t>(piece_of[along_x[i]])].gap;
      double& other = pieces[static_cast<std::size_t>(piece_of[along_x[j]])].gap;
      if (b[0] - a[0] >= mine && b[0] - a[0] >= other) break;
      if (&mine == &other) continue;
      const double gap = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      mine = std::min(mine, gap);
      other = std::min(other, gap);
    }
}

std::string place(const Vec3& at) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", at[0], at[1], at[2]); }

}  // namespace

std::vector<Piece> pieces(const Simulation& s) {
  const Mesh& mesh = *s.domain.mesh;
  const std::vector<int> piece_of = piece_of_nodes(mesh);
  std::vector<Piece> out(static_cast<std::size_t>(*std::ranges::max_element(piece_of)) + 1);
  const auto at_row = [&](int row) -> Piece& {
    return out[static_cast<std::size_t>(
        piece_of[static_cast<std::size_t>(s.domain.order.node_of[static_cast<std::size_t>(row)])])];
  };
  const Vec3& g = s.domain.scene->body_force;
  for (std::size_t n = 0; n < mesh.X.size(); ++n) {
    Piece& p = out[static_cast<std::size_t>(piece_of[n])];
    const int r = s.domain.order.row_of[n];
    const double* v = &s.state.U[0][static_cast<std::size_t>(row::U * r)];
    ++p.nodes;
    p.mass += s.domain.volume[n] * density(s.domain, r);
    for (std::size_t k = 0; k < 3; ++k) p.centre[k] += mesh.X[n][k];
    p.moves = p.moves || v[0] != 0 || v[1] != 0 || v[2] != 0;
    p.pushed = p.pushed || g[0] != 0 || g[1] != 0 || g[2] != 0;
  }
  for (Piece& p : out)
    for (double& x : p.centre) x /= p.nodes;
  for (const Constraint& h : s.domain.boundary.constraints) at_row(h.node).held = true;
  for (const auto& face : s.domain.boundary.slot_nodes) at_row(face[0]).pushed = true;
  if (out.size() > 1) find_gaps(mesh, piece_of, out);
  std::ranges::stable_sort(out, [](const Piece& a, const Piece& b) { return a.mass > b.mass; });
  return out;
}

std::vector<std::string> piece_lines(const std::vector<Piece>& pieces, double shortest_edge) {
  std::vector<std::string> lines;
  if (pieces.size() < 2) return lines;
  lines.push_back(
      fmt::format("the mesh is in {} pieces that share no node: no force passes from one to another:", pieces.size()));
  for (std::size_t i = 0; i < std::min(pieces.size(), most_named); ++i) {
    const Piece& p = pieces[i];
    std::string gap = fmt::format("{:.3g} m from a node of another piece", p.gap);
    if (p.gap < near * shortest_edge) gap += ": nodes that nearly coincide, as if meant to be one (gmsh: Coherence)";
    lines.push_back(fmt::format("  piece {}: {} nodes, mass {:.4g} kg, around {}, {}, {}", i + 1, p.nodes, p.mass,
                                place(p.centre),
                                p.held    ? "held"
                                : p.moves ? "moving"
                                          : "free",
                                gap));
  }
  if (pieces.size() > most_named) lines.push_back(fmt::format("  and {} more", pieces.size() - most_named));
  return lines;
}

std::string loose_piece(const std::vector<Piece>& pieces) {
  if (pieces.size() < 2) return "";
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& p = pieces[i];
    if (p.held || p.moves || !p.pushed) continue;
    return fmt::format(
        "piece {} of the mesh ({} nodes, {:.4g} kg, around {}) has no support and no initial motion: loads or "
        "body force will carry it away through the others; pieces that touch must share nodes (gmsh: "
        "Coherence, BooleanFragments)",
        i + 1, p.nodes, p.mass, place(p.centre));
  }
  return "";
}

}  // namespace nanson
