#include "lab/calibration/judge.hpp"

#include <fmt/format.h>

#include "berth/files/png.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "lab/filter/expected_ranges.hpp"

namespace berth::lab {
namespace {

constexpr double kFar_m = 0.01;

void set(const std::vector<ProposedSetting>& proposed, auto& settings) {
  for (const ProposedSetting& one : proposed) {
    visit_settings(settings, [&](const Setting& setting, auto& value) {
      if (setting.name != one.key) return;
      if constexpr (std::is_arithmetic_v<std::remove_reference_t<decltype(value)>>) {
        value = static_cast<std::remove_reference_t<decltype(value)>>(one.value);
      }
    });
  }
}

void count_mask(const std::filesystem::path& file, const Camera& camera,
                const ObstacleImage& obstacles, Judgement& judgement) {
  const Image<LinkId> mask = read_link_ids_png(file, camera);
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    if (mask.pixels()[i] == 0) continue;
    ++judgement.mask_pixels;
    judgement.mask_pixels_left += is_kept(obstacles.fate.pixels()[i]);
  }
}

}  // namespace

SceneFile with_result(SceneFile scene, const CalibrationResult& found,
                      const FilterProposal& proposal) {
  SceneCamera& camera = scene.cameras[0];
  camera.X_PC = found.cameras[0].X_PC;
  camera.clock_offset_s = found.cameras[0].clock_offset_s;
  for (const auto& [joint, offset] : found.joint_offsets) scene.joint_offsets[joint] += offset;
  set(proposal.self_filter, camera.settings.self_filter);
  set(proposal.sensor, camera.settings.sensor);
  return scene;
}

Judgement judge(const SceneFile& file, const std::filesystem::path& folder) {
  const OpenScene scene = open_scene(file);
  const OpenCamera& camera = scene.cameras.front();
  const ExpectedRanges ranges = read_expected_ranges(folder / "expected.tsv");
  const std::vector<std::string> names = scene.robot->model().evaluated_link_names();
  Observer observer(camera.view);
  Asker asker(scene.robot);
  Frame frame;
  Judgement judgement;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    observer.observe(camera.read_depth(i), camera.at_exposure[i], frame);
    for (const LinkDistance& link : asker.ask(frame).distances.links) {
      const ExpectedRange& range = ranges.at({static_cast<int>(i), names[link.id - 1]});
      const bool is_inside = link.distance_m >= range.min_m && link.distance_m <= range.max_m;
      (range.is_checked ? judgement.checked : judgement.estimates) += 1;
      (range.is_checked ? judgement.checked_in_range : judgement.estimates_in_range) += is_inside;
      judgement.too_far += !(link.distance_m <= range.max_m + kFar_m);
    }
    count_mask(folder / fmt::format("reference/robot_mask_{:06}.png", i), camera.view->camera(),
               frame.obstacles, judgement);
  }
  return judgement;
}

std::string text_of(const Judgement& judgement) {
  return fmt::format("{} of {} checked rows in range, {} of {} estimates, {} too far; {} of {} mask "
                     "pixels left",
                     judgement.checked_in_range, judgement.checked, judgement.estimates_in_range,
                     judgement.estimates, judgement.too_far, judgement.mask_pixels_left,
                     judgement.mask_pixels);
}

}  // namespace berth::lab
