#include "berth/reports/calibration_coverage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "berth/reports/calibration_words.hpp"

namespace berth {
namespace {

constexpr std::size_t kEnoughFrames = 5;
/// Sure to this, more poses gain little: sensors and models differ by as much.
constexpr double kSureEnough_m = 0.0025;
/// Less than this is hardly a new pose, rad.
constexpr double kLeastTurn = 10 * std::numbers::pi / 180;
/// The robot should be seen in more of the image than this, from edge to edge.
constexpr double kWideEnough = 0.55;
constexpr double kDeepEnough_m = 0.3;
/// A scene's own pose that explains the images as well as this needs nothing.
constexpr double kGoodScore = 0.8;
/// Of the robot's pixels: fewer readings, or fewer that are the robot's, than this is worth a look.
constexpr double kLeastReadOfRobot = 0.5;
constexpr double kLeastFitting = 0.8;
/// A frame whose residuals are this many times those of the others is not like them.
constexpr double kOddFrame = 2;
/// More such frames than this are told in one sentence.
constexpr std::size_t kFramesOneByOne = 3;

class Advisor {
 public:
  Advisor(const CalibrationReport& report, std::size_t camera, const CalibrationCoverage& coverage)
      : model_(*report.calibration_data->model),
        source_(*report.calibration_data->cameras[camera]),
        found_(report.result->cameras[camera]),
        corrects_depth_(report.corrects_depth),
        coverage_(coverage) {}

  std::vector<std::string> run() {
    if (!found_.refused.empty()) {
      advise_refused();
      return std::move(advice_);
    }
    const bool moves = arm_moves();
    if (!moves) say_arm_stands();
    if (moves && !is_sure()) say_more_poses();
    say_odd_frames();
    if (moves) say_clock();
    say_depth();
    return std::move(advice_);
  }

 private:
  void say(std::string_view sentence) { advice_.emplace_back(sentence); }

  bool is_sure() const {
    return found_.frames.size() >= kEnoughFrames && found_.is_determined("pose") &&
           found_.halves_m / 2 <= kSureEnough_m;
  }

  void advise_refused() {
    if (found_.score_before >= kGoodScore) {
      say("Keep the scene's pose: the images agree with it. Calibrate again once the camera was "
          "moved.");
      return;
    }
    say("See in the pictures below whether the robot's outline lies near the robot at all.");
    say("Where it does not, measure the camera's pose again, to within 20 cm and 15 degrees, and "
        "check the URDF, that the joints' rows belong to these images, and that angles are in "
        "rad.");
  }

  double largest_turn() const {
    double largest = 0;
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      if (model_.joints[j].type != JointType::prismatic) {
        largest = std::max(largest, coverage_.joint_range[j]);
      }
    }
    return largest;
  }

  bool arm_moves() const { return largest_turn() >= kLeastTurn; }

  void say_arm_stands() {
    say(fmt::format(
        "Move the arm from image to image: no joint turned by more than {:.0f} degrees. "
        "Go through {} poses that differ by 30 degrees and more in several joints.",
        std::floor(largest_turn() * 180 / std::numbers::pi), kEnoughFrames));
  }

  /// How many more, and where.
  void say_more_poses() {
    const std::size_t used = found_.frames.size();
    const std::size_t more =
        used < kEnoughFrames ? std::max<std::size_t>(2, kEnoughFrames - used) : 2;
    const std::string count = more == 2 ? "two" : more == 3 ? "three" : "four";
    const std::vector<std::string> gaps = gaps_of_view();
    const std::string few =
        used < kEnoughFrames
            ? fmt::format("go through at least {} poses ({} used)", kEnoughFrames, used)
            : "";
    std::string sentence = fmt::format("Take {} more poses", count);
    if (!gaps.empty()) sentence += " " + gaps.front();
    if (!few.empty()) sentence += "; " + few;
    say(sentence + ".");
    if (gaps.size() > 1) say(fmt::format("Take another one {}.", gaps[1]));
  }

  /// What no frame shows yet, each as "with the arm ...".
  std::vector<std::string> gaps_of_view() const {
    std::vector<std::string> gaps;
    add_side(coverage_.across, "to the left", "to the right", "width", gaps);
    add_side(coverage_.down, "up", "down", "height", gaps);
    add_least_seen_link(gaps);
    const CoveredRange& depth = coverage_.depth_m;
    if (depth.high - depth.low < kDeepEnough_m) {
      gaps.push_back(
          fmt::format("with the arm nearer to the camera or farther away: it was only "
                      "seen from {:.2f} to {:.2f} m",
                      depth.low, depth.high));
    }
    return gaps;
  }

  void add_side(const CoveredRange& seen, const char* low_side, const char* high_side,
                const char* extent, std::vector<std::string>& gaps) const {
    if (!(seen.high - seen.low < kWideEnough)) return;
    gaps.push_back(fmt::format(
        "with the arm farther {} in the image: so far it was only seen between {:.0f} % and {:.0f} "
        "% of its {}",
        seen.low + seen.high < 1 ? high_side : low_side, 100 * seen.low, 100 * seen.high, extent));
  }

  /// Only links that are seen at all and that a joint moves.
  void add_least_seen_link(std::vector<std::string>& gaps) const {
    const int frames = static_cast<int>(coverage_.frames.size());
    int least = frames;
    const std::string* name = nullptr;
    for (std::size_t i = 0; i < coverage_.frames_with_link.size(); ++i) {
      const std::size_t link = model_.evaluated_links[i];
      const int seen = coverage_.frames_with_link[i];
      if (seen == 0 || seen >= least || !model_.is_moved(link)) continue;
      least = seen;
      name = &model_.links[link].name;
    }
    if (!name || 2 * least > frames) return;
    gaps.push_back(fmt::format("that show {}: only {} of {} frames do", *name, least, frames));
  }

  void say_odd_frames() {
    std::vector<double> medians_m;
    for (const FrameCoverage& frame : coverage_.frames) {
      if (!std::isnan(frame.median_residual_m)) medians_m.push_back(frame.median_residual_m);
    }
    std::sort(medians_m.begin(), medians_m.end());
    const double usual_m = medians_m.empty() ? std::numeric_limits<double>::quiet_NaN()
                                             : medians_m[medians_m.size() / 2];
    std::vector<const FrameCoverage*> odd;
    for (const FrameCoverage& frame : coverage_.frames) {
      say_unread_frame(frame);
      if (is_odd(frame, usual_m)) odd.push_back(&frame);
    }
    if (odd.size() <= kFramesOneByOne) {
      for (const FrameCoverage* frame : odd) say_odd_frame(*frame);
    } else {
      say_odd_frames(odd);
    }
  }

  static bool is_unread(const FrameCoverage& frame) {
    return frame.reading_px < kLeastReadOfRobot * frame.robot_px;
  }

  static double fitting_percent(const FrameCoverage& frame) {
    return 100.0 * frame.fitting_px / frame.reading_px;
  }

  static bool is_odd(const FrameCoverage& frame, double usual_m) {
    return frame.robot_px > 0 && !is_unread(frame) &&
           (frame.fitting_px < kLeastFitting * frame.reading_px ||
            frame.median_residual_m > kOddFrame * usual_m);
  }

  void say_unread_frame(const FrameCoverage& frame) {
    if (frame.robot_px == 0) {
      say(fmt::format("Frame {} shows nothing of the robot: take it again in another pose.",
                      frame.number));
    } else if (is_unread(frame)) {
      say(
          fmt::format("In frame {} only {:.0f} % of the robot has readings: where it is black or "
                      "shiny, more or softer light helps.",
                      frame.number, 100.0 * frame.reading_px / frame.robot_px));
    }
  }

  void say_odd_frame(const FrameCoverage& frame) {
    say(
        fmt::format("Look at frame {}: {:.0f} % of its readings are within 10 cm of the model, by "
                    "{} in the median. If somebody stood there or the joints are not those of the "
                    "image, leave it out and run again.",
                    frame.number, fitting_percent(frame), mm_text(frame.median_residual_m)));
  }

  /// Many of them in one sentence.
  void say_odd_frames(const std::vector<const FrameCoverage*>& odd) {
    std::vector<int> numbers;
    double least = 100;
    for (const FrameCoverage* frame : odd) {
      numbers.push_back(frame->number);
      least = std::min(least, fitting_percent(*frame));
    }
    say(
        fmt::format("Look at {} of the {} frames, {}: {:.0f} % of their readings at least are "
                    "within 10 cm of the model. If somebody stood there or the joints are not "
                    "those of the images, leave them out and run again.",
                    odd.size(), coverage_.frames.size(), fmt::join(numbers, ", "), least));
  }

  void say_clock() {
    if (found_.is_determined("clock_offset_s")) return;
    if (source_.has_stamps) {
      say("To find the clock's offset, take images while the arm moves.");
    } else {
      say("To find the clock's offset, give the images stamps and take them while the arm moves. "
          "It only matters where distances are asked for while it moves.");
    }
  }

  void say_depth() {
    if (!corrects_depth_) return;
    if (found_.is_determined("depth.offset_m") && found_.is_determined("depth.scale")) return;
    say(fmt::format(
        "Part of the depth's error is not determined: the robot was seen from {:.2f} to "
        "{:.2f} m. Take poses with the arm nearer to the camera and farther away.",
        coverage_.depth_m.low, coverage_.depth_m.high));
  }

  const RobotModel& model_;
  const CalibrationCamera& source_;
  const CameraCalibration& found_;
  const bool corrects_depth_;
  const CalibrationCoverage& coverage_;
  std::vector<std::string> advice_;
};

}  // namespace

std::vector<std::string> calibration_advice(const CalibrationReport& report, std::size_t camera,
                                            const CalibrationCoverage& coverage) {
  return Advisor(report, camera, coverage).run();
}

}  // namespace berth
