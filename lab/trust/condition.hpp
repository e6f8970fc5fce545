// A condition of a trial: which errors a sensor makes, and what is done with its image.
#pragma once

#include <string>
#include <vector>

#include "berth/self_filter/settings.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {

/// Errors of the pose at which berth believes the robot to be.
struct PoseErrors {
  double offset_m = 0;
  double angle_rad = 0;
  double delay_s = 0;
  bool operator==(const PoseErrors&) const = default;
};

/// Joints move at random at up to this (sim::delayed).
inline constexpr double kTrialJointSpeed_per_s = 1.0;

enum class MeasuredFilter {
  ideal,  ///< removes the pixels that show the robot, and nothing else
  berth,  ///< the self filter
};

enum class MeasuredMetric {
  hirt,        ///< berth's (Hirt 2.14)
  reading,     ///< without gray area
  hidden_ray,  ///< the nearest point of the hidden part of the ray
};

struct Condition {
  std::string table;
  std::string name;
  sim::SensorErrors image = {};
  PoseErrors pose = {};
  MeasuredFilter filter = MeasuredFilter::berth;
  SelfFilterSettings self_filter = {};
  MeasuredMetric metric = MeasuredMetric::hirt;
  /// Whether the rejected distance counts where there is one (LinkVisibility).
  bool counts_rejected = false;
};

/// In the order of the report; those of one table follow each other.
std::vector<Condition> all_conditions();

/// The index of the pipeline with default settings on a clean image.
std::size_t first_of_pipeline(const std::vector<Condition>& conditions);

}  // namespace berth::lab
