// A program of its own, because it replaces the global operator new.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <new>

#include "berth/self_filter/self_filter.hpp"
#include "tests/self_filter/random_scene.hpp"

namespace {
std::size_t allocations = 0;

void* count_and_allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, rounded);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return count_and_allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return count_and_allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace berth {
namespace {

TEST(SteadyState, TheSelfFilterAllocatesNothingOnceItHasSeenTheImages) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    RandomScene scene = random_scene(seed);
    scene.settings.dilation_px = 3;
    SelfFilterWorkspace workspace;
    ObstacleImage out;
    const auto filter = [&] {
      self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings, workspace, out);
    };
    filter();
    const std::size_t before = allocations;
    filter();
    EXPECT_EQ(allocations, before);
    EXPECT_GT(before, 0u);
  }
}

}  // namespace
}  // namespace berth
