// Stands before TBB's header of this name in the preset tsan, and nowhere else. Debian's TBB is not built with
// ThreadSanitizer, which so sees neither that a loop's iterations come after what was before the loop, nor that they come
// before what is after it. Here it is told just that. Two iterations stay without an order, so that a race between them is found.
#pragma once
#define parallel_for parallel_for_without_order
#include_next <tbb/parallel_for.h>
#undef parallel_for

#include <sanitizer/tsan_interface.h>

#include <type_traits>

namespace tbb {

/// The loop counts down what is still to be done in a frame of its own, below `frame`, and what counts to zero may be another
/// thread. The caller waits for that, and then uses the same stack again: told as an order, or it is reported as a race.
inline void come_after_what_was_below(char* frame) {
  constexpr int kDepth = 4096, kCounter = 8;
  for (int below = 0; below < kDepth; below += kCounter)
    __tsan_acquire(frame - below);
}

/// Calls loop(body') with a body' that is `body` between begin and end of the loop.
template <class Body, class Loop>
[[gnu::noinline]] void in_order_with_the_caller(const Body& body, const Loop& loop) {
  char begin, end;
  __tsan_release(&begin);
  loop([&](const auto& part) {
    __tsan_acquire(&begin);
    body(part);
    __tsan_release(&end);
  });
  __tsan_acquire(&end);
  come_after_what_was_below(static_cast<char*>(__builtin_frame_address(0)));
}

template <class Index, class Body, class... Partitioner>
  requires std::is_integral_v<Index>
void parallel_for(Index first, Index last, const Body& body, Partitioner&&... partitioner) {
  in_order_with_the_caller(body, [&](const auto& ordered) {
    parallel_for_without_order(first, last, ordered, partitioner...);
  });
}

template <class Range, class Body, class... Partitioner>
  requires(!std::is_integral_v<Range>)
void parallel_for(const Range& range, const Body& body, Partitioner&&... partitioner) {
  in_order_with_the_caller(body, [&](const auto& ordered) {
    parallel_for_without_order(range, ordered, partitioner...);
  });
}

}  // namespace tbb
