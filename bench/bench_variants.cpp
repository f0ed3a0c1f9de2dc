// Ways to sum edge fluxes at the nodes that lost to the engine's, over the same kernels, so that anybody can see by how much: the column's stage without its loads
// ({p,F,J}, neo-Hookean, linear reconstruction), results compared with the engine's first.
//   part_buffer          the engine's: a part's fluxes into a buffer in L2, gathered by its nodes, update and stress while the part is in cache
//   part_accumulation    the same parts, fluxes added to the part's nodes at once; edges to other parts are evaluated by both owners
//   node_centric         every node sums over its own edges: each edge evaluated twice, nothing shared
//   global_edge_array    fluxes of all edges into one array in memory, then the gather as a sweep of its own, then the stress
//   coloured_scatter     each edge once, added to both nodes; colours, in which no node occurs twice, one after another
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/bench.hpp"
#include "engine/clock.hpp"
#include "engine/parts.hpp"
#include "engine/solver.hpp"
#include "kernels/accumulate_update_part.hpp"
#include "kernels/edge_flux_part.hpp"

namespace nanson {
namespace {

constexpr auto linear = Reconstruction::linear;
constexpr auto none = FluxCorrection::none;
constexpr auto scalar = PressureJump::scalar;

/// Edges once each, colour by colour.
struct Colours {
  Aligned<std::int32_t> a, b;
  Aligned<double> C[3];
  std::vector<int> begin;  // of each colour, one more than there are
  EdgeArrays edges() const { return {a.data(), b.data(), {C[0].data(), C[1].data(), C[2].data()}}; }
};

/// Each edge takes the first colour that neither of its nodes has.
Colours colour(const Order& o) {
  std::vector<std::uint64_t> taken(static_cast<std::size_t>(o.rows), 0);
  std::vector<std::vector<int>> of(64);
  for (int e = 0; e < o.out.back(); ++e) {
    if (o.b[e] < o.a[e]) continue;  // the other part's copy
    std::uint64_t& at_a = taken[static_cast<std::size_t>(o.a[e])];
    std::uint64_t& at_b = taken[static_cast<std::size_t>(o.b[e])];
    const int first = std::countr_one(at_a | at_b);
    at_a |= 1ull << first;
    at_b |= 1ull << first;
    of[static_cast<std::size_t>(first)].push_back(e);
  }
  Colours out;
  out.begin = {0};
  for (const auto& edges : of) {
    for (const int e : edges) {
      out.a.push_back(o.a[e]);
      out.b.push_back(o.b[e]);
      for (int k = 0; k < 3; ++k) out.C[k].push_back(o.C[k][e]);
    }
    if (!edges.empty()) out.begin.push_back(static_cast<int>(out.a.size()));
  }
  const std::size_t padded = out.a.size() + ahead::padding;
  out.a.resize(padded);
  out.b.resize(padded);
  for (auto& C : out.C) C.resize(padded);
  return out;
}

/// Every edge of every node as an out-edge, those inside a part twice: no node has in-edges.
Order both_ways(const Order& o) {
  Order out = o;
  out.a.clear();
  out.b.clear();
  out.in_edges.clear();
  out.in_nodes.clear();
  for (auto& C : out.C) C.clear();
  out.most_edges = 0;
  for (Part& part : out.parts) {
    part.edge_begin = static_cast<int>(out.a.size());
    for (int n = part.node_begin; n < part.node_end; ++n) {
      out.out[n] = static_cast<int>(out.a.size());
      out.in[n] = 0;
      const auto add = [&](int b, int e, double sign) {
        out.a.push_back(n);
        out.b.push_back(b);
        for (int k = 0; k < 3; ++k) out.C[k].push_back(sign * o.C[k][e]);
      };
      for (int e = o.out[n]; e < o.out[n + 1]; ++e) add(o.b[e], e, 1);
      for (int i = o.in[n]; i < o.in[n + 1]; ++i) add(o.in_nodes[i], o.in_edges[i], -1);
    }
    part.edge_end = static_cast<int>(out.a.size());
    out.most_edges = std::max(out.most_edges, part.edge_end - part.edge_begin);
  }
  out.out[o.rows] = static_cast<int>(out.a.size());
  out.in[o.rows] = 0;
  out.a.resize(out.a.size() + ahead::padding);
  out.b.resize(out.b.size() + ahead::padding);
  for (auto& C : out.C) C.resize(C.size() + ahead::padding);
  return out;
}

struct Bed {
  Scene scene = column();
  Mesh mesh = box_mesh(scene.mesh);
  Simulation s = make_simulation(scene, mesh, 2);
  Colours colours = colour(s.domain.order);
  Order twice = both_ways(s.domain.order);
  Aligned<double> edge_array = Aligned<double>(
      4 * (static_cast<std::size_t>(s.domain.order.out.back()) + 8 * s.domain.order.parts.size()), 0.0);
  Aligned<double> corner_array = Aligned<double>(4 * s.domain.order.corner_b.size(), 0.0);
  Aligned<double> force = Aligned<double>(4 * static_cast<std::size_t>(s.domain.order.rows), 0.0);
  std::vector<Aligned<double>> large = std::vector<Aligned<double>>(
      2, Aligned<double>(4 * static_cast<std::size_t>(twice.most_edges + 8), 0.0));  // one a thread
  Rows rows = stage_rows(s.domain, s.state, 0, 1);
  Coefficients k = s.domain.coefficients;

  Bed() {
    for (int i = 0; i < 10; ++i) {  // strained and moving in all directions
      s.state.dt = allowed_step(s);
      advance(s);
    }
    rows = stage_rows(s.domain, s.state, 0, 1);
    k.dt = 0.5 * allowed_step(s);
    k.acceleration = s.state.acceleration.data();
  }
  const Part& part(int p) const { return s.domain.order.parts[static_cast<std::size_t>(p)]; }
  void flux(const Part& p, const Order& o, const Scratch& scratch) {
    edge_flux_part<linear, none, scalar, false, Areas::undeformed>(p, o.edges(), o.corners(), o.lists(), rows, k,
                                                                   scratch);
  }
  void accumulate(const Part& p, const Order& o, const Scratch& scratch) {
    accumulate_update_part<Formulation::pFJ, GradientCorrection::none>(
        p, o.edges(), o.lists(), rows, k, s.domain.boundary.constraints.data(), s.state.reactions.data(), scratch);
  }
  void stress(int p) {
    s.state.reports[static_cast<std::size_t>(p)] = s.domain.functions.stress(part(p), rows, k,
                                                                             s.domain.step_length.data());
  }
  void gradient(const Order& o) {
    for_parts(s, [&](int p, Scratch) {
      gradient_part<false, false, NodeWeights::none>(o.parts[static_cast<std::size_t>(p)], o.edges(), o.corners(),
                                                     o.lists(), rows, k);
    });
  }
};

/// Fluxes of edges [begin, end) by the engine's two passes, and use(edge, its row).
template <class Use>
void each_flux(const Bed& bed, const EdgeArrays& edges, int begin, int end, Use use) {
  EdgeBlock block{};
  alignas(64) double flux[4 * edge_block];
  for (int from = begin; from < end; from += edge_block) {
    const int count = std::min(end - from, edge_block);
    gather_edges<linear, none, scalar, false, Areas::undeformed>(from, from + count, edges, bed.rows, bed.k.theta,
                                                                 block, flux);
    for (int at = 0; at < count; at += 8)
      finish_edges<4, scalar, false, Areas::undeformed>(block, at, edges, from + at, bed.rows, bed.k, flux + 4 * at,
                                                        nullptr);
    for (int at = 0; at < count; ++at) use(from + at, load4(flux + 4 * at));
  }
}

void add_row(double* to, Vec4 row) { store4(to, load4(to) + row); }

/// Corners of a part onto its nodes' forces, supports, update.
void finish_part(Bed& bed, const Part& p, const Scratch& scratch) {
  const auto lists = bed.s.domain.order.lists();
  corner_forces(p, bed.s.domain.order.corners(), lists, bed.rows, bed.k, scratch.corner);
  for (int n = p.node_begin; n < p.node_end; ++n)
    for (int g = lists.corner[n]; g < lists.corner[n + 1]; ++g)
      add_row(scratch.force + 4 * (n - p.node_begin), load4(scratch.corner + 4 * (g - p.corner_begin)));
  constrain(p, bed.rows, bed.k, OneDensity{bed.k.material.rho}, bed.s.domain.boundary.constraints.data(),
            bed.s.state.reactions.data(), scratch);
  update<Formulation::pFJ, GradientCorrection::none, Areas::undeformed>(p, bed.rows, bed.k,
                                                                        OneDensity{bed.k.material.rho}, scratch);
}

void part_buffer(Bed& bed) {
  bed.gradient(bed.s.domain.order);
  for_parts(bed.s, [&](int p, Scratch scratch) {
    bed.flux(bed.part(p), bed.s.domain.order, scratch), bed.accumulate(bed.part(p), bed.s.domain.order, scratch),
        bed.stress(p);
  });
}

void part_accumulation(Bed& bed) {
  bed.gradient(bed.s.domain.order);
  for_parts(bed.s, [&](int p, Scratch scratch) {
    const Part& part = bed.part(p);
    const EdgeArrays edges = bed.s.domain.order.edges();
    double* force = scratch.force - 4 * static_cast<std::ptrdiff_t>(part.node_begin);
    std::fill(scratch.force, scratch.force + 4 * (part.node_end - part.node_begin), 0.0);
    each_flux(bed, edges, part.edge_begin, part.edge_end, [&](int e, Vec4 f) {
      add_row(force + 4 * edges.a[e], f);
      if (edges.b[e] >= part.node_begin && edges.b[e] < part.node_end) add_row(force + 4 * edges.b[e], -f);
    });
    finish_part(bed, part, scratch);
    bed.stress(p);
  });
}

void node_centric(Bed& bed) {
  bed.gradient(bed.twice);
  for_parts(bed.s, [&](int p, Scratch scratch) {
    scratch.edge = bed.large[static_cast<std::size_t>(omp_get_thread_num())].data();
    bed.flux(bed.twice.parts[static_cast<std::size_t>(p)], bed.twice, scratch);
    bed.accumulate(bed.twice.parts[static_cast<std::size_t>(p)], bed.twice, scratch);
    bed.stress(p);
  });
}

void global_edge_array(Bed& bed) {
  const auto placed = [&](int p, Scratch scratch) {
    scratch.edge = bed.edge_array.data() + 4 * static_cast<std::ptrdiff_t>(bed.part(p).edge_begin + 8 * p);
    scratch.corner = bed.corner_array.data() + 4 * static_cast<std::ptrdiff_t>(bed.part(p).corner_begin);
    return scratch;
  };
  bed.gradient(bed.s.domain.order);
  for_parts(bed.s, [&](int p, Scratch scratch) { bed.flux(bed.part(p), bed.s.domain.order, placed(p, scratch)); });
  for_parts(bed.s,
            [&](int p, Scratch scratch) { bed.accumulate(bed.part(p), bed.s.domain.order, placed(p, scratch)); });
  for_parts(bed.s, [&](int p, Scratch) { bed.stress(p); });
}

void coloured_scatter(Bed& bed) {
  constexpr int chunk = 16 * edge_block;
  bed.gradient(bed.s.domain.order);
  std::fill(bed.force.begin(), bed.force.end(), 0.0);
  const EdgeArrays edges = bed.colours.edges();
  double* force = bed.force.data();
  for (std::size_t c = 0; c + 1 < bed.colours.begin.size(); ++c) {
    const int begin = bed.colours.begin[c], end = bed.colours.begin[c + 1];
#pragma omp parallel for schedule(static) num_threads(bed.s.team.threads)
    for (int from = begin; from < end; from += chunk)
      each_flux(bed, edges, from, std::min(end, from + chunk),
                [&](int e, Vec4 f) { add_row(force + 4 * edges.a[e], f), add_row(force + 4 * edges.b[e], -f); });
  }
  for_parts(bed.s, [&](int p, Scratch scratch) {
    scratch.force = force + 4 * static_cast<std::ptrdiff_t>(bed.part(p).node_begin);
    finish_part(bed, bed.part(p), scratch);
  });
  for_parts(bed.s, [&](int p, Scratch) { bed.stress(p); });
}

struct Variant {
  const char* name;
  void (*stage)(Bed&);
};
constexpr Variant variants[] = {{"part_buffer", part_buffer},
                                {"part_accumulation", part_accumulation},
                                {"node_centric", node_centric},
                                {"global_edge_array", global_edge_array},
                                {"coloured_scatter", coloured_scatter}};

/// Largest difference of the new states to the engine's, relative to its largest velocity, J, or number of {F, x}.
double difference(Bed& bed, const Variant& variant) {
  part_buffer(bed);
  const Aligned<double> ours = bed.s.state.U[1];
  std::fill(bed.s.state.U[1].begin(), bed.s.state.U[1].end(), 0.0);
  variant.stage(bed);
  double most[3] = {}, size[3] = {};
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const std::size_t kind = i % row::U < 3 ? 0 : i % row::U == 3 ? 1 : 2;
    size[kind] = std::max(size[kind], std::abs(ours[i]));
    most[kind] = std::max(most[kind], std::abs(ours[i] - bed.s.state.U[1][i]));
  }
  return std::max({most[0] / size[0], most[1] / size[1], most[2] / size[2]});
}

void time_variant(benchmark::State& state, const Variant& variant, int threads) {
  static auto bed = std::make_unique<Bed>();
  bed->s.team.threads = threads;
  const double differs = difference(*bed, variant);
  if (!(differs < same)) return state.SkipWithError(fmt::format("differs from the engine by {:.1e}", differs).c_str());
  constexpr int repetitions = 9;
  std::vector<double> ours, seconds, ratios;
  const auto timed = [&](const Variant& v) {
    const double wall = wall_seconds(), cpu = thread_seconds();
    v.stage(*bed);
    return threads == 1 ? thread_seconds() - cpu : wall_seconds() - wall;
  };
  for (int r = 0; r < repetitions; ++r) {
    ours.push_back(timed(variants[0]));
    seconds.push_back(timed(variant));
    ratios.push_back(seconds.back() / ours.back());
  }
  for (auto _ : state) state.SetIterationTime(median(seconds));
  state.counters["ns"] = 2e9 * median(seconds) / bed->s.domain.order.nodes;  // a step has two stages
  state.counters["to_engine"] = median(ratios);
}

}  // namespace

void register_variants() {
  for (const Variant& v : variants)
    for (const int threads : {1, 2})
      benchmark::RegisterBenchmark(fmt::format("variant/{}/threads:{}", v.name, threads).c_str(),
                                   [&v, threads](benchmark::State& state) { time_variant(state, v, threads); })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime()
          ->Iterations(1);
}

}  // namespace nanson
