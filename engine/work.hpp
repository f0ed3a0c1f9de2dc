// Byte and flop models of the sweeps, from the traits alone.
// Bytes: what a sweep must move between DRAM and the caches when every row is fetched once. A row that is written without having been read counts twice, because its
// cache lines are fetched first (once where it is written past the caches: W and PH from `streaming_nodes` on); neighbours' rows count once a sweep (parts and their
// halo stay in cache); part-local buffers stay in L2 and do not count.
// Flops: additions, multiplications, divisions, roots and comparisons of the formulas, an fma two, padding lanes none. Edges between parts count in both.
#pragma once
#include "engine/order.hpp"
#include "engine/scene.hpp"

namespace nanson {

struct Work {
  double bytes = 0, flops = 0;
};
inline Work operator+(Work a, Work b) { return {a.bytes + b.bytes, a.flops + b.flops}; }
inline Work operator*(double s, Work a) { return {s * a.bytes, s * a.flops}; }

/// How many of everything an order has.
struct Sizes {
  double nodes, edges, in_edges, corners;
  explicit Sizes(const Order& o)
      : nodes(o.nodes), edges(o.out.back()), in_edges(o.in.back()), corners(o.corner.back()) {}
};

/// What the traits mean for the counts: numbers in {v, Sigma_J} that matter, and which rows exist.
struct Carried {
  bool linear, limited, fixed, jst, J, H, tensor, full, corrected, pressure, deformed, springs, barrier;
  double w;  // 3 or 4
  explicit Carried(const PhysicsSpec& p)
      : linear(p.reconstruction != Reconstruction::constant),
        limited(p.reconstruction == Reconstruction::limited),
        fixed(p.entropy_fix != EntropyFix::none),
        jst(p.stabilisation == Stabilisation::jst),
        J(p.formulation != Formulation::pF),
        H(p.formulation == Formulation::pFHJ),
        tensor(J && p.pressure_jump == PressureJump::tensor),
        full(p.flux_correction == FluxCorrection::full),
        corrected(p.flux_correction != FluxCorrection::none),
        pressure(p.flux_correction == FluxCorrection::pressure),
        deformed(p.upwind_metric == UpwindMetric::deformed),
        springs(p.tet_stiffness > 0),
        barrier(p.tet_barrier > 0),
        w(J || pressure ? 4 : 3) {}
};

namespace bytes {
inline constexpr double X = 32, U = 128, H = 96, W = 32, PH = 192, G = 96, dP = 96, GP = 288, L = 32, lambda = 32,
                        step_length = 8, force = 32;
inline constexpr double lists = 12;                          // out, in, corner
inline constexpr double edge = 28, edge_a = 4, in_edge = 8;  // b, C; a; edge number and first node
inline constexpr double spring = 8, detF = 8;
inline constexpr double corner = 32, corner_load = 4;  // b, c, C; load
}  // namespace bytes

/// How often a row counts that only other sweeps read.
inline double written(const Sizes& s) { return s.nodes >= streaming_nodes ? 1 : 2; }

/// gradient_part: reads W, X, PH with a gradient of P, the edges; writes G, GP, dP and the corrected PH, L.
inline Work gradient_work(const Carried& c, const Sizes& s) {
  const bool of_P = c.full || (c.tensor && c.linear), stores_GP = c.tensor && c.linear;
  const double half_edges = s.edges + s.in_edges;
  Work out;
  out.bytes = s.nodes
                  * (bytes::W + bytes::X + bytes::lists + 2 * bytes::G + (of_P ? bytes::PH : 0)
                     + (stores_GP ? 2 * bytes::GP : 0) + (c.full ? 2 * bytes::dP + written(s) * bytes::PH : 0))
              + s.edges * bytes::edge + s.in_edges * bytes::in_edge + s.corners * bytes::corner;
  const double numbers = c.w + (of_P ? 9 : 0);
  out.flops = half_edges * numbers * (1 + 6) + s.corners * numbers * (4 + 6)
              + s.nodes * 3 * numbers;  // difference, 3 fma; mean of two; scaling
  if (c.full)
    out.flops += half_edges * (3 + 15 + 18 + 6 + 36)
                 + s.nodes * (162 + 27 + 9);  // D; (P_b - P_a) C; (x) D; D (x) D; times C; times grad P; P + dP
  if (c.limited)
    out.flops += half_edges * (3 + c.w * (1 + 5 + 1 + 4))
                 + s.nodes * c.w * 8;                      // D; jump, slope, four extremes; quotients
  if (c.jst) out.flops += half_edges * (3 + 6 + 3 * c.w);  // D; weight; sum
  if (c.limited || c.jst) out.bytes += s.nodes * (2 * bytes::L + (c.jst ? bytes::lambda : 0));
  return out;
}

/// edge_flux_part: reads W, X, PH, G, GP, L and the edges; its buffer stays in L2. edge_flux_jst_part: PH, L and the edges.
inline Work edge_flux_work(const Carried& c, const Sizes& s, bool audits = false) {
  const double n = c.w;
  Work out;
  if (c.jst) {
    out.bytes = s.nodes * (bytes::PH + bytes::L + 8) + s.edges * bytes::edge
                + s.corners * (bytes::corner + bytes::corner_load);
    out.flops = s.edges * (3 * (3 + 1 + 6) + 4 * n + (c.springs ? 9 : 0)) + s.corners * 9 * 5;
    if (c.springs) out.bytes += s.edges * bytes::spring;
    return out;
  }
  out.bytes = s.nodes
                  * (bytes::W + bytes::X + bytes::PH + 8 + (c.linear ? bytes::G + (c.tensor ? bytes::GP : 0) : 0)
                     + (c.limited ? bytes::L : 0))
              + s.edges * (bytes::edge + bytes::edge_a) + s.corners * (bytes::corner + bytes::corner_load);
  double flops = 3 * (6 + 1 + 12) + n;                      // averages of P and H times C; jump
  if (c.linear) flops += 3 + 3 * n + 6 * n + 2 * n;         // D; G_a + G_b; times D; subtracted
  if (c.limited) flops += 6 * n;                            // the slopes of a and b apart, times the limiter
  if (c.corrected) flops += 3 * n + 6 * n + n;              // q
  if (c.fixed) flops += 5 + 5 + 3 + 6 + (c.J ? 2 : 0) + 3;  // (c.plain); (d.plain); signs; normal and tangential parts
  flops += 5 + 2 + 2 + 2 + (c.deformed ? 2 : 0) + 6
           + 12;            // c.c; shear; 1/(c.c cn); normal; root and comparison; (c.d); D^p
  if (c.J) flops += 3 + 2;  // D^J
  if (audits) flops += 5 + 5 + 4 + 1 + (c.J ? 2 : 0);  // (d.plain); (c.plain); power
  if (c.pressure) flops += 1;
  if (c.springs) {
    flops += 3 + 6;  // stretch; times the stiffness
    out.bytes += s.edges * bytes::spring;
  }
  if (c.tensor) flops += 9 * (1 + 2) + 5 + 1 + (c.linear ? 9 * 3 * 3 : 0);  // jump of P times C, along c
  out.flops = s.edges * flops + s.corners * 9 * 5;
  return out;
}

/// accumulate_update_part: reads the old state and the stage's, H, G and X, and writes the new state: three state rows in every stage, since what is written fresh
/// in the first (twice) is read before it is written in the others. `alone`: as a sweep of its own; in the fused step X, G and PH are in L2 already.
inline Work accumulate_update_work(const Carried& c, const Sizes& s, bool alone) {
  const double half_edges = s.edges + s.in_edges, numbers = 15 + (c.J ? 1 : 0) + (c.H ? 9 : 0);
  Work out;
  out.bytes = s.nodes
                  * (3 * (bytes::U + (c.H ? bytes::H : 0)) + bytes::lists
                     + (alone ? bytes::X + bytes::G + (c.J ? bytes::PH : 0) : 0))
              + s.in_edges * 4;
  if (alone && c.corrected) out.bytes += s.edges * (bytes::edge - 4);
  out.flops = (half_edges + s.corners) * (c.J ? 4 : 3)
              + s.nodes * (5 * numbers + 11);  // sums; U_new; body force and rates of v and J
  out.flops += s.nodes * ((c.J ? 18 : 0) + (c.H ? 63 : 0))
               + (c.corrected ? half_edges * 18 + s.nodes * 18 : 0);  // H : G; F x G; correction of G
  return out;
}

/// What acts from outside on nodes, as the update reads it.
inline Work force_work(const Sizes& s) { return {s.nodes * bytes::force, 0}; }

/// stress_part: reads the state and the step length, writes W and PH; `law_flops` of one node as counted by engine/counted.hpp.
inline Work stress_work(const Carried& c, const Sizes& s, double law_flops, bool alone) {
  return {s.nodes
              * ((alone ? bytes::U + (c.H ? bytes::H : 0) + (c.springs ? bytes::X : 0) : 0) + bytes::step_length
                 + written(s) * (bytes::W + bytes::PH) + (c.barrier ? 2 * bytes::detF : 0)),
          s.nodes * (law_flops + 14 + (c.J ? 4 : 0) + (c.springs ? 3 + 21 : 0))};
}

/// A step of the fused schedule with linear reconstruction: two sweeps a stage. With two stages the first takes the flux correction that the last of the step before has
/// left in the rows of the stage's state (written once more for it), and on the edges (pressure) or in P (full).
inline Work step_work(const PhysicsSpec& p, const Sizes& s, double law_flops, int stages, bool audits = false) {
  const auto stage = [&](const Carried& c) {
    return gradient_work(c, s) + edge_flux_work(c, s, audits) + accumulate_update_work(c, s, false)
           + stress_work(c, s, law_flops, false);
  };
  const Carried found(p);
  if (!found.corrected || stages != 2) return stages * stage(found);
  Carried lagged = found;
  lagged.full = lagged.corrected = false;
  return stage(lagged) + stage(found)
         + Work{s.nodes * (bytes::U + (found.full ? bytes::dP : 0)) + (found.pressure ? 3 * 8 * s.edges : 0),
                s.nodes * (9 + (found.full ? 9 : 0))};
}

}  // namespace nanson
