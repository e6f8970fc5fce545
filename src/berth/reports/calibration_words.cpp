#include "berth/reports/calibration_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "berth/self_filter/surface_things.hpp"

namespace berth {
namespace {

/// The widest rod and the farthest place that propose_filter() tries.
constexpr const char* kWidest = "3 cm";
constexpr const char* kFarthest = "15 cm";

std::string ms_text(double time_s) { return fmt::format("{:.1f} ms", 1e3 * time_s + 0.0); }

std::string frames_text(std::size_t count) {
  return count == 1 ? "one frame" : fmt::format("{} frames", count);
}

const ProposedSetting* find_setting(const std::vector<ProposedSetting>& settings,
                                    std::string_view key) {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&](const ProposedSetting& s) { return s.key == key; });
  return found == settings.end() ? nullptr : &*found;
}

std::string before_robot_text(const FilterProposal& proposal) {
  const std::string where = proposal.bias_m < 0 ? "in front of" : "behind";
  const ProposedSetting* surface = find_setting(proposal.self_filter, "surface_tolerance_m");
  return fmt::format(
      "The camera sees the robot {} {} its model, in the median: what lies on it and is thinner "
      "than {} at 1 m is taken for it.",
      mm_text(std::abs(proposal.bias_m)), where,
      mm_text(surface ? surface->value : kMostSurfaceTolerance_m));
}

}  // namespace

std::string mm_text(double length_m) {
  return std::isnan(length_m) ? "unknown" : fmt::format("{:.1f} mm", 1e3 * length_m + 0.0);
}

std::string headline(const CameraCalibration& camera) {
  if (!camera.refused.empty()) {
    return fmt::format("The scene's pose stays: {}.", camera.refused);
  }
  const std::string off = "This camera's view of the robot was off by " + mm_text(camera.moved_m);
  if (std::isnan(camera.halves_m)) {
    return off + ". How well the pose repeats, one frame cannot tell.";
  }
  const std::string sure =
      fmt::format("± {} ({})", mm_text(camera.halves_m / 2), frames_text(camera.frames.size()));
  if (camera.moved_m <= camera.halves_m / 2) {
    return fmt::format(
        "The scene's pose was right: what was found differs by {}, repeatable to {}.",
        mm_text(camera.moved_m), sure);
  }
  return fmt::format("{}; now it is repeatable to {}.", off, sure);
}

std::string clock_text(const CameraCalibration& camera, const CalibrationCamera& source) {
  if (!source.has_stamps) return "not looked for: the images have no stamps";
  if (!camera.refused.empty()) return fmt::format("stays {}", ms_text(source.clock_offset_s));
  if (!camera.is_determined("clock_offset_s")) {
    return fmt::format("stays {}: the arm moves too little while images are taken to tell",
                       ms_text(source.clock_offset_s));
  }
  return fmt::format("{}, was {}; repeatable to ± {}", ms_text(camera.clock_offset_s),
                     ms_text(source.clock_offset_s), ms_text(camera.sigma_clock_s));
}

std::string depth_text(const CameraCalibration& camera, double depth_m, bool corrects_depth) {
  if (!camera.refused.empty()) return "not looked for";
  const double reading_m = (depth_m - camera.depth.offset_m) / camera.depth.scale;
  const double error_m = reading_m - depth_m;
  if (std::isnan(error_m)) return "unknown: no reading shows the robot";
  return fmt::format("the camera reads {} too {} at {:.2f} m; {}", mm_text(std::abs(error_m)),
                     error_m < 0 ? "near" : "far", depth_m,
                     corrects_depth ? "the new scene takes that out" : "left as it is");
}

std::vector<std::string> open_questions(const CameraCalibration& camera) {
  std::vector<std::string> sentences;
  if (!camera.is_determined("pose")) {
    sentences.emplace_back("Not determined: the pose, to within 1 cm.");
  }
  const bool has_offset = camera.is_determined("depth.offset_m");
  const bool has_scale = camera.is_determined("depth.scale");
  if (!has_offset && !has_scale) {
    sentences.emplace_back(
        "Not determined: how much of the depth's error is an offset and how much a scale.");
  } else if (!has_offset || !has_scale) {
    sentences.emplace_back(fmt::format("Not determined: the {} of the depth's error.",
                                       has_offset ? "scale" : "offset"));
  }
  return sentences;
}

std::string value_text(const ProposedSetting& setting) {
  if (setting.key.ends_with("_px")) return fmt::format("{:g} px", setting.value);
  if (setting.key.ends_with("_m")) return fmt::format("{:g} m", setting.value);
  return fmt::format("{:g}", setting.value);
}

std::vector<std::string> consequences(const FilterProposal& proposal) {
  if (proposal.self_filter.empty()) return {};
  std::vector<std::string> sentences = {before_robot_text(proposal)};
  sentences.emplace_back(
      proposal.leftover_px == 0
          ? "With these settings nothing of the robot is left in these images."
          : fmt::format("With these settings {} pixels beside the robot remain in all these "
                        "images, {} of them in one piece: they would be taken for an obstacle.",
                        proposal.leftover_px, proposal.largest_leftover_px));
  sentences.emplace_back(
      std::isnan(proposal.rod_gap_m)
          ? fmt::format("How near to the robot a rod of 1 cm is seen could not be measured, or it "
                        "is swallowed even {} away.",
                        kFarthest)
          : fmt::format(
                "A rod of 1 cm at the robot's side is seen from {:.0f} cm of free space on.",
                100 * proposal.rod_gap_m));
  return sentences;
}

std::string smallest_width_text(double width_m) {
  return std::isnan(width_m) ? fmt::format("not even {}, or no room", kWidest)
                             : fmt::format("{:.0f} mm", 1e3 * width_m);
}

std::vector<std::string> detection_texts(const DetectionMap& map) {
  if (map.empty()) return {};
  const DetectedDiameters& cell = map.cell;
  const auto percent = [](int part, std::size_t of) {
    return 100.0 * part / static_cast<double>(of);
  };
  const Eigen::Vector3d& center_m = map.reach.center_B_m;
  std::vector<std::string> texts{fmt::format(
      "Of the places within {:.2f} m of ({:.2f}, {:.2f}, {:.2f}), the robot's reach, {:.0f} % are "
      "in view of some camera.",
      map.reach.radius_m, center_m.x(), center_m.y(), center_m.z(),
      percent(cell.in_view(), map.places_B_m.size()))};
  if (cell.in_view() == 0) return texts;
  std::string told;
  for (const double diameter_m : {0.02, 0.04, 0.08}) {
    told += fmt::format("{}{:.0f} mm at {:.1f} %", told.empty() ? "" : ", of ", 1000 * diameter_m,
                        percent(cell.told(diameter_m), static_cast<std::size_t>(cell.in_view())));
  }
  texts.push_back("Drawn there, balls of " + told + " of these are detected.");
  const Eigen::Vector3d& worst_m = map.places_B_m[cell.worst_place()];
  const std::string least =
      std::isinf(cell.worst_m())
          ? fmt::format("not even {:.0f} mm is detected everywhere",
                        1000 * kDrawnDiameters_m.back())
          : fmt::format("{:.0f} mm is detected everywhere", 1000 * cell.worst_m());
  texts.push_back(
      fmt::format("Of what is in view, {}; the worst place is ({:.2f}, {:.2f}, {:.2f}).", least,
                  worst_m.x(), worst_m.y(), worst_m.z()));
  return texts;
}

std::string attached_text(const AttachedPart& part) {
  const Eigen::Vector3d size_cm = 100 * part.size_m;
  return fmt::format(
      "{} carries something that its URDF does not have, {:.0f} x {:.0f} x {:.0f} cm: {} images "
      "show "
      "it, at {} places of the room, and {:.0f} % of the readings that come and go near the robot "
      "are its own. No image shows {:.0f} % of its surface, where it may reach farther.",
      part.link, size_cm.x(), size_cm.y(), size_cm.z(), part.seen_in.size(), part.places,
      100 * part.explained_share, 100 * part.hidden_share);
}

std::string attached_use_text(const AttachedPart& part) {
  return part.is_taken
             ? fmt::format("It is a part of the robot from now on, by the name {}.", part.name)
             : "It stays an obstacle. If it is a part of the robot, calibrate with --attached yes.";
}

}  // namespace berth
