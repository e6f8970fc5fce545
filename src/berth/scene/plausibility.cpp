#include "berth/scene/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "berth/pipeline/frame.hpp"
#include "berth/scene/simple_mistakes.hpp"

namespace berth {
namespace {

/// Explanations that are this near to the best one are told beside it.
constexpr double kAlike = 0.05;
/// One that has most of the robot outside of the image counts as if it saw this share of what fits
/// in the best of them.
constexpr double kLeastSeen = 0.25;

int with_reading(const RobotReadings& readings) {
  return readings.judged() + readings.before + readings.hidden;
}

/// Somebody who hides the robot is no mistake. Readings up to kHidden_m before it are counted: a
/// robot that is nearer than it should be is one.
double share_at_robot(const RobotReadings& readings, double least_seen) {
  return readings.at_surface / std::max<double>(readings.judged() + readings.before, least_seen);
}

/// How many of a camera's readings there are, and whether they differ.
struct ReadingRange {
  std::size_t pixels = 0;
  std::size_t readings = 0;
  float least_m = std::numeric_limits<float>::infinity();
  float most_m = 0;
};

ReadingRange reading_range(RobotInImages& images) {
  ReadingRange range;
  for (const std::size_t frame : images.frames()) {
    for (const float z_m : images.depth_m(images.given().images_of, frame).pixels()) {
      ++range.pixels;
      if (std::isnan(z_m)) continue;
      ++range.readings;
      range.least_m = std::min(range.least_m, z_m);
      range.most_m = std::max(range.most_m, z_m);
    }
  }
  return range;
}

bool is_same(const DepthImage& a, const DepthImage& b) {
  return std::ranges::equal(a.pixels(), b.pixels(), [](float x, float y) {
    return x == y || (std::isnan(x) && std::isnan(y));
  });
}

bool do_images_change(RobotInImages& images) {
  const std::vector<std::size_t>& frames = images.frames();
  const std::size_t camera = images.given().images_of;
  return frames.size() < 2 || std::any_of(frames.begin() + 1, frames.end(), [&](std::size_t frame) {
           return !is_same(images.depth_m(camera, frames.front()), images.depth_m(camera, frame));
         });
}

/// Whether any joint is elsewhere, by more than noise of its encoder, than in the first image.
bool does_robot_move(const CameraBelief& given) {
  constexpr double kMoved = 0.01;  // rad or m
  const std::vector<double>& first = given.positions.front();
  return std::ranges::any_of(given.positions, [&](const std::vector<double>& positions) {
    return !std::ranges::equal(positions, first,
                               [](double a, double b) { return std::abs(a - b) < kMoved; });
  });
}

/// What is wrong with images of a robot that should be in them; empty where nothing is.
std::string dead_text(RobotInImages& images, const RobotReadings& robot) {
  if (with_reading(robot) + robot.none < kLeastJudgedPixels) return {};
  const ReadingRange range = reading_range(images);
  if (static_cast<double>(range.readings) < kLeastReadOfImage * static_cast<double>(range.pixels)) {
    return "hardly a pixel of its images has a reading";
  }
  if (range.least_m == range.most_m) {
    return fmt::format("all readings of its images are the same, {:.4g} m", range.least_m);
  }
  // A robot that moved cannot be at its surface in all of them. Those of a simulation without noise
  // are the same where it stands still.
  if (robot.behind >= kLeastJudgedPixels && does_robot_move(images.given()) &&
      !do_images_change(images)) {
    return "its images do not change";
  }
  return {};
}

struct Tried {
  const SimpleMistake* mistake;
  RobotReadings readings;
  double share = 0;
};

/// Those that explain where the robot is, the best first.
std::vector<Tried> tried_mistakes(const std::vector<SimpleMistake>& mistakes,
                                  RobotInImages& images) {
  std::vector<Tried> all;
  int most = 0;
  for (const SimpleMistake& mistake : mistakes) {
    all.push_back({&mistake, images.readings(mistake.corrected)});
    most = std::max(most, all.back().readings.at_surface);
  }
  const double least_seen = std::max<double>(kLeastSeen * most, kLeastJudgedPixels);
  for (Tried& one : all) one.share = share_at_robot(one.readings, least_seen);
  std::erase_if(all, [](const Tried& one) { return one.share < one.mistake->least_share; });
  std::ranges::stable_sort(all, std::greater{}, &Tried::share);
  return all;
}

void explain(const OpenScene& scene, RobotInImages& images, CameraPlausibility& camera) {
  const double share_now = share_at_robot(camera.readings, kLeastJudgedPixels);
  if (share_now > 1 - kLeastGain) return;
  const std::vector<SimpleMistake> mistakes = simple_mistakes(scene, images);
  const std::vector<Tried> tried = tried_mistakes(mistakes, images);
  if (tried.empty() || tried[0].share < share_now + kLeastGain) return;
  camera.share_then = tried[0].share;
  for (std::size_t i = 0; i < std::min<std::size_t>(tried.size(), 2); ++i) {
    if (tried[i].share < camera.share_then - kAlike) break;
    const SimpleMistake& mistake = *tried[i].mistake;
    camera.as_if += (i == 0 ? "" : " or ") + mistake.as_if;
    if (mistake.is_of_joints) camera.in_joints.push_back(mistake.as_if);
  }
}

/// Whether the robot is much better where the scene has it, in this camera's images, than without
/// any of these mistakes in the joints.
bool contradicts(const OpenScene& scene, std::size_t number,
                 const std::vector<std::string>& in_joints) {
  RobotInImages images(scene, number);
  const double share_now = share_at_robot(images.readings(images.given()), kLeastJudgedPixels);
  return std::ranges::all_of(simple_mistakes(scene, images), [&](const SimpleMistake& mistake) {
    if (std::ranges::find(in_joints, mistake.as_if) == in_joints.end()) return true;
    const RobotReadings then = images.readings(mistake.corrected);
    return share_at_robot(then, kLeastJudgedPixels) < share_now - kLeastGain;
  });
}

std::string counted_text(const RobotReadings& readings, std::size_t frames) {
  const int seen = with_reading(readings);
  if (seen == 0)
    return fmt::format("in {} of its images no pixel of the robot has a reading", frames);
  const auto percent = [seen](int count) { return 100.0 * count / seen; };
  return fmt::format(
      "of the robot's readings in {} of its images {:.0f} % lie at its surface, {:.0f} % behind "
      "it, {:.0f} % in front of it",
      frames, percent(readings.at_surface), percent(readings.behind),
      percent(readings.before + readings.hidden));
}

}  // namespace

CameraPlausibility find_implausible(const OpenScene& scene, std::size_t number) {
  const double least = scene.cameras[number].view->settings().watch.min_at_robot;
  CameraPlausibility camera;
  camera.camera = scene.cameras[number].source.name;
  if (least == 0) return camera;
  RobotInImages images(scene, number);
  camera.frames = images.frames().size();
  if (camera.frames == 0) return camera;
  camera.readings = images.readings(images.given());
  camera.dead = dead_text(images, camera.readings);
  if (camera.dead.empty()) explain(scene, images, camera);
  camera.is_implausible = !camera.dead.empty() || !camera.as_if.empty() ||
                          (camera.readings.tells() && camera.readings.at_robot() < least);
  camera.is_hidden = !camera.is_implausible && camera.readings.is_hidden();
  return camera;
}

std::vector<CameraPlausibility> find_implausible(const OpenScene& scene) {
  std::vector<CameraPlausibility> cameras;
  for (std::size_t c = 0; c < scene.cameras.size(); ++c)
    cameras.push_back(find_implausible(scene, c));
  for (CameraPlausibility& camera : cameras) {
    for (std::size_t c = 0; c < cameras.size() && !camera.in_joints.empty(); ++c) {
      if (cameras[c].is_implausible || !cameras[c].readings.tells()) continue;
      if (contradicts(scene, c, camera.in_joints)) camera.in_joints.clear();
    }
  }
  return cameras;
}

std::string text_without_name(const CameraPlausibility& camera) {
  if (camera.is_hidden) {
    return fmt::format(
        "the robot is hidden: {:.0f} % of its readings in {} images lie in front of it; nothing "
        "tells whether it is where it should be",
        100 * camera.readings.hidden_share(), camera.frames);
  }
  if (!camera.is_implausible) return {};
  if (!camera.fits_otherwise.empty()) return camera.fits_otherwise;
  std::string text =
      fmt::format("the robot is not where it should be: {}; expected most of them at its surface",
                  counted_text(camera.readings, camera.frames));
  if (!camera.dead.empty()) return text + fmt::format(". The camera is dead: {}", camera.dead);
  if (camera.as_if.empty()) return text + ". No simple mistake explains it";
  return text + fmt::format(". {:.0f} % would, as if {}", 100 * camera.share_then, camera.as_if);
}

std::string text_of(const CameraPlausibility& camera) {
  const std::string text = text_without_name(camera);
  return text.empty() ? text : fmt::format("camera {}: {}", camera.camera, text);
}

}  // namespace berth
