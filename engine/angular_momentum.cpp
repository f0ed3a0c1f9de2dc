// The arms are x^n in stage 1 and x^(n+1) in stage 2, final before its correction: with them L^(n+1) - L^n is exactly the angular impulse of
// what acts from outside, L^(n+1) - L^n = (dt/2) [sum x^n x (Omega f_ext + R)^n + sum x^(n+1) x (Omega f_ext + R)*].
#include "engine/angular_momentum.hpp"

#include <Eigen/Dense>

#include "engine/parts.hpp"
#include "kernels/angular_momentum_part.hpp"

namespace nanson {
namespace {

static_assert(moment_count <= part_row);

Vec3 arm(const double* arms, int n, const Vec3& about) {
  return {arms[row::U * n + 7] - about[0], arms[row::U * n + 11] - about[1], arms[row::U * n + 15] - about[2]};
}

void add(double* sum, const Vec3& v) {
  for (int k = 0; k < 3; ++k) sum[k] += v[k];
}

}  // namespace

void sum_moments(const Simulation& s, const Rows& rows, const double* arms, int part, const Scratch& scratch) {
  const Part& p = s.domain.order.parts[static_cast<std::size_t>(part)];
  const double o[3] = {s.state.arm_origin[0], s.state.arm_origin[1], s.state.arm_origin[2]};
  moments_part(p, nodes_of(s.domain, p), rows.X, s.domain.step_length.data(), arms, o, scratch,
               s.team.part_rows[static_cast<std::size_t>(part)].data());
}

Vec3 external_torque(const Simulation& s, const double* arms, const Vec3& about) {
  Vec3 torque{};
  if (!s.domain.boundary.constraints.empty()) {
    const auto sum = sums_over_parts<3>(s, [&](int p, double* out) {
      const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
      for (int i = part.constraint_begin; i < part.constraint_end; ++i) {
        const Constraint& h = s.domain.boundary.constraints[static_cast<std::size_t>(i)];
        const double* R = &s.state.reactions[static_cast<std::size_t>(reaction_row * i)];
        Vec3 f{};
        for (int m = 0; m < h.count; ++m)
          for (int k = 0; k < 3; ++k) f[k] += R[m] * h.d[m][k];
        add(out, cross(arm(arms, h.node, about), f));
      }
    });
    add(torque.data(), sum);
  }
  for (std::size_t slot = 0; slot < s.domain.boundary.slot_nodes.size(); ++slot) {
    const double* f = &s.state.loads[4 * slot];
    for (int n : s.domain.boundary.slot_nodes[slot]) add(torque.data(), cross(arm(arms, n, about), {f[0], f[1], f[2]}));
  }
  const Vec3& g = s.domain.scene->body_force;
  if (g[0] != 0 || g[1] != 0 || g[2] != 0) {
    const auto sum = sums_over_parts<3>(s, [&](int p, double* out) {
      const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
      for (int n = part.node_begin; n < part.node_begin + nodes_of(s.domain, part); ++n) {
        if (is_padding(s.domain, n)) continue;
        const Vec3 r = arm(arms, n, about);
        for (int k = 0; k < 3; ++k) out[k] += mass(s.domain, n) * r[k];
      }
    });
    add(torque.data(), cross(sum, g));
  }
  return torque;
}

/// lambda_0 + lambda x y without a resultant is lambda x (y - c), c the centre of volume: of the six equations three remain,
/// sum Omega [|r|^2 I - r (x) r] lambda = -torque with r = y - c, which is well scaled wherever the body is and however small.
double keep_angular_momentum(Simulation& s, const Rows& rows, const Coefficients& k, const double* arms) {
  const auto m = tree_sums<moment_count>(s);
  const Vec3 outside = external_torque(s, arms, s.state.arm_origin);
  const Eigen::Vector3d S = Eigen::Vector3d(m[1], m[2], m[3]) / m[0],
                        torque(m[10] - outside[0], m[11] - outside[1], m[12] - outside[2]);
  Eigen::Matrix3d M;
  M << m[4], m[7], m[8], m[7], m[5], m[9], m[8], m[9], m[6];
  M -= m[0] * S * S.transpose();
  const Eigen::Matrix3d inertia = M.trace() * Eigen::Matrix3d::Identity() - M;
  const Eigen::Vector3d l = inertia.ldlt().solve(-torque);
  for (int i = 0; i < 3; ++i)
    s.state.arm_origin[i] += S[i];  // the centre of the arms: near the body's wherever it flies
  const double lambda[3] = {l[0], l[1], l[2]},
               centre[3] = {s.state.arm_origin[0], s.state.arm_origin[1], s.state.arm_origin[2]};
  return sum_over_parts(s, [&](int p) {
    const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
    return correct_part(part, nodes_of(s.domain, part), rows, k, s.domain.step_length.data(), arms, lambda, centre,
                        s.domain.boundary.constraints.data(), s.state.reactions.data());
  });
}

}  // namespace nanson
