// Arrays of rows: where they start, and that placing large ones leaves nothing behind.
#include "engine/aligned.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstdint>

namespace nanson {
namespace {

bool starts_on(const Aligned<double>& x, std::size_t bytes) {
  return reinterpret_cast<std::uintptr_t>(x.data()) % bytes == 0;
}

TEST(Aligned, ArraysStartOnACacheLineAndLargeOnesOnAHugePage) {
  constexpr std::size_t large = CacheLineAllocator<double>::huge_page / sizeof(double);
  for (const std::size_t n : {std::size_t{1}, std::size_t{7}, std::size_t{4095}, large - 1})
    EXPECT_TRUE(starts_on(Aligned<double>(n), 64)) << n;
  for (const std::size_t n : {large, large + 1, 3 * large + 511})
    EXPECT_TRUE(starts_on(Aligned<double>(n), CacheLineAllocator<double>::huge_page)) << n;
}

TEST(Aligned, LargeArraysHoldWhatTheyWereGivenOnAnyThreads) {
  constexpr std::size_t n = 2 * CacheLineAllocator<double>::huge_page / sizeof(double)
                            + 1;  // one number on its last page
  for (const int threads : {1, 2, 3, 8}) {
    omp_set_num_threads(threads);
    const Aligned<double> x(n, 0.25);
    double sum = 0;
    for (const double value : x) sum += value;
    EXPECT_EQ(sum, 0.25 * n);
    std::vector<Aligned<double>> of_thread(4);
#pragma omp parallel for num_threads(4)
    for (int t = 0; t < 4; ++t) of_thread[static_cast<std::size_t>(t)].assign(n, t);
    for (int t = 0; t < 4; ++t)
      EXPECT_EQ(of_thread[static_cast<std::size_t>(t)].front() + of_thread[static_cast<std::size_t>(t)].back(),
                2.0 * t);
  }
  omp_set_num_threads(omp_get_num_procs());
}

}  // namespace
}  // namespace nanson
