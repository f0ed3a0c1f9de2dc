// The one list of a state's arrays: what it says is kept is enough to go on, what it says is work is written before it is read.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/method/scenes.hpp"

namespace nanson::method {
namespace {

TEST(State, WorkArraysAreWrittenBeforeTheyAreRead) {
  for (const Scene& scene : scenes_with_all_rows()) {
    const Problem problem(scene);
    Simulation s = problem.start(), spoilt = problem.start();
    for (int round = 0; round < 3; ++round) {
      march(s, 2);
      each_array(spoilt.domain, spoilt.state, [](const ArrayRole& role, Aligned<double>& array) {
        if (role.keep == Keep::work) std::fill(array.begin(), array.end(), 7e77);  // finite: solvers start with 0 times
      });
      march(spoilt, 2);
    }
    EXPECT_EQ(state_hash(s), state_hash(spoilt)) << name(scene.physics) << ' ' << word(scene.physics.description);
    EXPECT_EQ(s.books.external_work, spoilt.books.external_work) << name(scene.physics);
    EXPECT_EQ(s.books.dissipated, spoilt.books.dissipated) << name(scene.physics);
    EXPECT_EQ(s.books.impulse, spoilt.books.impulse) << name(scene.physics);
    EXPECT_EQ(s.books.angular_impulse, spoilt.books.angular_impulse) << name(scene.physics);
  }
}

TEST(State, ArraysAreThereExactlyWhereTheSceneNeedsThem) {
  std::size_t carried = 0;
  for (const Scene& scene : scenes_with_all_rows()) {
    const Problem problem(scene);
    const Simulation s = problem.start();
    double doubles = 0;
    each_array(s.domain, s.state, [&](const ArrayRole& role, const Aligned<double>& array) {
      EXPECT_EQ(array.size(), role.size) << role.name;
      doubles += static_cast<double>(role.size);
      carried += role.size > 0;
    });
    EXPECT_EQ(static_cast<double>(bytes_of(s.domain, s.state)), 8 * doubles);
  }
  EXPECT_GT(carried, 17 * 8u);
}

}  // namespace
}  // namespace nanson::method
