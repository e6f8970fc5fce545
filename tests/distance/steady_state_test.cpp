// A program of its own, because it replaces the global operator new.
#include <cstdlib>
#include <new>

#include "tests/distance/answer.hpp"

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

namespace berth::testing {
namespace {

TEST(SteadyState, ExactAllocatesNothingOnceItHasSeenTheScene) {
  const ImagePair images[] = {random_images(1, 160, 120, 8), random_images(2, 160, 120, 8)};
  ObstacleTree tree;
  EvaluateWorkspace workspace;
  LinkDistances out;
  const auto answer_both = [&] {
    for (const ImagePair& pair : images) {
      build_obstacle_tree(pair.obstacle_depth_m, tree);
      evaluate(Method::exact, pair.camera, pair.robot, pair.obstacle_depth_m, tree, 8, {1.0, true},
               workspace, out);
    }
  };
  answer_both();
  const std::size_t before = allocations;
  answer_both();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(before, 0u);
}

}  // namespace
}  // namespace berth::testing
