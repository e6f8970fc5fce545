// measure_detected: whether what the map of detection promises is seen. Other balls, and rods as
// thick, are cast into a calibrated scene's own images, with a sensor's errors, and go through all
// that makes a frame.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "berth/calibration/drawn_ball.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/scene/calibrate_scene.hpp"
#include "berth/scene/scene_calibration.hpp"
#include "lab/calibration/judge.hpp"
#include "sim/random.hpp"
#include "sim/ray_caster.hpp"
#include "sim/sensor_model.hpp"
#include "sim/turn_between.hpp"

namespace berth::lab {
namespace {

constexpr double kRodLength_m = 0.2;
/// A reading that is left is the thing's within this. Its noise at 3 m is 1.4 cm.
constexpr float kOfThing_m = 0.05F;

/// A scene as calibration would write it, and what that says is detected.
struct CalibratedScene {
  OpenScene scene;
  DetectionMap map;
};

CalibratedScene calibrate_scene(const std::string& path) {
  const SceneFile file = read_scene_to_calibrate(path);
  const OpenScene given = open_scene(file);
  const SceneCalibrationData material = make_calibration_data(given);
  const CalibrationResult found = calibrate(material.calibration_data);
  std::vector<FilterProposal> filters;
  for (std::size_t c = 0; c < file.cameras.size(); ++c) {
    const CameraSettings& settings = file.cameras[c].settings;
    filters.push_back(propose_filter(material.calibration_data, c, found, false,
                                     settings.self_filter, settings.sensor));
  }
  DetectionMap map = measure_detection_of(material.calibration_data, found, filters, false, [] {});
  return {open_scene(with_result(file, found, filters)), std::move(map)};
}

/// A ball, or a rod that holds one in its middle.
struct Thing {
  double diameter_m = 0;
  bool is_rod = false;
  Pose X_BP = Pose::Identity();
};

TriangleMesh mesh_of(const Thing& thing) {
  return thing.is_rod ? make_cylinder(thing.diameter_m / 2, kRodLength_m)
                      : make_sphere(thing.diameter_m / 2);
}

/// In the cube of a place where the map says that it is detected; none where there is no such
/// place.
std::optional<Thing> draw_thing(sim::Random& random, const DetectionMap& map, double diameter_m,
                                bool is_rod) {
  std::vector<Eigen::Vector3d> places_B_m;
  for (std::size_t i = 0; i < map.places_B_m.size(); ++i) {
    if (map.cell.least_m[i] <= diameter_m) places_B_m.push_back(map.places_B_m[i]);
  }
  if (places_B_m.empty()) return std::nullopt;
  Thing thing{diameter_m, is_rod};
  if (is_rod) {
    thing.X_BP.linear() =
        sim::turn_between(Eigen::Vector3d::UnitZ(), sim::draw_point(random, 1).normalized())
            .toRotationMatrix();
  }
  const int place = random.whole(0, static_cast<int>(places_B_m.size()) - 1);
  thing.X_BP.translation() =
      places_B_m[static_cast<std::size_t>(place)] + sim::draw_point(random, map.step_m / 2);
  return thing;
}

/// An image with the thing in it, and the thing alone as it is seen there.
struct DrawnImage {
  DepthImage depth_m;
  DepthImage thing_m;
};

DrawnImage draw_into(const DepthImage& sensed_m, const Camera& camera, const Pose& X_BC,
                     const Thing& thing, std::uint32_t seed) {
  const TriangleMesh mesh = mesh_of(thing);
  const DepthImage cast_m = sim::RayCaster({{&mesh, thing.X_BP}}, X_BC, camera).cast_depth();
  DrawnImage drawn{sensed_m, DepthImage(camera.width_px, camera.height_px, kNoDepth)};
  DepthImage with_errors_m = sensed_m;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      if (!(cast_m(u, v) < HUGE_VALF) || sensed_m(u, v) <= cast_m(u, v)) continue;
      with_errors_m(u, v) = drawn.thing_m(u, v) = cast_m(u, v);
    }
  }
  sim::SensorErrors errors = sim::kKinectErrors;
  errors.outline_px = 0;
  sim::add_errors(errors, seed, with_errors_m);
  // The rest of the image has its own errors already.
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      if (!std::isnan(sim::nearest_around_m(drawn.thing_m, u, v))) {
        drawn.depth_m(u, v) = with_errors_m(u, v);
      }
    }
  }
  return drawn;
}

bool is_left(const DrawnImage& drawn, const ObstacleImage& obstacles) {
  for (int v = 0; v < drawn.thing_m.height(); ++v) {
    for (int u = 0; u < drawn.thing_m.width(); ++u) {
      if (std::abs(obstacles.depth_m(u, v) - drawn.thing_m(u, v)) < kOfThing_m) return true;
    }
  }
  return false;
}

struct Count {
  int promised = 0;
  int left = 0;
};

class DrawnThings {
 public:
  explicit DrawnThings(const CalibratedScene& calibrated) : calibrated_(calibrated) {
    for (const OpenCamera& camera : calibrated.scene.cameras) {
      observers_.emplace_back(camera.mounted);
    }
  }

  /// Of those that the map counts, with the thing in one image of each camera.
  Count count(double diameter_m, bool is_rod, int draws) {
    Count count;
    for (int i = 0; i < draws; ++i) {
      const auto thing = draw_thing(random_, calibrated_.map, diameter_m, is_rod);
      if (!thing) break;
      take_empty(random_(0, 1));
      if (!is_in_view(*thing)) continue;
      ++count.promised;
      count.left += is_left_by_any(*thing, static_cast<std::uint32_t>(i));
    }
    return count;
  }

 private:
  /// The images of all cameras that far through the recording.
  void take_empty(double at) {
    images_.clear();
    frames_at_.clear();
    for (std::size_t c = 0; c < observers_.size(); ++c) {
      const OpenCamera& camera = calibrated_.scene.cameras[c];
      const auto k = static_cast<std::size_t>(at * static_cast<double>(camera.source.depth.size()));
      DepthImage depth_m = camera.read_depth(k);
      observers_[c].observe(depth_m, camera.at_exposure[k], frame_);
      images_.push_back({std::move(depth_m), frame_.robot, frame_.X_BC});
      frames_at_.push_back(k);
    }
  }

  bool is_in_view(const Thing& thing) const {
    bool is_seen = false;
    for (std::size_t c = 0; c < images_.size(); ++c) {
      const BallPlace place = ball_at(calibrated_.scene.cameras[c].mounted->camera(), images_[c],
                                      thing.X_BP.translation(), thing.diameter_m / 2);
      if (!place.is_possible) return false;
      is_seen = is_seen || place.ball.has_value();
    }
    return is_seen;
  }

  bool is_left_by_any(const Thing& thing, std::uint32_t seed) {
    for (std::size_t c = 0; c < images_.size(); ++c) {
      const OpenCamera& camera = calibrated_.scene.cameras[c];
      const DrawnImage drawn =
          draw_into(images_[c].depth_m, camera.mounted->camera(), images_[c].X_BC, thing, seed);
      observers_[c].observe(drawn.depth_m, camera.at_exposure[frames_at_[c]], frame_);
      if (is_left(drawn, frame_.obstacles)) return true;
    }
    return false;
  }

  const CalibratedScene& calibrated_;
  std::vector<Observer> observers_;
  std::vector<DetectionImage> images_;
  std::vector<std::size_t> frames_at_;
  Frame frame_;
  sim::Random random_{1};
};

void measure(const std::string& file, int draws) {
  const CalibratedScene calibrated = calibrate_scene(file);
  DrawnThings things(calibrated);
  for (const double diameter_m : kDrawnDiameters_m) {
    fmt::print("| {} | {:.0f} |", calibrated.scene.file.parent_path().filename().string(),
               1000 * diameter_m);
    for (const bool is_rod : {false, true}) {
      const Count count = things.count(diameter_m, is_rod, draws);
      fmt::print(" {} of {} |", count.left, count.promised);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  CLI::App app(
      "Where calibration's map says that a ball is detected: of how many other balls, and of rods "
      "as thick, a reading is left");
  std::vector<std::string> files;
  int draws = 60;
  app.add_option("scenes", files, "scene files")->required();
  app.add_option("--draws", draws, "of each thickness, balls and rods")
      ->check(CLI::Range(1, 10000));
  if (const auto status = berth::app::parse_command_line(app, argc, argv)) return *status;
  return berth::app::carry_out("measure_detected", 0, [&] {
    fmt::print("| scene | mm | balls left | rods left |\n| --- | ---: | ---: | ---: |\n");
    for (const std::string& file : files) berth::lab::measure(file, draws);
  });
}
