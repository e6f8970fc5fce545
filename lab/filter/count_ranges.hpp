#pragma once

#include <string>

#include "lab/filter/filter_grid.hpp"
#include "lab/filter/judged_recording.hpp"

namespace berth::lab {

/// How many links' distances lie where.
struct RangeCount {
  int in_range = 0;
  int too_far = 0;    ///< by more than kFarMargin_m
  int a_bit_far = 0;  ///< by less
  int too_near = 0;

  void add(double distance_m, const ExpectedRange& range);
  RangeCount& operator+=(const RangeCount& other);
};

struct RecordingCount {
  RangeCount checked;
  RangeCount estimated;
  /// The same with the rejected distance where there is one.
  RangeCount rejected;
};

/// All views with these settings, on all threads that TBB gives.
RecordingCount count_ranges(const JudgedRecording& recording, const FilterChoice& choice);

/// Cells of a Markdown table: checked rows in range, a bit far, too far, too near; the same of the
/// estimates; the rows too far by the smaller of distance and rejected distance.
extern const char* const kCountHeading;
std::string cells_of(const RecordingCount& count);

}  // namespace berth::lab
