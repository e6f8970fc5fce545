#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "sim/random_images.hpp"
#include "thesis/evaluate.hpp"
#include "thesis/study/errors.hpp"
#include "thesis/study/parameter_sets.hpp"

namespace berth::lab {

/// What one parameter set did on one scene.
struct Measurement {
  double time_ms = 0;
  std::int64_t pairs = 0;
  LinkErrors errors;
};

inline constexpr std::string_view kMeasurementColumns =
    "time_ms,pairs,links_in_range,links_missed,"
    "distance_error_mean_mm,distance_error_deviation_mm,distance_error_greatest_mm,"
    "robot_point_error_mean_mm,robot_point_error_deviation_mm,robot_point_error_greatest_mm,"
    "obstacle_point_error_mean_mm,obstacle_point_error_deviation_mm,"
    "obstacle_point_error_greatest_mm";
/// The errors are empty where no link has one.
std::string columns_of(const Measurement& measurement);

/// The least of what run_ms() gives in three runs, in up to 20 as long as they are short together,
/// or in one that takes longer than 30 ms.
double least_ms(const std::function<double()>& run_ms);

/// The memory of measure(), one for each thread.
struct MeasureWorkspace {
  SearchableDepth obstacles;
  EvaluateWorkspace evaluate;
  LinkDistances answer;
};

/// The time is processor time of the calling thread, from three images in memory to the answer,
/// the tree of `exact` included: least_ms(). TBB is to be held to one thread.
Measurement measure(const ParameterSet& set, const sim::ImagePair& images,
                    const LinkDistances& truth, MeasureWorkspace& workspace);

}  // namespace berth::lab
