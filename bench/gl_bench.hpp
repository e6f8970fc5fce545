#pragma once

#include "bench/bench.hpp"
#include "bench/extent.hpp"

namespace berth::bench {

/// The part of run_benchmarks() for settings with a gl_device.
void run_gl_benchmarks(const BenchSettings& settings, const Extent& extent);

}  // namespace berth::bench
