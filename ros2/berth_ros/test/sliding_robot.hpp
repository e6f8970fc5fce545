// A robot of two joints with a result that a test makes by hand.
#pragma once

#include "berth/control/distance_rows.hpp"
#include "robot_description.hpp"

namespace berth_ros {

/// An arm that slides along y, and a hand 0.3 m beside it that turns about z. Nothing is near.
struct SlidingRobot {
  SlidingRobot() {
    berth::forward_kinematics(robot->model(), std::vector<double>{0, 0}, result.pose);
    result.status = berth::ResultStatus::ok;
    result.cameras.resize(1);
    for (const std::string& name : robot->model().evaluated_link_names()) {
      berth::LinkResult& link = result.links.emplace_back();
      link.id = static_cast<berth::LinkId>(result.links.size());
      link.link = name;
      link.is_moved = name != "base";
      link.status = berth::LinkStatus::none_in_range;
      link.lower_bound_m = 1;
    }
  }

  /// Something so far from the middle of the hand, along y.
  void put_near_hand(float distance_m) {
    berth::LinkResult& hand = result.links[2];
    hand.status = berth::LinkStatus::ok;
    hand.distance_m = hand.lower_bound_m = distance_m;
    hand.robot_point_B_m = {0.6F, 0, 0};
    hand.obstacle_point_B_m = {0.6F, distance_m, 0};
    hand.camera = 0;
    hand.occupied = hand;
  }

  static std::string urdf() {
    const auto link = [](const std::string& name) {
      return "<link name='" + name + "'><collision><geometry><box size='0.1 0.1 0.1'/></geometry>" +
             "</collision></link>";
    };
    const auto joint = [](const std::string& name, const std::string& type,
                          const std::string& parent, const std::string& child,
                          const std::string& axis) {
      return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
             "'/><child link='" + child + "'/><origin xyz='0.3 0 0'/><axis xyz='" + axis +
             "'/><limit lower='-3' upper='3' effort='1' velocity='2'/></joint>";
    };
    return "<robot name='sliding'>" + link("base") + link("arm") + link("hand") +
           joint("slide", "prismatic", "base", "arm", "0 1 0") +
           joint("turn", "revolute", "arm", "hand", "0 0 1") + "</robot>";
  }

  std::shared_ptr<const berth::Robot> robot = std::make_shared<const berth::Robot>(
      load_description(urdf(), {.geometry = berth::GeometryKind::collision}));
  berth::Result result;
};

}  // namespace berth_ros
