// Configurations in a drawn room, and what the exact search says of them.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "berth/pipeline/query.hpp"
#include "berth/types/verdict.hpp"
#include "sim/random.hpp"

namespace berth::lab {

using FrameList = std::vector<std::shared_ptr<const Frame>>;

struct RoomView {
  std::uint32_t seed = 1;
  int cameras = 3;
  /// Images of the sensor model.
  bool has_errors = false;
};

/// A room that its cameras have seen once, and the robot in it.
class ConfigurationRoom {
 public:
  ConfigurationRoom(std::shared_ptr<const Robot> robot, const RoomView& view);

  const std::shared_ptr<const Robot>& robot() const { return robot_; }
  const FrameList& frames() const { return frames_; }
  sim::Random& random() { return random_; }

  /// Joint positions one configuration after another: anywhere within the limits, or each joint
  /// within 0.4 rad of where it is.
  std::vector<double> draw(std::size_t count, bool is_anywhere);

 private:
  std::shared_ptr<const Robot> robot_;
  sim::Random random_;
  std::vector<double> position_;
  FrameList frames_;
};

/// Rooms one after another, with a folder's robots in turn.
struct RoomOptions {
  std::filesystem::path robots;
  /// The first room's.
  RoomView view;
  int rooms = 11;
};

void add_room_options(CLI::App& program, RoomOptions& options);

/// On one core, since times are to be those of one. Throws as load_trial_robots.
void for_each_room(const RoomOptions& options,
                   const std::function<void(const std::shared_ptr<const Robot>& robot,
                                            const RoomView& view)>& take);

/// The robot holding a rod of 30 cm.
std::shared_ptr<const Robot> with_rod(const Robot& robot);

std::vector<JointState> states_of(std::span<const double> positions, std::size_t joints);

/// The exact search, over the robot's range.
class ExactSearch {
 public:
  ExactSearch(std::shared_ptr<const Robot> robot, const FrameList& frames)
      : robot_(std::move(robot)), frames_(frames), query_(robot_) {}

  /// All moved links of each configuration: as LinkResult::nearest.
  std::vector<std::vector<SpacePair>> ask(std::span<const double> positions);

 private:
  std::shared_ptr<const Robot> robot_;
  const FrameList& frames_;
  Query query_;
};

/// What the exact search says of a margin: `undecided` where something is as far as that, to its
/// tolerance. It looks no farther than tells, which takes a ninth of the time.
class MarginSearch {
 public:
  MarginSearch(const std::shared_ptr<const Robot>& robot, const FrameList& frames, double margin_m)
      : margin_m_(margin_m), search_(within(robot, margin_m), frames) {}

  std::vector<Verdict> ask(std::span<const double> positions);

 private:
  static std::shared_ptr<const Robot> within(const std::shared_ptr<const Robot>& robot,
                                             double margin_m);

  double margin_m_;
  ExactSearch search_;
};

}  // namespace berth::lab
