#pragma once

#include "lab/bench/bench.hpp"
#include "lab/bench/extent.hpp"

namespace berth::lab {

/// The part of run_benchmarks() for settings with a gl_device.
void run_gl_benchmarks(const BenchSettings& settings, const BenchExtent& extent);

}  // namespace berth::lab
