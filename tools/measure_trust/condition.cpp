#include "condition.hpp"

#include <algorithm>
#include <array>

namespace berth {
namespace {

/// A Kinect-like sensor with a good calibration.
constexpr SensorErrors kSensor{.step_m_at_1m = 0.003,
                               .noise_m_at_1m = 0.0015,
                               .dropout_share = 0.02,
                               .mixed_share = 0.1,
                               .outline_px = 2};

/// The sensor on a robot whose calibration is off by a length and an angle, with old joints.
SensorErrors sensor_with(double calibration_m, double calibration_rad, double delay_s) {
  SensorErrors errors = kSensor;
  errors.calibration_m = calibration_m;
  errors.calibration_rad = calibration_rad;
  errors.delay_s = delay_s;
  return errors;
}

struct Named {
  const char* name;
  SensorErrors errors;
};

const std::array kErrors = {
    Named{"none: the clean image", {}},
    Named{"disparity in steps of 3 mm z²", {.step_m_at_1m = 0.003}},
    Named{"noise of 1.5 mm z²", {.noise_m_at_1m = 0.0015}},
    Named{"noise of 5 mm z²", {.noise_m_at_1m = 0.005}},
    Named{"10 % dropouts", {.dropout_share = 0.1}},
    Named{"20 % mixed pixels at edges", {.mixed_share = 0.2}},
    Named{"dark outlines of 3 px", {.outline_px = 3}},
    Named{"calibration off by 1 cm", {.calibration_m = 0.01}},
    Named{"calibration off by 2 cm", {.calibration_m = 0.02}},
    Named{"calibration off by 3 cm", {.calibration_m = 0.03}},
    Named{"calibration off by 0.5°", {.calibration_rad = 0.0087}},
    Named{"joints 10 ms old", {.delay_s = 0.01}},
    Named{"joints 20 ms old", {.delay_s = 0.02}},
    Named{"joints 50 ms old", {.delay_s = 0.05}},
    Named{"a sensor: steps, noise, 2 % dropouts, 10 % mixed, 2 px dark", kSensor},
    Named{"the sensor, 1 cm and 0.2° off, 10 ms", sensor_with(0.01, 0.0035, 0.01)},
    Named{"the sensor, 3 cm and 0.5° off, 50 ms", sensor_with(0.03, 0.0087, 0.05)},
};

struct NamedSettings {
  const char* name;
  SelfFilterSettings settings;
};

std::vector<NamedSettings> filter_settings() {
  const auto make = [](double tolerance_m, double padding_m, double edge_jump_m,
                       double island_radius_m) {
    SelfFilterSettings settings;
    settings.tolerance_m = tolerance_m;
    settings.padding_m = padding_m;
    settings.edge_jump_m = edge_jump_m;
    settings.island_radius_m = island_radius_m;
    return settings;
  };
  return {{"defaults: 5 cm, 2 cm, edges, islands", {}},
          {"no islands: 5 cm, 2 cm, edges", make(0.05, 0.02, 0.03, 0)},
          {"5 cm, 2 cm", make(0.05, 0.02, 0, 0)},
          {"2 cm, 1 cm", make(0.02, 0.01, 0, 0)},
          {"1 cm, 0 cm", make(0.01, 0, 0, 0)},
          {"1 mm, 0 cm", make(0.001, 0, 0, 0)}};
}

void add_distance_alone(std::vector<Condition>& conditions) {
  const char* table = "The distance alone, ideal filter, clean image";
  for (const auto& [name, metric] :
       {std::pair("berth: gray area of Hirt 2.14", MeasuredMetric::hirt),
        std::pair("gray area by the nearest point of the hidden ray", MeasuredMetric::hidden_ray),
        std::pair("no gray area: the reading itself", MeasuredMetric::reading)}) {
    conditions.push_back({table, name, {}, MeasuredFilter::ideal, {}, metric});
  }
}

}  // namespace

std::vector<Condition> all_conditions() {
  std::vector<Condition> conditions;
  add_distance_alone(conditions);
  for (const Named& named : kErrors) {
    conditions.push_back(
        {"Sensor errors, ideal filter", named.name, named.errors, MeasuredFilter::ideal});
  }
  for (const Named& named : kErrors) {
    conditions.push_back({"The whole pipeline, default settings", named.name, named.errors});
  }
  for (const Named& named : {kErrors[0], kErrors[14], kErrors[15], kErrors[16]}) {
    for (const NamedSettings& settings : filter_settings()) {
      conditions.push_back(
          {std::string("Settings of the self filter (tolerance, padding), ") + named.name,
           settings.name, named.errors, MeasuredFilter::berth, settings.settings});
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

}  // namespace berth
