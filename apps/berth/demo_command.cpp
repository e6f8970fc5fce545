#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "apps/berth/commands.hpp"
#include "apps/support/data_folders.hpp"
#include "apps/berth/run_frames.hpp"
#include "berth/scene/result_table.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

/// The least distance of any link that a joint moves; none where no such link has one.
std::optional<float> least_distance_m(const FrameResult& result) {
  std::optional<float> least;
  const std::vector<LinkDistance>& links = result.distances->links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].status != LinkStatus::ok || !result.is_moved(i)) continue;
    if (!least || links[i].distance_m < *least) least = links[i].distance_m;
  }
  return least;
}

}  // namespace

void demo_command(const DemoArguments& arguments) {
  if (arguments.view) {
    // Nobody's own scene lies beside the bundled one.
    return view_command({.scene = bundled_scene_file(),
                         .port = arguments.port,
                         .save_folder = fs::current_path()});
  }
  const OpenScene scene = open_scene_over(bundled_scene_file(), {});
  std::optional<float> least_m;
  std::string closest;
  run_frames(scene, {}, arguments.picture_folder, 0, [&](const FrameResult& result) {
    const auto distance_m = least_distance_m(result);
    if (!distance_m || (least_m && *least_m <= *distance_m)) return;
    least_m = distance_m;
    closest = fmt::format("The closest approach in {} images is in frame {}, {:.3f} s:\n\n{}",
                          scene.frame_count, result.frame, result.stamp_s, result_table(result));
  });
  fmt::print("{}\nPictures of all frames: {}\n", closest,
             fs::absolute(arguments.picture_folder).lexically_normal().string());
}

}  // namespace berth::app
