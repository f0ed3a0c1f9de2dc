// The peak of resident memory grows with what is touched and never falls.
#include "io/peak_memory.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace nanson {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr double resident = 1.125;  // of every byte: the sanitizer keeps one for eight
#else
constexpr double resident = 1;
#endif

TEST(PeakMemory, GrowsByWhatIsTouchedAndStaysWhenItIsFreed) {
  const auto before = peak_bytes();
  ASSERT_TRUE(before);
  EXPECT_GT(*before, 1e6);
  const std::size_t bytes = static_cast<std::size_t>(*before)
                            + (64u << 20);  // more than is resident now can have been freed before
  {
    const auto block = std::make_unique<char[]>(bytes);
    EXPECT_EQ(block[bytes / 2], 0);
  }  // value-initialised: every page is written
  const auto after = peak_bytes();
  ASSERT_TRUE(after);
  EXPECT_GE(*after, static_cast<double>(bytes));
  EXPECT_LT(*after, *before + resident * static_cast<double>(bytes) + 16e6);
}

}  // namespace
}  // namespace nanson
