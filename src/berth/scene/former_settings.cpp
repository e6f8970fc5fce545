#include "berth/scene/former_settings.hpp"

#include <fmt/format.h>

#include <array>

namespace berth {
namespace {

struct Ended {
  std::string_view group;
  std::string_view key;
  /// What to do instead; empty: nothing.
  std::string_view instead = {};
};

constexpr std::string_view kConstant = "it is a constant now, as nobody could choose it";
constexpr std::string_view kOfImages = "berth evaluate compares images, and has it as an option";

constexpr std::array kEnded = std::to_array<Ended>({
    {"evaluation", "method", "delete it; berth evaluate SCENE.yaml --method compares images"},
    {"evaluation", "region", kOfImages},
    {"evaluation", "depth_interval", kOfImages},
    {"evaluation", "search_pattern", kOfImages},
    {"evaluation", "shrinking", kOfImages},
    {"evaluation", "step_x", kOfImages},
    {"evaluation", "step_y", kOfImages},
    {"evaluation", "initial_grid_radius_px", kOfImages},
    {"evaluation", "final_grid_radius_px", kOfImages},
    {"evaluation", "tile_px", kOfImages},
    {"self_filter", "tolerance_per_m", "use tolerance_m and tolerance_per_m2"},
    {"self_filter", "environment_padding_m", "environment has padding_m"},
    {"self_filter", "padding_depth_m", kConstant},
    {"self_filter", "robot_region_scale", kOfImages},
    {"sensor", "average_frames", "on recordings no distance came nearer to the truth"},
    {"sensor", "background_clearance_m", kConstant},
    {"sensor", "noise_m", kConstant},
    {"space", "surface_thickness_m", kConstant},
    {"space", "free_space_margin_m", kConstant},
    {"space", "behind_robot_m", kConstant},
    {"space", "free_space_max_age_s", kConstant},
    {"space", "obstacle_speed_m_s", kConstant},
    {"watch", "agreeing_frames", kConstant},
    {"watch", "frames", kConstant},
    {"watch", "check_every_s", kConstant},
    {"time", "max_frame_gap_s", kConstant},
    {"time", "max_clock_offset_s", kConstant},
    {"time", "max_extrapolation_s", kConstant},
    {"separation", "least_scale", kConstant},
    {"separation", "least_seen", kConstant},
    {"separation", "directed_speed"},
    {"separation", "hold_s"},
    {"separation", "release_m"},
    {"self_filter", "dilation_px"},
    {"self_filter", "edge_jump_m"},
    {"self_filter", "flying_patch_jump_m"},
    {"self_filter", "island_jump_m"},
    {"sensor", "speckle_jump_m"},
    {"sensor", "holes"},
});

void tell_group(std::string_view name, const YamlValue& group, std::vector<std::string>& told) {
  if (!group.is_map()) return;
  for (const auto& [key, value] : group.entries()) {
    for (const Ended& ended : kEnded) {
      if (ended.group != name || ended.key != key) continue;
      told.push_back(fmt::format("{}:{}: {}.{} is no setting any more, and has no effect{}{}",
                                 value.place().file.string(), value.place().line, name, key,
                                 ended.instead.empty() ? "" : "; ", ended.instead));
    }
  }
}

void tell_all(const YamlValue& value, std::vector<std::string>& told) {
  if (value.is_list()) {
    for (const YamlValue& item : value.list()) tell_all(item, told);
  }
  if (!value.is_map()) return;
  for (const auto& [key, entry] : value.entries()) {
    const bool is_group = !ended_settings(key).empty();
    is_group ? tell_group(key, entry, told) : tell_all(entry, told);
  }
}

}  // namespace

std::vector<std::string_view> ended_settings(std::string_view group) {
  std::vector<std::string_view> keys;
  for (const Ended& ended : kEnded) {
    if (ended.group == group) keys.push_back(ended.key);
  }
  return keys;
}

void require_no_hole_policy(const YamlMap& sensor) {
  const auto holes = sensor.find("holes");
  if (!holes || holes->text() == "free") return;
  holes->fail(
      "space.no_reading: hides in its place, or a background of the camera (berth calibrate writes "
      "it): what gives no reading is unknown space now, and no obstacle right before the camera");
}

std::vector<std::string> ended_settings_in(const YamlValue& document) {
  std::vector<std::string> told;
  tell_all(document, told);
  return told;
}

}  // namespace berth
