// The command line of each command.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "apps/berth/evaluation_options.hpp"
#include "thesis/backend.hpp"
#include "thesis/method.hpp"

namespace CLI {
class App;
}

namespace berth::app {

enum class OutputFormat { table, json };

struct CommonArguments {
  EvaluationArguments evaluation;
  OutputFormat format = OutputFormat::table;
  /// Nothing: standard output.
  std::filesystem::path out;
  /// 0: as many as there are processors.
  int threads = 0;
};

struct RunArguments : CommonArguments {
  /// Of each request; 0: once, without its time.
  int repeat = 0;
  std::filesystem::path scene;
  std::filesystem::path picture_folder;
  /// The number of the only result that is wanted.
  std::optional<std::size_t> frame;
};

struct RecordArguments {
  std::filesystem::path scene;
  std::filesystem::path out;
  double seconds = 30;
  /// Whether a recording is written only where the monitor stopped the robot.
  bool on_stop = true;
  int threads = 0;
};

struct ReplayArguments {
  std::filesystem::path file;
  OutputFormat format = OutputFormat::table;
  int threads = 0;
};

struct FilterArguments {
  std::filesystem::path scene;
  std::filesystem::path out_folder;
  int threads = 0;
};

/// Whether what the robot carries is taken for a part of it.
enum class AttachedChoice { ask, yes, no };

struct CalibrateArguments {
  std::filesystem::path scene;
  std::filesystem::path out;
  std::filesystem::path report_folder;
  bool joint_zeros = false;
  bool correct_depth = false;
  AttachedChoice attached = AttachedChoice::ask;
  OutputFormat format = OutputFormat::table;
  int threads = 0;
};

struct EvaluateArguments : CommonArguments {
  Method method = Method::exact;
  BackendChoice where;
  /// A scene, or else the four files below.
  std::filesystem::path scene;
  std::filesystem::path camera;
  std::filesystem::path robot_depth;
  std::filesystem::path link_ids;
  std::filesystem::path obstacle_depth;
  double depth_scale_m = 0.001;
  /// SelfFilterSettings::robot_region_scale of the scene's cameras.
  double robot_region_scale = 0;
  int repeat = 0;
};

struct ViewArguments {
  std::filesystem::path scene;
  std::string bind = "127.0.0.1";
  int port = 8080;
  /// Where scenes are saved; empty: beside the scene.
  std::filesystem::path save_folder;
  int threads = 0;
};

struct InitArguments {
  std::filesystem::path urdf;
  /// As in the scene's package_paths.
  std::map<std::string, std::filesystem::path> packages;
  std::string camera = "other";
  std::filesystem::path out = "scene.yaml";
};

struct SchemaArguments {
  /// "scene", "result" or "calibration".
  std::string name;
};

struct DoctorArguments {
  std::filesystem::path scene;
  int threads = 0;
};

struct DemoArguments {
  std::filesystem::path picture_folder = "berth_demo";
  /// Whether the scene is shown by a page instead of being run.
  bool view = false;
  int port = 8080;
  int threads = 0;
};

void add_run_options(CLI::App& command, RunArguments& arguments);
void add_record_options(CLI::App& command, RecordArguments& arguments);
void add_replay_options(CLI::App& command, ReplayArguments& arguments);
void add_filter_options(CLI::App& command, FilterArguments& arguments);
void add_calibrate_options(CLI::App& command, CalibrateArguments& arguments);
void add_evaluate_options(CLI::App& command, EvaluateArguments& arguments);
void add_view_options(CLI::App& command, ViewArguments& arguments);
void add_demo_options(CLI::App& command, DemoArguments& arguments);
void add_init_options(CLI::App& command, InitArguments& arguments);
void add_doctor_options(CLI::App& command, DoctorArguments& arguments);
void add_schema_options(CLI::App& command, SchemaArguments& arguments);

}  // namespace berth::app
