#include "apps/berth/checkup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "berth/calibration/robot_reach.hpp"
#include "berth/distance/known_model.hpp"
#include "berth/results/result_text.hpp"
#include "berth/robot/plausible_size.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/scene/scene_run.hpp"
#include "berth/visibility/sample_points.hpp"

namespace berth::app {
namespace {

/// How many results a check of a long recording looks at.
constexpr std::size_t kCheckedResults = 100;
/// A link that is seen in fewer of the results than this is worth another camera.
constexpr double kOftenSeen = 0.5;
/// A monitor that stops the robot in more of the results than this lets nobody work.
constexpr double kMostStops = 0.5;

double percent_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// X_CB of each, where it takes its first image.
std::vector<Pose> first_camera_poses(const OpenScene& scene) {
  std::vector<Pose> X_CB;
  RobotPose pose;
  for (const OpenCamera& camera : scene.cameras) {
    forward_kinematics(scene.robot->model(), camera.at_exposure.front().position, pose);
    X_CB.push_back(camera.mounted->camera_pose(pose).inverse());
  }
  return X_CB;
}

std::string about_camera(const char* what, const OpenCamera& camera) {
  return fmt::format("{}, camera {}", what, camera.source.name);
}

std::size_t without_joints(const OpenCamera& camera) {
  return static_cast<std::size_t>(std::ranges::count_if(
      camera.exposure_time, [](const FrameTime& time) { return time.status != TimeStatus::ok; }));
}

Finding stamps_of(const OpenScene& scene, const OpenCamera& camera) {
  Finding found{.about = about_camera("stamps", camera)};
  const std::vector<double>& stamps_s = camera.source.stamps_s;
  const std::size_t images = camera.source.depth.size(), missing = without_joints(camera);
  if (stamps_s.empty()) {
    found.verdict = Verdict::advice;
    found.text = fmt::format("none: image k belongs to row k of the joints, for {} images", images);
    found.next =
        fmt::format("Write stamps for camera {}: they show which joints belong to an image.",
                    camera.source.name);
    return found;
  }
  found.text =
      fmt::format("{} images, {:.3f} to {:.3f} s", images, stamps_s.front(), stamps_s.back());
  if (missing > 0) {
    found.verdict = Verdict::wrong;
    found.text += fmt::format("; {} have no joints: these go from {:.3f} to {:.3f} s", missing,
                              scene.joints->first_s(), scene.joints->last_s());
    found.next = fmt::format(
        "Compare the stamps of camera {} with the times in {}: both have to be of one clock "
        "(clock_offset_s).",
        camera.source.name, scene.joints->source());
    return found;
  }
  return found;
}

std::string calibrate_text(const OpenScene& scene) {
  return fmt::format(
      "Record images of the moving arm, then: berth calibrate {} --out calibrated.yaml. It "
      "measures the cameras' poses, learns where the empty cell gives no reading, and turns the "
      "watch on.",
      scene.file.string());
}

std::string farthest_link_text(const RobotModel& model) {
  const auto reach = [](const Link& link) { return reach_m(link.mesh_L); };
  const Link& link = *std::ranges::max_element(model.links, {}, reach);
  return fmt::format("link {} reaches {:.2g} m from its origin", link.name, reach(link));
}

/// What to do about a camera that is implausible.
std::string next_for(const OpenScene& scene, const CameraPlausibility& camera) {
  if (!camera.dead.empty()) {
    return fmt::format("Record the images of camera {} again, then run berth doctor again.",
                       camera.camera);
  }
  if (!camera.cause.empty()) {
    return fmt::format("Correct {}, then run berth doctor again: probably {}.", camera.place,
                       camera.cause);
  }
  return fmt::format(
      "Check the size of the robot's meshes ({}), and the pose of camera {}. If the pose is within "
      "20 cm and 15 degrees: berth calibrate {} --out calibrated.yaml",
      farthest_link_text(scene.robot->model()), camera.camera, scene.file.string());
}

Finding pose_of(const OpenScene& scene, const CameraPlausibility& camera) {
  Finding found{.about = fmt::format("place, camera {}", camera.camera)};
  if (camera.is_implausible) {
    found.verdict = Verdict::wrong;
    found.text = text_without_name(camera);
    found.next = next_for(scene, camera);
    return found;
  }
  if (camera.is_hidden || !camera.readings.tells()) {
    found.verdict = Verdict::advice;
    found.text = camera.is_hidden ? text_without_name(camera) : doubt_of(camera);
    if (found.text.empty()) found.text = "not checked, since watch.min_at_robot is 0";
    found.next = fmt::format(
        "Check pose and depth_scale of camera {} by hand, such as at a wall whose distance you "
        "know, or record images in which it sees the robot.",
        camera.camera);
    return found;
  }
  found.text = fmt::format(
      "{:.0f} % of the readings where the robot should be lie at its surface (images: {})",
      100 * camera.readings.at_robot(), camera.frames);
  const std::string doubt = doubt_of(camera);
  if (doubt.empty()) return found;
  found.verdict = Verdict::advice;
  found.text = doubt;
  found.next =
      fmt::format("berth calibrate {} --out calibrated.yaml --report report", scene.file.string());
  if (!camera.seen_through.empty()) {
    found.next += fmt::format(". If {} is no body, such as a zone, name it in robot.ignore_links",
                              camera.seen_through.front());
  }
  return found;
}

/// What many results say.
struct Seen {
  std::size_t results = 0;
  std::size_t stops = 0;
  std::map<std::string, std::size_t> trouble;
  /// The camera whose images are too old, by the sentence of `trouble`.
  std::map<std::string, std::string> too_old;
  /// Of links that move, in how many results.
  std::map<std::string, std::size_t> not_seen;
  std::map<std::string, std::size_t> not_observed;
  std::string a_stop;
  /// Moved links and what they touch by their meshes, in how many results.
  std::map<std::pair<std::string, std::string>, std::size_t> touching;

  void add(const Result& result) {
    ++results;
    if (result.status == ResultStatus::stale) ++trouble[status_text(result)];
    for (const CameraResult& camera : result.cameras) {
      if (!camera.has_frame || is_relied_on(camera.status)) continue;
      const std::string text =
          fmt::format("camera {} is {}", camera.camera, name_of(camera.status));
      ++trouble[text];
      if (camera.status == CameraStatus::too_old) too_old[text] = camera.camera;
    }
    for (const LinkResult& link : result.links) {
      if (!link.is_moved) continue;
      if (link.status == LinkStatus::not_seen) ++not_seen[link.link];
      if (link.status == LinkStatus::not_observed) ++not_observed[link.link];
      if (link.known.distance_m == 0) {
        ++touching[std::minmax<std::string>(link.link,
                                            std::string(result.known_link_of(link.known)))];
      }
    }
    if (!result.separation || result.separation->state != SeparationState::stop) return;
    ++stops;
    a_stop = separation_text(result);
  }
};

/// What to do where a result has this trouble.
std::string next_for(const OpenScene& scene, const Seen& seen, const std::string& trouble) {
  const auto late = seen.too_old.find(trouble);
  for (const OpenCamera& camera : scene.cameras) {
    if (late == seen.too_old.end() || camera.source.name != late->second) continue;
    if (std::isnan(period_ms(camera))) continue;
    return fmt::format(
        "Raise time.max_frame_age_s above {:.2f} s, which lie between two images of camera {}, or "
        "let it give more.",
        period_ms(camera) / 1000, camera.source.name);
  }
  return "Look at that camera's images: berth run " + scene.file.string() + " --picture pictures";
}

/// Links of which something is true too often, in one piece of advice.
struct OftenLinks {
  std::string names;   ///< "link2, link5"
  std::string counts;  ///< "link2 in 3, link5 in 4 of 5 results"
};

OftenLinks often(const std::map<std::string, std::size_t>& links, std::size_t results) {
  OftenLinks all;
  for (const auto& [link, count] : links) {
    if (percent_of(count, results) < 100 * (1 - kOftenSeen)) continue;
    const char* before = all.names.empty() ? "" : ", ";
    all.names += before + link;
    all.counts += fmt::format("{}{} in {}", before, link, count);
  }
  all.counts += fmt::format(" of {} results", results);
  return all;
}

std::vector<Finding> findings_of(const OpenScene& scene, const Seen& seen) {
  std::vector<Finding> all;
  for (const auto& [what, count] : seen.trouble) {
    all.push_back({Verdict::wrong, "results",
                   fmt::format("{} in {} of {} results", what, count, seen.results),
                   next_for(scene, seen, what)});
  }
  const OftenLinks not_seen = often(seen.not_seen, seen.results);
  if (!not_seen.names.empty()) {
    all.push_back({Verdict::advice, "results", "no camera sees " + not_seen.counts,
                   "Move or add a camera that sees " + not_seen.names + "."});
  }
  const OftenLinks not_observed = often(seen.not_observed, seen.results);
  if (!not_observed.names.empty()) {
    all.push_back({Verdict::advice, "results",
                   "no image shows most of the space around " + not_observed.counts,
                   "Turn or add a camera that sees the space around " + not_observed.names +
                       ", or write space.unobserved: unknown or ignore."});
  }
  for (const auto& [links, count] : seen.touching) {
    all.push_back({Verdict::advice, "known",
                   fmt::format("links {} and {} touch in {} of {}", links.first, links.second,
                               count, seen.results),
                   fmt::format("If links {0} and {1} may touch, write robot.allowed_contacts: "
                               "[[{0}, {1}]].",
                               links.first, links.second)});
  }
  if (percent_of(seen.stops, seen.results) > 100 * kMostStops) {
    all.push_back({Verdict::advice, "separation",
                   fmt::format("the robot has to stand in {} of {} results, such as: {}",
                               seen.stops, seen.results, seen.a_stop),
                   "Read docs/separation.md, \"What belongs to the cell\"."});
  }
  if (all.empty()) {
    all.push_back(
        {.about = "results", .text = fmt::format("{}, each with all its cameras", seen.results)});
  }
  return all;
}

}  // namespace

Finding check_images(const OpenScene& scene, const Pause& pause) {
  for (const OpenCamera& camera : scene.cameras) {
    for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
      pause();
      camera.read_depth(k);
    }
  }
  return {
      .about = "files",
      .text = fmt::format(
          "robot {} with {} links, {} image{} of {} camera{}, joints from {:.3f} to {:.3f} s",
          scene.robot->model().name, scene.robot->model().link_count(), scene.frame_count,
          scene.frame_count == 1 ? "" : "s", scene.cameras.size(),
          scene.cameras.size() == 1 ? "" : "s", scene.joints->first_s(), scene.joints->last_s())};
}

std::vector<Finding> check_stamps(const OpenScene& scene) {
  std::vector<Finding> all;
  for (const OpenCamera& camera : scene.cameras) all.push_back(stamps_of(scene, camera));
  return all;
}

std::vector<Finding> check_poses(const OpenScene& scene) {
  std::vector<Finding> all;
  for (const CameraPlausibility& camera : find_implausible(scene))
    all.push_back(pose_of(scene, camera));
  return all;
}

std::vector<Finding> check_unread(const OpenScene& scene) {
  std::vector<Finding> all;
  for (const OpenCamera& camera : scene.cameras) {
    Finding found{.about = about_camera("no reading", camera),
                  .text = "a person in black, who gives none, is unknown space"};
    if (camera.mounted->settings().space.no_reading == NoReading::free) {
      found.text =
          "a person in black, who gives none, is taken for free space (space.no_reading: free)";
    } else if (!tells_unread(camera)) {
      found.verdict = Verdict::advice;
      found.text =
          "berth can miss a person in black, who gives none: what gives no reading is no obstacle";
      found.next = calibrate_text(scene);
    }
    all.push_back(found);
  }
  return all;
}

std::vector<Finding> check_watch(const OpenScene& scene) {
  std::vector<Finding> all;
  for (const OpenCamera& camera : scene.cameras) {
    Finding found{.about = about_camera("watch", camera), .text = "a bumped camera is noticed"};
    if (!camera.mounted->settings().watch.is_on()) {
      found.verdict = Verdict::advice;
      found.text = "off: nobody notices when the camera is bumped";
      found.next = calibrate_text(scene);
    }
    all.push_back(found);
  }
  return all;
}

std::vector<Finding> check_results(const OpenScene& scene, const Pause& pause) {
  SceneRun run(scene, pause);
  Seen seen;
  while (seen.results < kCheckedResults && run.next()) {
    pause();
    if (run.begins_result()) seen.add(run.ask());
  }
  return findings_of(scene, seen);
}

Finding check_views(const OpenScene& scene) {
  constexpr int kPoints = 4000;
  constexpr double kMostOutside = 0.25;
  const RobotModel& model = scene.robot->model();
  const RobotReach reach = robot_reach(model);
  /// By the eighth of the ball that they lie in.
  std::array<int, 8> outside{};
  std::array<Eigen::Vector3d, 8> sum_B_m;
  sum_B_m.fill(Eigen::Vector3d::Zero());
  const std::vector<Pose> X_CB = first_camera_poses(scene);
  for (const Eigen::Vector3d& unit : sample_unit_ball(kPoints)) {
    const Eigen::Vector3d p_B_m = reach.center_B_m + reach.radius_m * unit;
    bool is_known = is_guarded(model.guarded, p_B_m);
    for (std::size_t k = 0; k < X_CB.size() && !is_known; ++k) {
      is_known =
          project_into_image(scene.cameras[k].mounted->camera(), X_CB[k] * p_B_m).has_value();
    }
    if (is_known) continue;
    const int eighth = (unit.x() > 0) + 2 * (unit.y() > 0) + 4 * (unit.z() > 0);
    ++outside[eighth];
    sum_B_m[eighth] += p_B_m;
  }
  const auto worst = std::ranges::max_element(outside) - outside.begin();
  const int count = std::accumulate(outside.begin(), outside.end(), 0);
  Finding found{.about = "in no image",
                .text = fmt::format("{:.0f} % of the ball that the robot can reach",
                                    percent_of(count, kPoints))};
  if (count <= kMostOutside * kPoints) return found;
  const Eigen::Vector3d place_B_m = sum_B_m[worst] / outside[worst];
  found.verdict = Verdict::advice;
  found.text += fmt::format(", most around ({:.1f}, {:.1f}, {:.1f}) m in {}", place_B_m.x(),
                            place_B_m.y(), place_B_m.z(), model.links.front().name);
  found.next =
      "Turn or add a camera that sees that place; or write space.unobserved: unknown, with links "
      "for closed boxes, such as a fenced machine, in robot.guarded_links.";
  return found;
}

Finding check_known(const OpenScene& scene) {
  const RobotModel& model = scene.robot->model();
  const KnownModel& known = scene.robot->known();
  std::map<LeftOutReason, std::vector<std::string>> left_out;
  for (const LeftOutPair& pair : known.left_out) {
    left_out[pair.reason].push_back(
        fmt::format("{} - {}", model.links[pair.link].name, model.links[pair.other].name));
  }
  Finding found{.about = "known",
                .text = fmt::format("{} pairs of links are looked at", known.pairs.size())};
  for (const auto& [reason, pairs] : left_out) {
    found.text += fmt::format("; left out as {}: {}", name_of(reason), fmt::join(pairs, ", "));
  }
  return found;
}

Finding check_separation(const OpenScene& scene) {
  Finding found{.about = "separation"};
  if (!scene.separation) {
    found.text = "the scene has none: nothing is monitored";
  } else if (!scene.separation->intrusion_m && !scene.separation->detection_m) {
    found.verdict = Verdict::advice;
    found.text =
        fmt::format("nobody has shown what the cameras detect, so C is {} m", kUnprovenIntrusion_m);
    found.next = "Run berth calibrate: it measures that, and writes separation.detection_m.";
  } else {
    found.text = "the scene says what the cameras detect";
  }
  return found;
}

}  // namespace berth::app
