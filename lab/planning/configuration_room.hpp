// Configurations in a drawn room, and what the exact search says of them.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "berth/pipeline/query.hpp"
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

/// The robot holding a rod of 30 cm.
std::shared_ptr<const Robot> with_rod(const Robot& robot);

std::vector<JointState> states_of(std::span<const double> positions, std::size_t joints);

/// Of all moved links of a configuration: as LinkResult::distance_m and lower_bound_m. Infinite
/// where nothing is in range, for the first.
struct LeastDistance {
  float distance_m = std::numeric_limits<float>::infinity();
  float lower_bound_m = std::numeric_limits<float>::infinity();
};

/// The exact search, which goes no farther than range_m.
class ExactSearch {
 public:
  ExactSearch(const std::shared_ptr<const Robot>& robot, const FrameList& frames, double range_m);

  std::vector<LeastDistance> ask(std::span<const double> positions);

 private:
  std::shared_ptr<const Robot> robot_;
  const FrameList& frames_;
  Query query_;
};

}  // namespace berth::lab
