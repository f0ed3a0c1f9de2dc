// The arms are x^n in stage 1 and x^(n+1) in stage 2, final before its correction: with them L^(n+1) - L^n is exactly the angular impulse of
// what acts from outside, L^(n+1) - L^n = (dt/2) [sum x^n x (Omega f_ext + R)^n + sum x^(n+1) x (Omega f_ext + R)*].
#include "engine/angular_momentum.hpp"

#include <Eigen/Dense>

#include "engine/forces.hpp"
#include "kernels/angular_momentum_part.hpp"

namespace nanson {
namespace {

static_assert(moment_count <= part_row);

}  // namespace

void sum_moments(const Simulation& s, const Rows& rows, const double* arms, int part, const Scratch& scratch) {
  const Part& p = s.domain.order.parts[static_cast<std::size_t>(part)];
  const double o[3] = {s.state.arm_origin[0], s.state.arm_origin[1], s.state.arm_origin[2]};
  moments_part(p, nodes_of(s.domain, p), rows.X, s.domain.step_length.data(), arms, o, scratch,
               s.team.part_rows[static_cast<std::size_t>(part)].data());
}

/// lambda_0 + lambda x y without a resultant is lambda x (y - c), c the centre of volume: of the six equations three remain,
/// sum Omega [|r|^2 I - r (x) r] lambda = -torque with r = y - c, which is well scaled wherever the body is and however small.
double keep_angular_momentum(Simulation& s, const Rows& rows, const Coefficients& k, const double* arms) {
  const auto m = tree_sums<moment_count>(s);
  const Vec3 outside = resultant(s, arms, s.state.arm_origin).torque;
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
