// Tensor algebra: the identities of the tensor cross product (paper, section 2.1.1).
#include "kernels/tensor.hpp"

#include <gtest/gtest.h>

#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

/// e_ijk.
int permutation(int i, int j, int k) { return (j - i) * (k - i) * (k - j) / 2; }

/// [A x B]_iI = e_ijk e_IJK A_jJ B_kK, summed as it stands.
Tensor<double> cross_by_definition(const Tensor<double>& A, const Tensor<double>& B) {
  Tensor<double> R{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int I = 0; I < 3; ++I)
          for (int J = 0; J < 3; ++J)
            for (int K = 0; K < 3; ++K) R[i][I] += permutation(i, j, k) * permutation(I, J, K) * A[j][J] * B[k][K];
  return R;
}

void expect_equal(const Tensor<double>& A, const Tensor<double>& B, double tolerance) {
  EXPECT_LE(largest_entry(sum(A, B, -1)), tolerance);
}

}  // namespace

TEST(Tensor, CrossIsItsDefinition) {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> A = random_tensor(random), B = random_tensor(random);
    expect_equal(cross(A, B), cross_by_definition(A, B), 1e-14);
  }
}

TEST(Tensor, CrossIsSymmetric) {
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> A = random_tensor(random), B = random_tensor(random);
    expect_equal(cross(A, B), cross(B, A), 1e-15);
  }
}

TEST(Tensor, CofactorIsHalfOfFCrossF) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> F = random_tensor(random), FxF = cross(F, F);
    expect_equal(cofactor(F), sum(Tensor<double>{}, FxF, 0.5), 1e-15);
  }
}

TEST(Tensor, DeterminantIsASixthOfFDoubleDotFCrossF) {
  Random random(4);
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> F = random_tensor(random);
    EXPECT_NEAR(determinant(F, cofactor(F)), contract(F, cross(F, F)) / 6, 1e-15);
  }
}

TEST(Tensor, CofactorTimesFTransposedIsTheDeterminant) {
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> F = random_tensor(random), H = cofactor(F);
    const Tensor<double> scaled = sum(Tensor<double>{}, identity<double>(), determinant(F, H));
    expect_equal(product(transposed(F), H), scaled, 1e-15);
    expect_equal(product(F, transposed(H)), scaled, 1e-15);
  }
}

TEST(Tensor, DeterminantOfAProductIsTheProduct) {
  Random random(6);
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> A = random_tensor(random), B = random_tensor(random), AB = product(A, B);
    EXPECT_NEAR(determinant(AB, cofactor(AB)), determinant(A, cofactor(A)) * determinant(B, cofactor(B)), 1e-14);
  }
}

TEST(Tensor, ContractSumsTheProductsOfAllEntries) {
  Tensor<double> A, B;
  for (int k = 0; k < 9; ++k) {
    A.a[k / 3][k % 3] = k + 1;
    B.a[k / 3][k % 3] = std::pow(10, k);
  }
  EXPECT_EQ(contract(A, B), 987654321.0);
}

TEST(Tensor, LanesHaveTheBitsOfTheScalar) {
  Random random(7);
  Tensor<double> A[8], B[8];
  Tensor<Vec8> A8, B8;
  for (int n = 0; n < 8; ++n) {
    A[n] = random_tensor(random);
    B[n] = random_tensor(random);
    for (int k = 0; k < 9; ++k) {
      A8.a[k / 3][k % 3][n] = A[n].a[k / 3][k % 3];
      B8.a[k / 3][k % 3][n] = B[n].a[k / 3][k % 3];
    }
  }
  const Tensor<Vec8> H = cofactor(A8), AxB = cross(A8, B8);
  const Vec8 dot = contract(A8, B8), det = determinant(A8, H);
  for (int n = 0; n < 8; ++n) {
    for (int k = 0; k < 9; ++k) {
      EXPECT_EQ(H.a[k / 3][k % 3][n], cofactor(A[n]).a[k / 3][k % 3]);
      EXPECT_EQ(AxB.a[k / 3][k % 3][n], cross(A[n], B[n]).a[k / 3][k % 3]);
    }
    EXPECT_EQ(dot[n], contract(A[n], B[n]));
    EXPECT_EQ(det[n], determinant(A[n], cofactor(A[n])));
  }
}
