#include "lab/filter/count_ranges.hpp"

#include <fmt/format.h>

#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/sensor_rules.hpp"
#include "lab/measure/each_alone.hpp"
#include "lab/trust/trial.hpp"

namespace berth::lab {
namespace {

RecordingCount count_view(const JudgedView& view, const FilterChoice& choice) {
  SelfFilterWorkspace workspace;
  SensorWorkspace sensor;
  ObstacleImage obstacles;
  self_filter(view.camera, view.depth_m, view.robot, choice.filter, workspace, obstacles);
  apply_sensor_rules(view.camera, view.depth_m, view.robot, {}, choice.sensor, sensor, obstacles);
  const LinkDistances distances =
      exact_distances(view.camera, view.robot, view.link_count, obstacles.depth_m);
  const auto rejected = with_rejected(view.camera, view.robot, view.depth_m, obstacles, distances);
  RecordingCount count;
  for (std::size_t i = 0; i < view.expected.size(); ++i) {
    const ExpectedRange& range = view.expected[i];
    (range.is_checked ? count.checked : count.estimated).add(distances.links[i].distance_m, range);
    count.rejected.add(rejected[i].distance_m, range);
  }
  return count;
}

std::string cells_of(const RangeCount& count) {
  return fmt::format("| {} | {} | {} | {} ", count.in_range, count.a_bit_far, count.too_far,
                     count.too_near);
}

}  // namespace

void RangeCount::add(double distance_m, const ExpectedRange& range) {
  if (distance_m < range.min_m) {
    ++too_near;
  } else if (distance_m <= range.max_m) {
    ++in_range;
  } else if (distance_m <= range.max_m + kFarMargin_m) {
    ++a_bit_far;
  } else {
    ++too_far;  // or nothing in range at all
  }
}

RangeCount& RangeCount::operator+=(const RangeCount& other) {
  in_range += other.in_range;
  too_far += other.too_far;
  a_bit_far += other.a_bit_far;
  too_near += other.too_near;
  return *this;
}

RecordingCount count_ranges(const JudgedRecording& recording, const FilterChoice& choice) {
  const auto views = static_cast<int>(recording.views.size());
  std::vector<RecordingCount> counts(recording.views.size());
  each_alone(views, [&](int i) { counts[i] = count_view(recording.views[i], choice); });
  RecordingCount sum;
  for (const RecordingCount& count : counts) {
    sum.checked += count.checked;
    sum.estimated += count.estimated;
    sum.rejected += count.rejected;
  }
  return sum;
}

const char* const kCountHeading =
    "| checked in range | a bit far | too far | too near | estimates in range | a bit far | too "
    "far | too near | too far, rejected counted ";

std::string cells_of(const RecordingCount& count) {
  return cells_of(count.checked) + cells_of(count.estimated) +
         fmt::format("| {} ", count.rejected.too_far);
}

}  // namespace berth::lab
