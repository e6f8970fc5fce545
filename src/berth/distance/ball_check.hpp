// Inside berth only: many configurations against one ClearanceField.
#pragma once

#include <functional>
#include <span>

#include "berth/distance/ball_robot.hpp"
#include "berth/space/clearance_field.hpp"
#include "berth/types/verdict.hpp"

namespace berth::mesh {

/// What is certain of a link: nothing is nearer than lower_m, and something no farther than
/// upper_m.
struct LinkBounds {
  float lower_m = 0;
  float upper_m = 0;
};

/// Of each of BallRobot::links that one joint alone moves, where that joint stands at that angle,
/// in [-pi, pi], or place. Many threads may ask at a time.
using FirstLinkBounds = std::function<LinkBounds(std::size_t link, float at)>;

/// What is asked, of all configurations alike.
struct BallRequest {
  const BallRobot& robot;
  ClearanceField::Grid grid;
  /// Of each of BallRobot::links; NaN: it is left out.
  std::span<const float> margins_m;
  /// Asked where nothing else is undecided: such links often stand as near as they always do. May
  /// be empty.
  const FirstLinkBounds& first_link_bounds;
  /// The pairs that have to be farther apart than this, too; null: they are not asked about.
  const BallPairs* pairs = nullptr;
  float pairs_margin_m = 0;
  /// Of each of BallPairs::still as margins_m.
  std::span<const std::vector<float>> still_margins_m = {};
};

/// Joint positions one configuration after another; `out` has one verdict for each. `free` and
/// `near` hold for the links' surfaces and the field's space, whatever is rounded.
void check_configurations(const BallRequest& request, std::span<const double> positions,
                          std::span<Verdict> out);

/// The same of all configurations on a straight line in joint space. It is cut until each part is
/// free, since its links' balls are at its middle, by as much as they move on the part; one that no
/// joint moves farther on than `least_step` (rad, m) is undecided.
Verdict check_motion(const BallRequest& request, std::span<const double> from,
                     std::span<const double> to, float least_step);

}  // namespace berth::mesh
