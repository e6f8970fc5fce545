#include "apps/berth/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/support/threads_argument.hpp"
#include "berth/robot/number.hpp"

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

template <class T, std::size_t n>
std::vector<std::string> names_of(const std::array<T, n>& all) {
  std::vector<std::string> names;
  for (const T one : all) names.emplace_back(name_of(one));
  return names;
}

/// `name` is one of them.
template <class T, std::size_t n>
T named(const std::array<T, n>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](T one) { return name_of(one) == name; });
}

void add_evaluation(CLI::App& command, EvaluationArguments& arguments) {
  command.add_option("--method", arguments.method, "How to find the distances (default: exact)")
      ->check(CLI::IsMember(names_of(kMethods)));
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

void add_visibility(CLI::App& command, EvaluationArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--visibility",
          [&arguments](const std::string& value) { arguments.visibility = value == "on"; },
          "Whether to give how much of each link and of the space around its answer the camera "
          "sees (default: on)")
      ->check(CLI::IsMember({"on", "off"}));
}

void add_surveillance(CLI::App& command, EvaluationArguments& arguments) {
  command
      .add_option("--region", arguments.region,
                  "brute_force and lattice: where obstacles of a robot pixel are looked for "
                  "(default: image for brute_force, cube_projection for lattice)")
      ->check(CLI::IsMember(names_of(kSurveillanceRegions)));
  command
      .add_option("--depth-interval", arguments.depth_interval,
                  "brute_force and lattice: whether obstacles in front of the cube around a robot "
                  "pixel count (default: gray_area, they do)")
      ->check(CLI::IsMember(names_of(kDepthIntervals)));
  command
      .add_option("--search-pattern", arguments.search_pattern,
                  "brute_force and lattice: the order of obstacle pixels (default: row_major)")
      ->check(CLI::IsMember(names_of(kSearchPatterns)));
  command
      .add_option("--shrinking", arguments.shrinking,
                  "brute_force and lattice: whether the region shrinks with a link's closest pair "
                  "(default: per_link, it does)")
      ->check(CLI::IsMember(names_of(kShrinkings)));
}

void add_lattice(CLI::App& command, EvaluationArguments& arguments) {
  const auto pixels = [&command](const char* name, std::optional<int>& value, int most_px,
                                 const char* what) {
    command.add_option(name, value, what)->check(CLI::Range(1, most_px))->type_name("PX");
  };
  pixels("--step-x", arguments.step_x, kMaxLatticePx,
         "lattice, gl_lattice and gl_hybrid: tries every so many columns of obstacle pixels "
         "(default: 1)");
  pixels("--step-y", arguments.step_y, kMaxLatticePx,
         "lattice, gl_lattice and gl_hybrid: tries every so many rows of obstacle pixels "
         "(default: 1)");
  pixels(
      "--initial-grid-radius-px", arguments.initial_grid_radius_px, kMaxLatticePx,
      "lattice and gl_hybrid: radius around the robot pixels that are tried first (default: 40)");
  pixels("--final-grid-radius-px", arguments.final_grid_radius_px, kMaxLatticePx,
         "lattice, gl_lattice and gl_hybrid: radius within which all robot pixels are tried last "
         "(default: 2)");
  pixels(
      "--tile-px", arguments.tile_px, kMaxTilePx,
      "gl_lattice: size of the tiles of which one robot pixel each is tried first (default: 16)");
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
  app::add_threads(command, arguments.threads);
}

/// Throws if an option was given that belongs to other methods.
template <class T>
void require_method(const std::optional<T>& option, const char* name, Method used,
                    std::initializer_list<Method> expected) {
  if (!option || std::find(expected.begin(), expected.end(), used) != expected.end()) return;
  std::vector<std::string_view> names;
  for (const Method method : expected) names.push_back(name_of(method));
  throw std::invalid_argument(fmt::format("method {}: has no {}; expected method {}", name_of(used),
                                          name, fmt::join(names, " or ")));
}

void require_methods(const EvaluationArguments& arguments, Method used) {
  const auto exact = {Method::exact};
  const auto lattices = {Method::lattice, Method::gl_lattice, Method::gl_hybrid};
  const auto with_circles = {Method::lattice, Method::gl_hybrid};
  const auto watching = {Method::brute_force, Method::lattice};
  require_method(arguments.tolerance_m, "--tolerance-m", used, exact);
  require_method(arguments.deadline_us, "--deadline-us", used, exact);
  require_method(arguments.region, "--region", used, watching);
  require_method(arguments.depth_interval, "--depth-interval", used, watching);
  require_method(arguments.search_pattern, "--search-pattern", used, watching);
  require_method(arguments.shrinking, "--shrinking", used, watching);
  require_method(arguments.step_x, "--step-x", used, lattices);
  require_method(arguments.step_y, "--step-y", used, lattices);
  require_method(arguments.initial_grid_radius_px, "--initial-grid-radius-px", used, with_circles);
  require_method(arguments.final_grid_radius_px, "--final-grid-radius-px", used, lattices);
  require_method(arguments.tile_px, "--tile-px", used, {Method::gl_lattice});
}

template <class T>
void set_if(T& setting, const std::optional<T>& given) {
  if (given) setting = *given;
}

SurveillanceSettings surveillance_over(SurveillanceSettings settings,
                                       const EvaluationArguments& arguments) {
  if (arguments.region) settings.region = named(kSurveillanceRegions, *arguments.region);
  if (arguments.depth_interval) {
    settings.depth_interval = named(kDepthIntervals, *arguments.depth_interval);
  }
  if (arguments.search_pattern) {
    settings.search_pattern = named(kSearchPatterns, *arguments.search_pattern);
  }
  if (arguments.shrinking) settings.shrinking = named(kShrinkings, *arguments.shrinking);
  return settings;
}

}  // namespace

DistanceSettings EvaluationArguments::settings_over(DistanceSettings settings,
                                                    Method method_used) const {
  require_methods(*this, method_used);
  set_if(settings.tolerance_m, tolerance_m);
  if (deadline_us) settings.deadline_us = *deadline_us;
  set_if(settings.range_m, range_m);
  set_if(settings.mean_direction, mean_direction);
  settings.surveillance = surveillance_over(settings.surveillance, *this);
  set_if(settings.lattice.step_x, step_x);
  set_if(settings.lattice.step_y, step_y);
  set_if(settings.lattice.initial_grid_radius_px, initial_grid_radius_px);
  set_if(settings.lattice.final_grid_radius_px, final_grid_radius_px);
  set_if(settings.lattice.tile_px, tile_px);
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
  add_visibility(command, arguments.evaluation);
  add_surveillance(command, arguments.evaluation);
  add_lattice(command, arguments.evaluation);
  app::add_backend_options(command, "Where images are rendered and filtered", arguments.where);
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
  app::add_backend_options(command, "Where images are rendered and filtered", arguments.where);
  app::add_threads(command, arguments.threads);
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
  add_surveillance(command, arguments.evaluation);
  add_lattice(command, arguments.evaluation);
  app::add_gl_device(command, arguments.where);
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
  app::add_threads(command, arguments.threads);
  command.footer("Example:\n  berth demo --picture pictures");
}

}  // namespace berth
