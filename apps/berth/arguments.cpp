#include "apps/berth/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "berth/io/number.hpp"

namespace berth {
namespace {

/// CLI::PositiveNumber lets NaN and infinity through.
std::string require_positive_finite(const std::string& text) {
  const std::optional<double> value = parse_finite(text);
  return value && *value > 0 ? "" : text + " is no finite number above 0";
}

std::string require_not_negative(const std::string& text) {
  const std::optional<double> value = parse_finite(text);
  return value && *value >= 0 ? "" : text + " is no finite number of at least 0";
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use (default: one for each processor)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

void add_evaluation(CLI::App& command, EvaluationArguments& arguments) {
  std::vector<std::string> methods;
  for (const Method method : kMethods) methods.emplace_back(name_of(method));
  command.add_option("--method", arguments.method, "How to find the distances (default: exact)")
      ->check(CLI::IsMember(methods));
  command
      .add_option("--range", arguments.range_m,
                  "Distances are looked for up to here, in metres (default: 1)")
      ->check(require_positive_finite)
      ->type_name("M");
  command
      .add_option_function<std::string>(
          "--mean-direction",
          [&arguments](const std::string& value) { arguments.mean_direction = value == "on"; },
          "Whether to give the mean direction of what is near each link (default: on)")
      ->check(CLI::IsMember({"on", "off"}));
  command
      .add_option("--tolerance-m", arguments.tolerance_m,
                  "exact may stop once a link's distance is known to this, in metres (default: 0)")
      ->check(require_not_negative)
      ->type_name("E");
  command
      .add_option("--deadline-us", arguments.deadline_us,
                  "exact stops after so many microseconds, mean directions not counted, and tells "
                  "what it knows by then: distance and lower bound (default: none)")
      ->check(require_not_negative)
      ->type_name("N");
}

void add_output(CLI::App& command, CommonArguments& arguments) {
  const std::map<std::string, OutputFormat> formats{{"table", OutputFormat::table},
                                                    {"json", OutputFormat::json}};
  command
      .add_option_function<std::string>(
          "--format",
          [&arguments, formats](const std::string& name) { arguments.format = formats.at(name); },
          "A table for people, or one JSON object per frame and line (default: table)")
      ->check(CLI::IsMember({"table", "json"}));
  command.add_option("--out", arguments.out, "Write there instead of to standard output")
      ->type_name("FILE");
  add_threads(command, arguments.threads);
}

}  // namespace

DistanceSettings EvaluationArguments::settings_over(DistanceSettings settings,
                                                    Method method_used) const {
  if ((tolerance_m || deadline_us) && method_used != Method::exact) {
    throw std::invalid_argument(
        fmt::format("method {}: has neither --tolerance-m nor --deadline-us; expected method exact",
                    name_of(method_used)));
  }
  if (tolerance_m) settings.tolerance_m = *tolerance_m;
  if (deadline_us) settings.deadline_us = *deadline_us;
  if (range_m) settings.range_m = *range_m;
  if (mean_direction) settings.mean_direction = *mean_direction;
  validate(settings);
  return settings;
}

Method EvaluationArguments::method_over(Method otherwise) const {
  return method ? method_from_name(*method).value() : otherwise;
}

void add_run_options(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("scene", arguments.scene, "The scene: robot, cameras, depth images, joint angles")
      ->required()
      ->type_name("SCENE.yaml");
  command.add_option("--picture", arguments.picture_folder, "Draw each frame into this folder")
      ->type_name("DIR");
  add_evaluation(command, arguments.evaluation);
  add_output(command, arguments);
  command.footer(
      "Example:\n  berth run scene.yaml --format json --out result.jsonl --picture pictures");
}

void add_filter_options(CLI::App& command, FilterArguments& arguments) {
  command
      .add_option("scene", arguments.scene, "The scene: robot, cameras, depth images, joint angles")
      ->required()
      ->type_name("SCENE.yaml");
  command
      .add_option("--out", arguments.out_folder, "Folder for the images; made if it is not there")
      ->required()
      ->type_name("DIR");
  add_threads(command, arguments.threads);
  command.footer("Example:\n  berth filter scene.yaml --out filtered");
}

void add_evaluate_options(CLI::App& command, EvaluateArguments& arguments) {
  const auto file = [&command](const char* name, std::filesystem::path& path, const char* what,
                               const char* type) {
    command.add_option(name, path, what)->required()->type_name(type);
  };
  file("--camera", arguments.camera, "The camera, a ROS camera_info file", "INFO.yaml");
  file("--robot-depth", arguments.robot_depth, "The robot's depth, 16-bit PNG", "R.png");
  file("--link-ids", arguments.link_ids, "The robot's link of each pixel, 8- or 16-bit PNG",
       "I.png");
  file("--obstacle-depth", arguments.obstacle_depth,
       "The depth image without the robot, 16-bit PNG", "F.png");
  command
      .add_option("--depth-scale", arguments.depth_scale_m,
                  "Metres per unit of the depth images (default: 0.001)")
      ->check(require_positive_finite)
      ->type_name("M");
  command.add_option("--repeat", arguments.repeat, "Evaluate so often, and tell the times")
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
  add_evaluation(command, arguments.evaluation);
  add_output(command, arguments);
  command.footer(
      "Example:\n  berth evaluate --camera camera_info.yaml --robot-depth robot_depth_000000.png "
      "\\\n"
      "    --link-ids link_ids_000000.png --obstacle-depth obstacle_depth_000000.png --format "
      "json");
}

void add_demo_options(CLI::App& command, DemoArguments& arguments) {
  command
      .add_option("--picture", arguments.picture_folder,
                  "Folder for the pictures (default: berth_demo)")
      ->type_name("DIR");
  add_threads(command, arguments.threads);
  command.footer("Example:\n  berth demo --picture pictures");
}

}  // namespace berth
