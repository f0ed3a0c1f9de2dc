// A step allocates nothing: every operator new of this program counts while it is asked to.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "scenes.hpp"

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment + (size == 0 ? alignment : 0));
}

void* counted_or_throw(std::size_t size, std::size_t alignment) {
  void* p = counted(size, alignment);
  if (!p) throw std::bad_alloc();
  return p;
}

}  // namespace

constexpr std::size_t plain = alignof(std::max_align_t);
void* operator new(std::size_t size) { return counted_or_throw(size, plain); }
void* operator new[](std::size_t size) { return counted_or_throw(size, plain); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted(size, plain); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted(size, plain); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted_or_throw(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace nanson::method {
namespace {

long allocations_of_three_steps(Simulation& s) {
  march(s, 2);
  allocations = 0;
  counting = true;
  march(s, 3);
  counting = false;
  return allocations;
}

TEST(Allocation, TheCounterCounts) {
  allocations = 0;
  counting = true;
  {
    std::vector<double> usual(10);
    Aligned<double> aligned(10);
  }
  counting = false;
  EXPECT_EQ(allocations, 2);
}

TEST(Allocation, AStepAllocatesNothing) {
  for (bool energy : {false, true})
    for (int threads : {1, 2})
      for (const PhysicsSpec& physics : every_physics())
        for (auto integrator : integrators) {
          Scene scene = loaded_bar(3);
          scene.physics = physics;
          scene.time.integrator = integrator;
          scene.monitor.energy = energy;
          scene.physics.keep_angular_momentum = energy && integrator == Integrator::tvd_rk2;
          const Problem problem(scene);
          Simulation s = problem.start(threads);
          EXPECT_EQ(allocations_of_three_steps(s), 0)
              << name(physics) << ' ' << word(integrator) << (energy ? " with monitor.energy" : "");
        }
}

TEST(Allocation, AStepWithCurrentAreasAllocatesNothing) {
  for (auto description : {Description::updated, Description::pseudo_updated})
    for (auto reconstruction : {Reconstruction::constant, Reconstruction::linear})
      for (int threads : {1, 2}) {
        Scene scene = loaded_bar(3);
        scene.physics.description = description;
        scene.physics.reconstruction = reconstruction;
        scene.monitor.energy = true;
        const Problem problem(scene);
        Simulation s = problem.start(threads);
        EXPECT_EQ(allocations_of_three_steps(s), 0) << word(description);
      }
}

TEST(Allocation, AProjectedStepAllocatesNothing) {
  for (auto solver : {ProjectionSolver::cg, ProjectionSolver::pseudo_time})
    for (int threads : {1, 2}) {
      Scene scene = loaded_bar(3);
      scene.physics.formulation = Formulation::pFp;
      scene.material.poissons_ratio = 0.5;
      scene.monitor.energy = true;
      scene.projection.solver = solver;
      scene.projection.length_scale = 0.2;
      const Problem problem(scene);
      Simulation s = problem.start(threads);
      EXPECT_EQ(allocations_of_three_steps(s), 0) << word(solver);
      EXPECT_FALSE(s.breakdown);
    }
}

TEST(Allocation, AStepOfSeveralPartsOnTwoThreadsAllocatesNothing) {
  const Problem problem(loaded_bar(9));
  Simulation s = problem.start(2);
  ASSERT_GE(s.domain.order.parts.size(), 2u);
  EXPECT_EQ(allocations_of_three_steps(s), 0);
}

}  // namespace
}  // namespace nanson::method
