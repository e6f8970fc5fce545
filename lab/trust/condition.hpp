// What is measured: which errors a sensor makes, and what is done with its image.
#pragma once

#include <string>
#include <vector>

#include "berth/self_filter/settings.hpp"

namespace berth::lab {

/// What is wrong with the image; each 0 is off, tests/support/sensor_model.hpp says what they mean.
struct ImageErrors {
  double step_m_at_1m = 0;
  double noise_m_at_1m = 0;
  double dropout_share = 0;
  double mixed_share = 0;
  int outline_px = 0;
  bool operator==(const ImageErrors&) const = default;
};

/// Like a Kinect's.
inline constexpr ImageErrors kKinectErrors{.step_m_at_1m = 0.003,
                                           .noise_m_at_1m = 0.0015,
                                           .dropout_share = 0.02,
                                           .mixed_share = 0.1,
                                           .outline_px = 2};

/// What is wrong with where berth believes that the robot is.
struct PoseErrors {
  double offset_m = 0;
  double angle_rad = 0;
  double delay_s = 0;
  bool operator==(const PoseErrors&) const = default;
};

/// Joints move at random at up to this (testing::delayed).
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
  ImageErrors image = {};
  PoseErrors pose = {};
  MeasuredFilter filter = MeasuredFilter::berth;
  SelfFilterSettings self_filter = {};
  MeasuredMetric metric = MeasuredMetric::hirt;
  /// Whether the doubtful distance counts where there is one (LinkVisibility).
  bool counts_doubtful = false;
};

/// In the order of the report; those of one table follow each other.
std::vector<Condition> all_conditions();

/// The index of the pipeline with default settings on a clean image.
std::size_t first_of_pipeline(const std::vector<Condition>& conditions);

}  // namespace berth::lab
