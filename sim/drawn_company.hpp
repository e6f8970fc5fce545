// Company: people and things that move beside a robot that is calibrated, though nobody should.
#pragma once

#include <array>

#include "sim/carrying_robot.hpp"
#include "sim/random.hpp"

namespace berth::sim {

enum class DrawnCompany {
  walker,    ///< a person, somewhere else near the tip in each pose
  follower,  ///< a person who keeps his place beside the tip, and turns about the vertical with it
  guide,     ///< a hand that holds the tip, and the arm of a person who hardly moves
  cart,      ///< a table just below all poses of the tip, which was rolled in after the first pose
  robot,     ///< a second robot of this kind, in poses of its own
  twin,      ///< a second robot of this kind, in the same poses
};
inline constexpr std::array kDrawnCompany = {DrawnCompany::walker, DrawnCompany::follower,
                                             DrawnCompany::guide,  DrawnCompany::cart,
                                             DrawnCompany::robot,  DrawnCompany::twin};

/// Puts the company beside the robot in each of the poses. It may meet the robot.
void add_company(Random& random, const RobotModel& model, DrawnCompany company,
                 CarryingRobotSettings& settings);

}  // namespace berth::sim
