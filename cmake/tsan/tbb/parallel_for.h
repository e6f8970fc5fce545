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

/// Calls loop(body') with a body' that is `body` between begin and end of the loop.
template <class Body, class Loop>
void in_order_with_the_caller(const Body& body, const Loop& loop) {
  char begin, end;
  __tsan_release(&begin);
  loop([&](const auto& part) {
    __tsan_acquire(&begin);
    body(part);
    __tsan_release(&end);
  });
  __tsan_acquire(&end);
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
