// calibrate: calibration of a scene.
#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "apps/berth/attached_question.hpp"
#include "apps/berth/calibration_page.hpp"
#include "apps/berth/commands.hpp"
#include "apps/berth/run_frames.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/files/error.hpp"
#include "berth/reports/calibration_report.hpp"
#include "berth/scene/attach_parts.hpp"
#include "berth/scene/calibrate_background.hpp"
#include "berth/scene/calibrate_scene.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

/// Before minutes of work, not after them.
void require_place_for(const fs::path& out, const fs::path& scene) {
  std::error_code error;
  const fs::path folder = fs::absolute(out, error).parent_path();
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error(
        fmt::format("{}: cannot be written: there is no folder {}; expected one "
                    "that is there",
                    out.string(), folder.string()));
  }
  if (!fs::exists(out, error) || !fs::equivalent(scene, out, error)) return;
  throw_bad_file({out}, "is the scene itself", "another file for --out");
}

}  // namespace

void calibrate_command(const CalibrateArguments& arguments) {
  require_place_for(arguments.out, arguments.scene);
  const OpenScene scene = open_with_progress(read_scene_to_calibrate(arguments.scene),
                                             "read images", open_scene_with_images);
  const SceneCalibrationData material = make_calibration_data(scene);
  CalibrateSceneSettings settings;
  settings.fit.joint_zeros = arguments.joint_zeros;
  settings.correct_depth = arguments.correct_depth;
  SceneCalibration calibration;
  {
    ProgressBar progress("calibrate in", 0);
    settings.fit.pause = [&progress] {
      stop_if_interrupted();
      progress.step();
    };
    settings.takes_part = attached_question(arguments.attached, progress);
    calibration = calibrate_scene(scene, material, settings);
  }
  CalibratedBackgrounds backgrounds;
  {
    ProgressBar progress("learn background", 0);
    backgrounds = calibrate_backgrounds(
        scene, arguments.out,
        [&progress] {
          stop_if_interrupted();
          progress.step();
        },
        calibration.change);
  }
  std::vector<std::string>& warnings = calibration.warnings;
  warnings.insert(warnings.end(), backgrounds.without.begin(), backgrounds.without.end());
  const CalibrationReport report = report_of(material, calibration, arguments.correct_depth);
  const std::string text = arguments.format == OutputFormat::json ? calibration_json(report) + "\n"
                                                                  : calibration_table(report);
  if (!arguments.report_folder.empty())
    write_calibration_page(arguments.report_folder, arguments.scene.string(), report);
  attach_parts(arguments.scene, calibration.attached, arguments.out, calibration.change);
  write_backgrounds(backgrounds.learned);
  write_attached_parts(calibration.attached, arguments.out);
  write_rewritten_scene(arguments.scene, calibration.change, arguments.out);
  std::fputs(text.c_str(), stdout);
}

}  // namespace berth::app
