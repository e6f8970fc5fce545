// init: a scene to begin with.
#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "apps/berth/commands.hpp"
#include "apps/berth/new_scene.hpp"
#include "apps/support/data_folders.hpp"
#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"

namespace berth::app {
namespace {

RobotModel load(const RobotSettings& robot) {
  try {
    return load_robot(robot);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    if (text.find("package_paths") == std::string::npos) throw;
    throw std::runtime_error(text + "; --package NAME=DIR tells one");
  }
}

}  // namespace

void init_command(const InitArguments& arguments) {
  // A broken link is a file that somebody has there, too.
  if (std::filesystem::symlink_status(arguments.out).type() !=
      std::filesystem::file_type::not_found) {
    throw_bad_file({arguments.out}, "is there already", "another name for --out");
  }
  NewScene scene;
  scene.robot.urdf = arguments.urdf;
  for (const auto& [name, folder] : arguments.packages) scene.robot.package_paths[name] = folder;
  scene.camera = arguments.camera;
  scene.out = arguments.out;
  scene.schema = scene_schema_file();
  const RobotModel model = load(scene.robot);
  write_file_bytes(arguments.out, new_scene_text(scene, model));
  fmt::print(
      "{}: written for robot \"{}\": {} links, {} joints. Fill in what it marks with FILL IN, "
      "then: berth doctor {}\n",
      arguments.out.string(), model.name, model.link_count(), model.joints.size(),
      arguments.out.string());
}

}  // namespace berth::app
