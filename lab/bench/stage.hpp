// One stage of the pipeline, timed run by run.
#pragma once

#include <string>
#include <vector>

#include "lab/bench/table.hpp"
#include "lab/measure/stopwatch.hpp"

namespace berth::lab {

/// The runs of one stage, by the clock on the wall.
struct Stage {
  std::string name;
  std::vector<double> times_ms = {};

  template <class Call>
  void take(Call call) {
    const Stopwatch watch;
    call();
    times_ms.push_back(watch.ms());
  }
};

/// A row for each stage: median, p99 and maximum of its runs.
Table table_of(const std::string& title, const std::string& note,
               const std::vector<Stage*>& stages);

}  // namespace berth::lab
