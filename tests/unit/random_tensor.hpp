// Random numbers and tensors for tests, from a fixed seed.
#pragma once
#include <cmath>
#include <numbers>
#include <random>

#include "kernels/tensor.hpp"

namespace nanson::test {

using Random = std::mt19937_64;

/// In [least, most), the same on every platform.
inline double uniform(Random& random, double least, double most) {
  return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

inline Tensor<double> random_tensor(Random& random) {
  Tensor<double> A;
  for (int k = 0; k < 9; ++k) A.a[k / 3][k % 3] = uniform(random, -1, 1);
  return A;
}

inline Tensor<double> product(const Tensor<double>& A, const Tensor<double>& B) {
  Tensor<double> R{};
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I)
      for (int k = 0; k < 3; ++k) R[i][I] += A[i][k] * B[k][I];
  return R;
}

inline Tensor<double> transposed(const Tensor<double>& A) {
  Tensor<double> R;
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) R[i][I] = A[I][i];
  return R;
}

/// A + s B.
inline Tensor<double> sum(const Tensor<double>& A, const Tensor<double>& B, double s = 1) {
  Tensor<double> R;
  for (int k = 0; k < 9; ++k) R.a[k / 3][k % 3] = A.a[k / 3][k % 3] + s * B.a[k / 3][k % 3];
  return R;
}

inline double largest_entry(const Tensor<double>& A) {
  double m = 0;
  for (int k = 0; k < 9; ++k) m = std::fmax(m, std::fabs(A.a[k / 3][k % 3]));
  return m;
}

/// Rotation of a random unit quaternion.
inline Tensor<double> random_rotation(Random& random) {
  double q[4], size = 0;
  while (size < 0.01 || size > 1) {
    size = 0;
    for (double& c : q) {
      c = uniform(random, -1, 1);
      size += c * c;
    }
  }
  const double s = 2 / size, w = q[0], x = q[1], y = q[2], z = q[3];
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

/// Deformation gradient with random principal directions and stretches, log-uniform in [least, most].
inline Tensor<double> random_F(Random& random, double least, double most) {
  Tensor<double> stretch{};
  for (int i = 0; i < 3; ++i) stretch[i][i] = std::exp(uniform(random, std::log(least), std::log(most)));
  return product(product(random_rotation(random), stretch), random_rotation(random));
}

}  // namespace nanson::test
