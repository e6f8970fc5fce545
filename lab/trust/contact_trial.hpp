// What the whole pipeline says of links that something touches, or stands near unread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "berth/space/settings.hpp"
#include "lab/trust/trial.hpp"
#include "sim/contact_scene.hpp"

namespace berth::lab {

enum class ContactImages { clean, sensor_model, structured_light };
inline constexpr std::array<const char*, 3> kContactImageNames = {"clean", "sensor model",
                                                                  "structured light"};

/// A drawn contact, and how it is looked at.
struct ContactCase {
  sim::ContactSettings scene;
  ContactImages images = ContactImages::clean;
  /// Whether the cameras have learned the room without the things.
  bool knows_cell = false;
  std::optional<Unobserved> unobserved = std::nullopt;
};

/// One link. Infinite lengths: the answer is that nothing is in range.
struct ContactLink {
  /// Whether there is an answer, ok or none_in_range.
  bool is_told = false;
  /// Whether a camera looks at the nearest place of what is near (ContactScene).
  bool is_covered = false;
  /// The share of the ball that its answer speaks of that lies in no image.
  double unobserved_share = 0;
  /// Up to kTrialRange_m.
  double truth_m = 0;
  double distance_m = 0;
  double occupied_m = 0;
  /// How much farther than the truth; at most the range less the truth.
  double too_far_m() const { return std::min(distance_m, kTrialRange_m) - truth_m; }
  double occupied_too_far_m() const { return std::min(occupied_m, kTrialRange_m) - truth_m; }
};

struct ContactTrial {
  std::uint32_t seed = 0;
  std::string robot;
  int cameras = 0;
  /// Whether the things are thinner than what the result of the nearest link assumes.
  bool is_assumed_away = false;
  std::vector<ContactLink> links;
};

/// Depends on its arguments alone. All settings of the pipeline are the defaults.
ContactTrial run_contact_trial(const TrialRobot& robot, const ContactCase& of, std::uint32_t seed);

/// People beside all images by SpaceSettings::unobserved with one to four cameras, as Markdown;
/// each row has this number of scenes.
std::string unobserved_table(const std::vector<TrialRobot>& robots, int first, int scenes);

/// Things of each kind with one to three cameras, as Markdown; `scenes` are shared by its rows.
std::string contact_table(const std::vector<TrialRobot>& robots, int first, int scenes);

}  // namespace berth::lab
