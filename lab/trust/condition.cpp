#include "lab/trust/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace berth::lab {
namespace {

struct NamedErrors {
  const char* name;
  sim::SensorErrors image = {};
  PoseErrors pose = {};
};

const std::array kSingleErrors = {
    NamedErrors{"disparity in steps of 3 mm z²", {.step_m_at_1m = 0.003}},
    NamedErrors{"noise of 1.5 mm z²", {.noise_m_at_1m = 0.0015}},
    NamedErrors{"noise of 5 mm z²", {.noise_m_at_1m = 0.005}},
    NamedErrors{"10 % dropouts", {.dropout_share = 0.1}},
    NamedErrors{"20 % mixed pixels at edges", {.mixed_share = 0.2}},
    NamedErrors{"dark outlines of 3 px", {.outline_px = 3}},
    NamedErrors{"calibration off by 1 cm", {}, {.offset_m = 0.01}},
    NamedErrors{"calibration off by 2 cm", {}, {.offset_m = 0.02}},
    NamedErrors{"calibration off by 3 cm", {}, {.offset_m = 0.03}},
    NamedErrors{"calibration off by 0.5°", {}, {.angle_rad = 0.0087}},
    NamedErrors{"joints 10 ms old", {}, {.delay_s = 0.01}},
    NamedErrors{"joints 20 ms old", {}, {.delay_s = 0.02}},
    NamedErrors{"joints 50 ms old", {}, {.delay_s = 0.05}},
};

const std::array kSensors = {
    NamedErrors{"clean image"},
    NamedErrors{"sensor", sim::kKinectErrors},
    NamedErrors{"sensor, 1 cm and 0.2° off, 10 ms", sim::kKinectErrors, {0.01, 0.0035, 0.01}},
    NamedErrors{"sensor, 3 cm and 0.5° off, 50 ms", sim::kKinectErrors, {0.03, 0.0087, 0.05}},
};

struct NamedSettings {
  const char* name;
  SelfFilterSettings settings;
  bool counts_rejected = false;
};

std::vector<NamedSettings> filter_settings() {
  const auto make = [](double tolerance_m, double padding_m, double flying_patch_radius_m) {
    SelfFilterSettings settings;
    settings.tolerance_m = tolerance_m;
    settings.padding_m = padding_m;
    settings.flying_patch_radius_m = flying_patch_radius_m;
    return settings;
  };
  return {{"defaults: 5 cm, 2 cm, flying patches", {}},
          {"defaults, the rejected distance where there is one", {}, true},
          {"5 cm, 2 cm", make(0.05, 0.02, 0)},
          {"2 cm, 1 cm", make(0.02, 0.01, 0)},
          {"1 cm, 0 cm", make(0.01, 0, 0)},
          {"1 mm, 0 cm", make(0.001, 0, 0)}};
}

void add_distance_alone(std::vector<Condition>& conditions) {
  const char* table = "The distance alone, ideal filter, clean image";
  for (const auto& [name, metric] :
       {std::pair("berth: gray area of Hirt 2.14", MeasuredMetric::hirt),
        std::pair("gray area by the nearest point of the hidden ray", MeasuredMetric::hidden_ray),
        std::pair("no gray area: the reading itself", MeasuredMetric::reading)}) {
    conditions.push_back({table, name, {}, {}, MeasuredFilter::ideal, {}, metric});
  }
}

void add_errors(const char* table, MeasuredFilter filter, std::vector<Condition>& conditions) {
  const auto add = [&](const NamedErrors& errors) {
    conditions.push_back({table, errors.name, errors.image, errors.pose, filter});
  };
  add(kSensors.front());
  std::for_each(kSingleErrors.begin(), kSingleErrors.end(), add);
  std::for_each(kSensors.begin() + 1, kSensors.end(), add);
}

}  // namespace

std::vector<Condition> all_conditions() {
  std::vector<Condition> conditions;
  add_distance_alone(conditions);
  add_errors("Errors, ideal filter", MeasuredFilter::ideal, conditions);
  add_errors("Errors, berth's self filter with default settings", MeasuredFilter::berth,
             conditions);
  for (const NamedErrors& errors : kSensors) {
    for (const NamedSettings& settings : filter_settings()) {
      conditions.push_back({fmt::format("Settings of the self filter: {}", errors.name),
                            settings.name, errors.image, errors.pose, MeasuredFilter::berth,
                            settings.settings, MeasuredMetric::hirt, settings.counts_rejected});
    }
  }
  return conditions;
}

std::size_t first_of_pipeline(const std::vector<Condition>& conditions) {
  const auto first = std::find_if(conditions.begin(), conditions.end(), [](const Condition& c) {
    return c.filter == MeasuredFilter::berth;
  });
  return static_cast<std::size_t>(first - conditions.begin());
}

}  // namespace berth::lab
