#include "berth/scene/plausibility.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "berth/pipeline/frame.hpp"
#include "berth/scene/simple_mistakes.hpp"

namespace berth {
namespace {

/// Explanations that are this near to the best one are told beside it.
constexpr double kAlike = 0.05;
/// One that has most of the robot outside of the image counts as if it saw this share of what fits
/// in the best of them.
constexpr double kLeastSeen = 0.25;
/// A part with fewer of its readings at its surface is not where it should be.
constexpr double kLeastOfPart = 0.5;
constexpr double kLeastOfMendedPart = 0.8;
/// In one image alone: what a camera reads wrong at one pose looks like another place of the part.
/// On four recordings a wrong explanation had 168 at most, a right one 313 at least.
constexpr int kLeastInOneImage_px = 250;
/// Of the robot's readings, where not kLeastGain more of them lie at its surface.
constexpr double kLeastGainInPoints = 0.1;
constexpr double kLeastWithSmallGain = 0.9;
constexpr double kLeastSeenThrough = 0.05;
constexpr double kLeastClose = 0.95;

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
  /// Between the camera's near_m and far_m.
  std::size_t within_limits = 0;
  /// The farthest of these, and how many say just that.
  float farthest_m = 0;
  std::size_t farthest = 0;
  float least_m = std::numeric_limits<float>::infinity();
  float most_m = 0;
};

ReadingRange reading_range(RobotInImages& images) {
  const SceneCamera& camera = images.camera().source;
  ReadingRange range;
  for (const std::size_t frame : images.frames()) {
    for (const float z_m : images.depth_m(images.given().images_of, frame).pixels()) {
      ++range.pixels;
      if (std::isnan(z_m)) continue;
      ++range.readings;
      range.least_m = std::min(range.least_m, z_m);
      range.most_m = std::max(range.most_m, z_m);
      if (z_m < camera.near_m || z_m > camera.far_m) continue;
      ++range.within_limits;
      if (z_m > range.farthest_m) range.farthest = 0;
      range.farthest_m = std::max(range.farthest_m, z_m);
      range.farthest += z_m == range.farthest_m;
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

double share_of(std::size_t part, std::size_t all) {
  return static_cast<double>(part) / static_cast<double>(all);
}

/// Where a greatest number that many chips and formats have stands at many pixels, it is said in
/// place of no reading, and frees what it is said of.
std::string no_reading_text(const ReadingRange& range, const SceneCamera& camera) {
  constexpr std::array kGreatest{2047, 4095, 8191, 16383, 32767, 65504};
  constexpr double kLeastOfImage = 0.01;
  const auto number = static_cast<int>(
      std::lround((range.farthest_m - camera.depth_offset_m) / camera.depth_scale_m));
  if (std::ranges::find(kGreatest, number) == kGreatest.end()) return {};
  const double share = share_of(range.farthest, range.pixels);
  if (share < kLeastOfImage) return {};
  return fmt::format(
      "the number {} stands at {:.0f} % of its pixels, as if in place of no reading: a far_m below "
      "{:.4g} leaves it out",
      number, 100 * share, range.farthest_m);
}

/// The fault of its images; empty where there is none.
std::string dead_text(RobotInImages& images, const ReadingRange& range,
                      const RobotReadings& robot) {
  const SceneCamera& camera = images.camera().source;
  if (range.readings == 0) return "no pixel of its images has a reading";
  if (const std::string text = no_reading_text(range, camera); !text.empty()) return text;
  if (with_reading(robot) + robot.none < kLeastJudgedPixels) return {};
  if (share_of(range.readings, range.pixels) < kLeastReadOfImage) {
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

/// Whether its limits leave out what its images read; empty where they do not.
std::string limits_text(const ReadingRange& range) {
  if (share_of(range.within_limits, range.readings) >= kLeastReadOfImage) return {};
  return fmt::format("near_m and far_m leave out its readings, from {:.4g} to {:.4g} m",
                     range.least_m, range.most_m);
}

/// What the images say of the robot, and of each part of it that no joint bends: a heavy base
/// outvotes a wrist.
struct Tried {
  const SimpleMistake* mistake = nullptr;
  RobotReadings all;
  /// Of each of RobotModel::evaluated_links.
  std::vector<RobotReadings> of_link;
  /// By the number of the part's first link.
  std::map<std::size_t, RobotReadings> of_part;
  double share = 0;
  std::size_t frames = 0;
};

int counted(const RobotReadings& readings) { return readings.judged() + readings.before; }

/// Pixels at the surface less those that are not: a robot that is drawn too small has all of its
/// own at the surface, but fewer of them.
int points(const RobotReadings& readings) {
  return readings.at_surface - readings.behind - readings.before;
}

/// The first link of the part that no joint bends.
std::size_t part_of(const RobotModel& model, std::size_t link) {
  while (model.links[link].parent && model.links[link].joint.type == JointType::fixed)
    link = *model.links[link].parent;
  return link;
}

Tried tried(const OpenScene& scene, RobotInImages& images, const CameraBelief& belief) {
  const RobotModel& model = scene.robot->model();
  Tried found;
  found.frames = images.frames().size();
  found.of_link = images.readings_of_links(belief);
  for (std::size_t i = 0; i < found.of_link.size(); ++i) {
    found.all += found.of_link[i];
    found.of_part[part_of(model, model.evaluated_links[i])] += found.of_link[i];
  }
  return found;
}

/// Whether a part that is not where it should be is there then, and the others are no worse. Where
/// that leaves many of all readings elsewhere, the camera's pose is off, and no joint is; readings
/// in front of the part may be somebody.
bool fixes_part(const Tried& now, const Tried& then) {
  if (then.share < kLeastWithSmallGain) return false;
  const int least_px = now.frames > 1 ? kLeastJudgedPixels : kLeastInOneImage_px;
  return std::ranges::any_of(now.of_part, [&](const auto& part) {
    const RobotReadings& before = part.second;
    const RobotReadings& after = then.of_part.at(part.first);
    const int least_gain = counted(before) / 2;
    return counted(before) >= least_px && before.behind > before.before &&
           share_at_robot(before, kLeastJudgedPixels) < kLeastOfPart &&
           share_at_robot(after, kLeastSeen * counted(before)) >= kLeastOfMendedPart &&
           points(after) - points(before) >= least_gain &&
           points(then.all) - points(now.all) >= least_gain;
  });
}

/// Whether nearly all readings are close to the surface then, and more of them than now: a sensor
/// that is so good leaves no doubt. A robot that is drawn too small hides nothing that is behind
/// it.
bool is_close_then(const Tried& now, const Tried& then) {
  return counted(now.all) >= kLeastJudgedPixels &&
         then.all.close >= kLeastClose * counted(then.all) &&
         then.all.close - now.all.close >= kLeastGainInPoints * counted(now.all);
}

bool explains(const Tried& now, const Tried& then) {
  if (then.share < then.mistake->least_share) return false;
  if (then.share >= now.share + kLeastGain) return true;
  // Somebody before the robot leaves the intrinsics a choice: what is seen through it does not.
  const bool gains = points(then.all) - points(now.all) >= kLeastGainInPoints * counted(now.all) &&
                     now.all.behind - then.all.behind >= kLeastSeenThrough * counted(now.all);
  return (gains && then.share >= kLeastWithSmallGain) || is_close_then(now, then) ||
         fixes_part(now, then);
}

/// Those that explain where the robot is, the best first.
std::vector<Tried> explanations(const OpenScene& scene, RobotInImages& images, const Tried& now,
                                const std::vector<SimpleMistake>& mistakes) {
  std::vector<Tried> all;
  int most = 0;
  for (const SimpleMistake& mistake : mistakes) {
    all.push_back(tried(scene, images, mistake.corrected));
    all.back().mistake = &mistake;
    most = std::max(most, all.back().all.at_surface);
  }
  const double least_seen = std::max<double>(kLeastSeen * most, kLeastJudgedPixels);
  for (Tried& one : all) one.share = share_at_robot(one.all, least_seen);
  std::erase_if(all, [&](const Tried& one) { return !explains(now, one); });
  std::ranges::stable_sort(all, std::greater{}, [](const Tried& one) { return points(one.all); });
  return all;
}

/// Whether all that is seen of the robot is about where it should be.
bool is_in_place(const Tried& now) {
  return now.share > 1 - kLeastGain && std::ranges::all_of(now.of_part, [](const auto& part) {
           return counted(part.second) < kLeastJudgedPixels ||
                  share_at_robot(part.second, kLeastJudgedPixels) >= kLeastOfPart;
         });
}

void explain(const OpenScene& scene, RobotInImages& images, const Tried& now,
             CameraPlausibility& camera) {
  const bool in_place = is_in_place(now);
  std::vector<SimpleMistake> mistakes;
  if (!in_place) {
    mistakes = simple_mistakes(scene, images);
  } else if (now.all.behind >= kLeastSeenThrough * counted(now.all) ||
             now.all.close >= kLeastClose * counted(now.all)) {
    mistakes = optical_mistakes(scene, images);
  } else {
    mistakes = {depth_along_ray(images)};
  }
  const std::vector<Tried> all = explanations(scene, images, now, mistakes);
  if (all.empty()) return;
  camera.share_then = all[0].share;
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 2); ++i) {
    if (points(all[i].all) < points(all[0].all) - kAlike * counted(all[0].all)) break;
    const SimpleMistake& mistake = *all[i].mistake;
    camera.cause += (i == 0 ? "" : " or ") + mistake.cause;
    if (i == 0) camera.place = mistake.place;
    if (mistake.is_of_joints) camera.in_joints.push_back(mistake.cause);
  }
}

std::vector<std::string> links_seen_through(const RobotModel& model, const Tried& now) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < now.of_link.size(); ++i) {
    const RobotReadings& link = now.of_link[i];
    if (link.judged() >= kLeastJudgedPixels && link.at_robot() < kLeastOfPart)
      names.push_back(model.links[model.evaluated_links[i]].name);
  }
  return names;
}

/// Whether the robot is much better where the scene has it, in this camera's images, than without
/// any of these mistakes in the joints.
bool contradicts(const OpenScene& scene, std::size_t number,
                 const std::vector<std::string>& in_joints) {
  RobotInImages images(scene, number);
  const double share_now = share_at_robot(images.readings(images.given()), kLeastJudgedPixels);
  return std::ranges::all_of(simple_mistakes(scene, images), [&](const SimpleMistake& mistake) {
    if (std::ranges::find(in_joints, mistake.cause) == in_joints.end()) return true;
    const RobotReadings then = images.readings(mistake.corrected);
    return share_at_robot(then, kLeastJudgedPixels) < share_now - kLeastGain;
  });
}

std::string images_text(std::size_t count) {
  return count == 1 ? "one image" : fmt::format("{} images", count);
}

std::string counted_text(const RobotReadings& readings, std::size_t frames) {
  const int seen = with_reading(readings);
  if (seen == 0)
    return fmt::format("In {} no pixel that should show the robot has a reading",
                       images_text(frames));
  const auto percent = [seen](int count) { return 100.0 * count / seen; };
  return fmt::format(
      "Of the readings where it should be, in {}, {:.0f} % lie at its surface, {:.0f} % behind it, "
      "{:.0f} % in front of it",
      images_text(frames), percent(readings.at_surface), percent(readings.behind),
      percent(readings.before + readings.hidden));
}

}  // namespace

CameraPlausibility find_implausible(const OpenScene& scene, std::size_t number) {
  const double least = scene.cameras[number].mounted->settings().watch.min_at_robot;
  CameraPlausibility camera;
  camera.camera = scene.cameras[number].source.name;
  if (least == 0) return camera;
  RobotInImages images(scene, number);
  camera.frames = images.frames().size();
  if (camera.frames == 0) return camera;
  Tried now = tried(scene, images, images.given());
  now.share = share_at_robot(now.all, kLeastJudgedPixels);
  camera.readings = now.all;
  const ReadingRange range = reading_range(images);
  camera.dead = dead_text(images, range, camera.readings);
  camera.seen_through = links_seen_through(scene.robot->model(), now);
  if (camera.dead.empty()) explain(scene, images, now, camera);
  if (camera.dead.empty() && camera.cause.empty()) camera.dead = limits_text(range);
  camera.is_implausible = !camera.dead.empty() || !camera.cause.empty() ||
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

std::vector<CameraPlausibility> require_plausible(const OpenScene& scene) {
  std::vector<CameraPlausibility> cameras = find_implausible(scene);
  if (!std::ranges::all_of(cameras, &CameraPlausibility::is_implausible) &&
      std::ranges::all_of(cameras, [](const auto& one) { return one.in_joints.empty(); })) {
    return cameras;
  }
  std::string text;
  for (const CameraPlausibility& camera : cameras) {
    if (!camera.is_implausible) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", scene.file.string(), text_of(camera));
  }
  throw std::runtime_error(text);
}

std::string text_without_name(const CameraPlausibility& camera) {
  if (camera.is_hidden) {
    return fmt::format(
        "the robot is hidden: {:.0f} % of the readings where it should be, in {}, lie in front of "
        "it, so berth cannot check where it is",
        100 * camera.readings.hidden_share(), images_text(camera.frames));
  }
  if (!camera.is_implausible) return {};
  if (!camera.fits_otherwise.empty()) return camera.fits_otherwise;
  const std::string counted = counted_text(camera.readings, camera.frames);
  if (!camera.dead.empty()) {
    return fmt::format("the camera is dead: {}. {}; expected most at its surface", camera.dead,
                       counted);
  }
  if (camera.cause.empty()) {
    return fmt::format(
        "the robot is not where it should be. {}; expected most at its surface. None of the "
        "mistakes that berth tries explains it",
        counted);
  }
  std::string text = fmt::format(
      "the robot is not where it should be: probably {}. {}; expected most at its surface: with "
      "that corrected {:.0f} % do",
      camera.cause, counted, 100 * camera.share_then);
  if (camera.cause.find(" or ") == std::string::npos) return text + ". Correct " + camera.place;
  return text + ". The images do not say which of these it is";
}

std::string doubt_of(const CameraPlausibility& camera) {
  if (camera.is_implausible || camera.frames == 0) return {};
  if (!camera.readings.tells()) {
    return "its images show too little of the robot: its pose, depth_scale and the joints are not "
           "checked";
  }
  std::string text;
  if (camera.readings.at_robot() < kWellPlaced) {
    text = fmt::format(
        "{:.0f} % of the readings where the robot should be, in {}, lie at its surface; expected "
        "{:.0f} % at least",
        100 * camera.readings.at_robot(), images_text(camera.frames), 100 * kWellPlaced);
  }
  if (camera.seen_through.empty()) return text;
  return fmt::format("{}{}most of what is read at {} lies behind it, as if it were not there", text,
                     text.empty() ? "" : "; ", fmt::join(camera.seen_through, ", "));
}

std::string text_of(const CameraPlausibility& camera) {
  std::string text = text_without_name(camera);
  if (text.empty()) text = doubt_of(camera);
  return text.empty() ? text : fmt::format("camera {}: {}", camera.camera, text);
}

}  // namespace berth
