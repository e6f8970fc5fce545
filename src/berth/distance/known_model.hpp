// Pairs of links whose distance is looked for, and pairs that are left out.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <set>
#include <string_view>
#include <vector>

#include "berth/distance/mesh_parts.hpp"
#include "berth/distance/robot_patches.hpp"

namespace berth {

/// Why a pair of links is left out.
enum class LeftOutReason {
  fixed,         ///< only fixed joints lie between them
  neighbours,    ///< one hangs on the other, by a joint or over links without shapes
  always_touch,  ///< they touch in each of kDrawnPoses poses drawn within the joints' limits
  srdf,          ///< disable_collisions of the SRDF names them
  allowed,       ///< RobotSettings::allowed_contacts or Attachment::may_touch names them
};
inline constexpr std::array<std::string_view, 5> kLeftOutReasonNames = {
    "fixed", "neighbours", "always_touch", "srdf", "allowed"};
constexpr std::string_view name_of(LeftOutReason reason) {
  return kLeftOutReasonNames[static_cast<std::size_t>(reason)];
}

/// Two links by their places in RobotModel::links.
struct LeftOutPair {
  std::size_t link = 0;
  std::size_t other = 0;
  LeftOutReason reason = LeftOutReason::fixed;
};

/// A link with shapes: an evaluated one, or environment.
struct KnownBody {
  /// Of RobotModel::links.
  std::size_t link = 0;
  const LinkPatches* patches = nullptr;
  mesh::MeshParts parts;
  /// Whether it is evaluated and a joint moves it: it has a KnownPair.
  bool is_asked = false;
};

/// Which pairs of links are looked at, of one robot: constant, shared by all askers.
struct KnownModel {
  static constexpr int kDrawnPoses = 1000;

  std::shared_ptr<const RobotPatches> patches;
  std::vector<LinkPatches> environment;
  /// The evaluated links by their ids, then environment.
  std::vector<KnownBody> bodies;
  /// Places in `bodies`; the first one is asked about.
  std::vector<std::array<std::size_t, 2>> pairs;
  /// Pairs that have an asked link and are not among `pairs`.
  std::vector<LeftOutPair> left_out;
};

/// Draws poses until each remaining pair was apart in one: some milliseconds, and twenty for
/// two links that always touch, unless they are in `touching`, places in RobotModel::links. The
/// same on each call.
std::shared_ptr<const KnownModel> build_known_model(
    const RobotModel& model, std::shared_ptr<const RobotPatches> patches,
    const std::set<std::array<std::size_t, 2>>& touching = {});

}  // namespace berth
