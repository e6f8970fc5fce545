#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <stdexcept>

#include "apps/berth/commands.hpp"
#include "apps/berth/run_frames.hpp"
#include "berth/io/result_table.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

/// Beside an installed program, or in the source tree of a program that was only built.
fs::path find_bundled_scene() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path places[] = {program.parent_path().parent_path() / "share/berth/bundled",
                             BERTH_BUNDLED_SCENE};
  for (const fs::path& folder : places) {
    if (fs::is_regular_file(folder / "scene.yaml")) return folder / "scene.yaml";
  }
  throw std::runtime_error(
      fmt::format("the bundled scene is not there; expected scene.yaml in {} or {}",
                  places[0].string(), places[1].string()));
}

/// The least distance of any link; none where no link has one.
std::optional<float> least_distance_m(const FrameResult& result) {
  std::optional<float> least;
  for (const LinkDistance& link : result.distances->links) {
    if (link.status == LinkStatus::ok && (!least || link.distance_m < *least))
      least = link.distance_m;
  }
  return least;
}

}  // namespace

void demo_command(const DemoArguments& arguments) {
  const OpenScene scene = open_scene(find_bundled_scene(), {});
  std::optional<float> least_m;
  std::string closest;
  run_frames(scene, arguments.picture_folder, [&](const FrameResult& result) {
    const auto distance_m = least_distance_m(result);
    if (!distance_m || (least_m && *least_m <= *distance_m)) return;
    least_m = distance_m;
    closest = fmt::format("The closest approach in {} frames is in frame {}, {:.3f} s:\n\n{}",
                          scene.frame_count, result.frame, result.stamp_s, result_table(result));
  });
  fmt::print("{}\nPictures of all frames: {}\n", closest,
             fs::absolute(arguments.picture_folder).lexically_normal().string());
}

}  // namespace berth
