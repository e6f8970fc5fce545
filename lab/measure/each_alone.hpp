#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace berth::lab {

/// Calls work(i) for each i below count, on all threads of TBB. No call begins on top of another
/// one, as it would where a thread waits in that for TBB.
template <class Work>
void each_alone(int count, const Work& work) {
  tbb::parallel_for(0, count, [&](int i) { tbb::this_task_arena::isolate([&] { work(i); }); });
}

}  // namespace berth::lab
