#include "apps/berth/arguments.hpp"

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <vector>

#include "apps/berth/new_scene.hpp"
#include "apps/support/command_options.hpp"
#include "berth/files/number.hpp"

namespace berth::app {
namespace {

/// CLI::PositiveNumber lets NaN and infinity through.
std::string require_positive_finite(const std::string& text) {
  const std::optional<double> value = parse_finite(text);
  return value && *value > 0 ? "" : text + " is no finite number above 0";
}

std::string require_region_scale(const std::string& text) {
  const std::optional<double> value = parse_finite(text);
  const bool is_good = value && (*value == 0 || (*value >= 1 && *value <= 1000));
  return is_good ? "" : text + " is neither 0 nor a number from 1 to 1000";
}

void add_format(CLI::App& command, const char* what, OutputFormat& format) {
  const std::map<std::string, OutputFormat> formats{{"table", OutputFormat::table},
                                                    {"json", OutputFormat::json}};
  command
      .add_option_function<std::string>(
          "--format", [&format, formats](const std::string& name) { format = formats.at(name); },
          what)
      ->check(CLI::IsMember({"table", "json"}));
}

void add_output(CLI::App& command, CommonArguments& arguments) {
  add_format(command, "A table for people, or one JSON object per frame and line (default: table)",
             arguments.format);
  command.add_option("--out", arguments.out, "Write there instead of to standard output")
      ->type_name("FILE");
  add_threads(command, arguments.threads);
}

void add_scene(CLI::App& command, std::filesystem::path& scene) {
  command.add_option("scene", scene, "The scene: robot, cameras, depth images, joint angles")
      ->required()
      ->type_name("SCENE.yaml");
}

void add_port(CLI::App& command, int& port, const char* what) {
  command.add_option("--port", port, what)->check(CLI::Range(0, 65535))->type_name("N");
}

}  // namespace

void add_run_options(CLI::App& command, RunArguments& arguments) {
  add_scene(command, arguments.scene);
  command.add_option("--picture", arguments.picture_folder, "Draw each frame into this folder")
      ->type_name("DIR");
  command
      .add_option("--frame", arguments.frame,
                  "Only this frame: the number that stands in the table, from 0")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  add_evaluation(command, arguments.evaluation);
  command
      .add_option("--repeat", arguments.repeat, "Ask each request N times, and report the times")
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
  add_output(command, arguments);
  command.footer(
      "Examples:\n  berth run scene.yaml --picture pictures\n  berth run scene.yaml --frame 48\n  "
      "berth run scene.yaml "
      "--format json --out result.jsonl");
}

void add_record_options(CLI::App& command, RecordArguments& arguments) {
  add_scene(command, arguments.scene);
  command
      .add_option(
          "--out", arguments.out,
          "The recording; the next ones are FILE_2.mcap and so on, and nothing that is there "
          "is overwritten")
      ->required()
      ->type_name("FILE.mcap");
  command
      .add_option("--seconds", arguments.seconds,
                  "A recording has the last seconds, and up to a quarter more (default: 30)")
      ->check(require_positive_finite)
      ->type_name("N");
  command
      .add_option_function<std::string>(
          "--on", [&arguments](const std::string& when) { arguments.on_stop = when == "stop"; },
          "stop: a recording each time that the monitor stops the robot; always: one at the end "
          "(default: stop)")
      ->check(CLI::IsMember({"stop", "always"}));
  add_threads(command, arguments.threads);
  command.footer("Example:\n  berth record scene.yaml --out stop.mcap");
}

void add_replay_options(CLI::App& command, ReplayArguments& arguments) {
  command.add_option("file", arguments.file, "The recording")->required()->type_name("FILE.mcap");
  add_format(command,
             "A line wherever the robot is let go, slowed down or stopped, or one JSON object per "
             "request (default: "
             "table)",
             arguments.format);
  add_threads(command, arguments.threads);
  command.footer(
      "Exit status 0: all results are the recorded ones to the last bit; 1: one differs, or the "
      "recording is not whole, and the message says where.\nExample:\n  berth replay stop.mcap");
}

void add_filter_options(CLI::App& command, FilterArguments& arguments) {
  add_scene(command, arguments.scene);
  command
      .add_option("--out", arguments.out_folder, "Folder for the images; made if it is not there")
      ->required()
      ->type_name("DIR");
  add_threads(command, arguments.threads);
  command.footer("Example:\n  berth filter scene.yaml --out filtered");
}

void add_calibrate_options(CLI::App& command, CalibrateArguments& arguments) {
  command
      .add_option("scene", arguments.scene,
                  "The scene: the arm in five or more poses, nobody and nothing else moves")
      ->required()
      ->type_name("SCENE.yaml");
  command
      .add_option("--out", arguments.out,
                  "The scene with what was found; the scene itself is never changed")
      ->required()
      ->type_name("NEW.yaml");
  command
      .add_option("--report", arguments.report_folder,
                  "Folder for a page with pictures before and after")
      ->type_name("DIR");
  command.add_flag("--joint-zeros", arguments.joint_zeros,
                   "Look for the joints' zeros, too; wants ten poses or more");
  command.add_flag("--correct-depth", arguments.correct_depth,
                   "Take the camera's depth error out of its readings from now on");
  command.add_flag("--background")
      ->description("No effect: the empty cell that each camera sees is always written, as a PNG");
  command
      .add_option_function<std::string>(
          "--attached",
          [&arguments](const std::string& choice) {
            arguments.attached = choice == "yes"  ? AttachedChoice::yes
                                 : choice == "no" ? AttachedChoice::no
                                                  : AttachedChoice::ask;
          },
          "Whether what the robot carries and its URDF does not have becomes a part of it; "
          "ask takes none where there is no terminal to ask at (default: ask)")
      ->check(CLI::IsMember({"ask", "yes", "no"}));
  add_format(command, "A table for people, or one JSON object (default: table)", arguments.format);
  add_threads(command, arguments.threads);
  command.footer("Example:\n  berth calibrate scene.yaml --out calibrated.yaml --report report");
}

void add_evaluate_options(CLI::App& command, EvaluateArguments& arguments) {
  CLI::Option* const scene =
      command.add_option("scene", arguments.scene, "A scene, instead of three images");
  scene->type_name("SCENE.yaml");
  const auto file = [&command, scene](const char* name, std::filesystem::path& path,
                                      const char* what, const char* type) {
    command.add_option(name, path, what)->excludes(scene)->type_name(type);
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
      ->excludes(scene)
      ->type_name("M");
  command
      .add_option("--robot-region-scale", arguments.robot_region_scale,
                  "With a scene: what is not seen through the robot enlarged by this factor is "
                  "ignored, however near (the thesis: 6); 0 is off (default: 0)")
      ->check(require_region_scale)
      ->type_name("X");
  command.add_option("--repeat", arguments.repeat, "Evaluate N times, and report the times")
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
  add_methods(command, arguments.method, arguments.evaluation);
  add_backend_options(command, "With a scene: where images are rendered and filtered",
                      arguments.where);
  add_output(command, arguments);
  command.callback([&command, &arguments] {
    if (!arguments.scene.empty()) return;
    if (arguments.robot_region_scale != 0) {
      throw CLI::ValidationError("--robot-region-scale", "needs a scene");
    }
    if (arguments.where.backend == Backend::opengl) {
      throw CLI::ValidationError("--backend", "opengl needs a scene");
    }
    for (const char* name : {"--camera", "--robot-depth", "--link-ids", "--obstacle-depth"}) {
      if (command.count(name) == 0) throw CLI::RequiredError(name);
    }
  });
  command.footer(
      "Examples:\n  berth evaluate scene.yaml --method lattice\n  berth evaluate --camera "
      "camera_info.yaml --robot-depth robot_depth_000000.png "
      "\\\n"
      "    --link-ids link_ids_000000.png --obstacle-depth obstacle_depth_000000.png --format "
      "json");
}

void add_view_options(CLI::App& command, ViewArguments& arguments) {
  add_scene(command, arguments.scene);
  add_port(command, arguments.port, "Port of the page; 0 takes any that is free (default: 8080)");
  command
      .add_option("--bind", arguments.bind,
                  "Address to serve at; with another one than this computer's own the printed "
                  "address has a token (default: 127.0.0.1)")
      ->type_name("ADDRESS");
  command
      .add_option("--save-to", arguments.save_folder,
                  "Folder that \"save as\" writes to (default: that of the scene)")
      ->type_name("DIR");
  add_threads(command, arguments.threads);
  command.footer("Example:\n  berth view scene.yaml");
}

void add_init_options(CLI::App& command, InitArguments& arguments) {
  command.add_option("urdf", arguments.urdf, "The robot")->required()->type_name("ROBOT.urdf");
  command
      .add_option("--camera", arguments.camera,
                  "The camera's kind, for settings to begin with (default: other)")
      ->check(CLI::IsMember(camera_kind_names()));
  command
      .add_option_function<std::vector<std::string>>(
          "--package",
          [&arguments](const std::vector<std::string>& all) {
            for (const std::string& one : all) {
              const std::size_t at = one.find('=');
              if (at == 0 || at == std::string::npos) {
                throw CLI::ValidationError("--package", one + " is not NAME=DIR");
              }
              arguments.packages[one.substr(0, at)] = one.substr(at + 1);
            }
          },
          "What package://NAME/ means in the URDF, where no folder of that name lies beside or "
          "above it")
      ->type_name("NAME=DIR");
  command
      .add_option("--out", arguments.out,
                  "The scene; nothing that is there is overwritten (default: scene.yaml)")
      ->type_name("SCENE.yaml");
  command.footer("Example:\n  berth init robot.urdf --camera realsense --out scene.yaml");
}

void add_doctor_options(CLI::App& command, DoctorArguments& arguments) {
  add_scene(command, arguments.scene);
  add_threads(command, arguments.threads);
  command.footer(
      "Exit status 0: nothing is wrong; 1: something is.\nExample:\n  berth doctor scene.yaml");
}

void add_schema_options(CLI::App& command, SchemaArguments& arguments) {
  command.add_option("name", arguments.name, "Which schema")
      ->required()
      ->check(CLI::IsMember({"scene", "result", "calibration"}));
  command.footer("Example:\n  berth schema scene >scene.json");
}

void add_demo_options(CLI::App& command, DemoArguments& arguments) {
  command
      .add_option("--picture", arguments.picture_folder,
                  "Folder for the pictures (default: berth_demo)")
      ->type_name("DIR");
  CLI::Option* view =
      command.add_flag("--view", arguments.view, "Show the scene by a page, as berth view does");
  add_port(command, arguments.port, "With --view: port of the page (default: 8080)");
  command.get_option("--port")->needs(view);
  add_threads(command, arguments.threads);
  command.footer("Example:\n  berth demo --picture pictures");
}

}  // namespace berth::app
