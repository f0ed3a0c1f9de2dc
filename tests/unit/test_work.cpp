// The flop counter against a count by hand, and the model's sums.
#include <gtest/gtest.h>

#include "engine/counted.hpp"
#include "engine/work.hpp"

namespace nanson {
namespace {

TEST(Work, CountsOperations) {
  Counted::flops = 0;
  const Counted a = 2.0, b = 3.0, c = fma(a, b, a) / b - root(a);
  EXPECT_EQ(Counted::flops, 5);  // fma two, division, root, difference
  EXPECT_DOUBLE_EQ(c.value, 8.0 / 3 - std::sqrt(2.0));
  Tensor<Counted> F = identity<Counted>();
  Counted::flops = 0;
  const auto cof = cofactor(F);
  EXPECT_EQ(Counted::flops, 27);
  determinant(F, cof);
  EXPECT_EQ(Counted::flops, 32);
}

TEST(Work, AStepIsItsStagesAndWhatIsLeftOutCostsNothing) {
  Order o;
  o.nodes = 100;
  o.out = {700};
  o.in = {650};
  o.corner = {30};
  const Sizes s(o);
  PhysicsSpec pFJ, pF, full, constant;
  pF.formulation = Formulation::pF;
  full.flux_correction = FluxCorrection::full;
  constant.reconstruction = Reconstruction::constant;
  EXPECT_DOUBLE_EQ(step_work(pFJ, s, 100, 3).flops, 1.5 * step_work(pFJ, s, 100, 2).flops);
  EXPECT_DOUBLE_EQ(step_work(pFJ, s, 100, 3).bytes, 1.5 * step_work(pFJ, s, 100, 2).bytes);
  EXPECT_LT(step_work(pF, s, 100, 2).flops, step_work(pFJ, s, 100, 2).flops);
  EXPECT_LT(step_work(constant, s, 100, 2).bytes, step_work(pFJ, s, 100, 2).bytes);
  EXPECT_GT(step_work(full, s, 100, 2).bytes, step_work(pFJ, s, 100, 2).bytes);
  EXPECT_LT(step_work(full, s, 100, 2).flops,
            2.0 / 3 * step_work(full, s, 100, 3).flops);  // found once in two stages, in each of three
  EXPECT_DOUBLE_EQ(step_work(pFJ, s, 100, 2, true).flops - step_work(pFJ, s, 100, 2).flops, 2 * 17 * s.edges);
  EXPECT_DOUBLE_EQ(step_work(pFJ, s, 150, 2).flops - step_work(pFJ, s, 100, 2).flops, 2 * 50 * 100);
}

TEST(Work, RowsThatAreWrittenPastTheCachesAreNotFetchedFirst) {
  const auto bytes_per_node = [](int nodes) {
    Order o;
    o.nodes = nodes;
    o.out = {0};
    o.in = {0};
    o.corner = {0};
    return stress_work(Carried(PhysicsSpec{}), Sizes(o), 0, true).bytes / nodes;
  };
  EXPECT_DOUBLE_EQ(bytes_per_node(streaming_nodes), 8 * (row::U + 1 + row::W + row::PH));
  EXPECT_DOUBLE_EQ(bytes_per_node(streaming_nodes - 1), 8 * (row::U + 1 + 2 * (row::W + row::PH)));
}

}  // namespace
}  // namespace nanson
