#include "moveit_attached.hpp"

#include <stdexcept>

namespace berth_ros {
namespace {

using Object = moveit_msgs::msg::AttachedCollisionObject;

void require(bool holds, const Object& object, const std::string& what) {
  if (!holds) throw std::invalid_argument("object \"" + object.object.id + "\": " + what);
}

/// In place of one of the same name, or at the end; or it is taken out.
void change(const Object& changed, std::vector<Object>& objects) {
  std::erase_if(objects, [&](const Object& one) { return one.object.id == changed.object.id; });
  if (changed.object.operation != moveit_msgs::msg::CollisionObject::ADD) return;
  objects.push_back(changed);
  objects.back().object.header.stamp = builtin_interfaces::msg::Time();
}

}  // namespace

AttachmentList attachments_of(const Object& object) {
  const auto& shapes = object.object;
  const std::string& frame = shapes.header.frame_id;
  require(frame.empty() || frame == object.link_name, object,
          "its pose is in " + frame + "; expected its link " + object.link_name);
  require(shapes.planes.empty(), object, "has a plane; expected primitives and meshes");
  require(shapes.primitives.size() == shapes.primitive_poses.size() &&
              shapes.meshes.size() == shapes.mesh_poses.size(),
          object, "expected a pose for each shape");
  const std::size_t count = shapes.primitives.size() + shapes.meshes.size();
  require(count > 0, object, "has no shape");
  const berth::Pose X_LO = pose_of(shapes.pose);
  AttachmentList list;
  const auto add = [&](const auto& shape, const geometry_msgs::msg::Pose& pose) {
    berth::Attachment part;
    part.name = shapes.id;
    if (count > 1) part.name += "/" + std::to_string(list.size());
    part.link = object.link_name;
    part.is_link = true;
    part.X_LA = X_LO * pose_of(pose);
    part.may_touch = object.touch_links;
    part.mesh_A = mesh_of(shape);
    list.push_back(part);
  };
  for (std::size_t i = 0; i < shapes.primitives.size(); ++i) {
    add(shapes.primitives[i], shapes.primitive_poses[i]);
  }
  for (std::size_t i = 0; i < shapes.meshes.size(); ++i) {
    add(shapes.meshes[i], shapes.mesh_poses[i]);
  }
  return list;
}

MoveItAttached::MoveItAttached(rclcpp_lifecycle::LifecycleNode& node, ChangeAttached change)
    : logger_(node.get_logger()), change_(std::move(change)) {
  subscription_ = node.create_subscription<moveit_msgs::msg::PlanningScene>(
      "monitored_planning_scene", rclcpp::QoS(10),
      [this](const moveit_msgs::msg::PlanningScene& scene) { take(scene); });
}

void MoveItAttached::take(const moveit_msgs::msg::PlanningScene& scene) {
  // MoveIt writes a state as a change even where it reports all of it: what is no more attached is
  // missing there, and nobody says that it was removed.
  const bool is_whole = !scene.is_diff || !scene.robot_state.joint_state.name.empty();
  std::vector<Object> objects = is_whole ? std::vector<Object>() : objects_;
  for (const Object& object : scene.robot_state.attached_collision_objects) {
    change(object, objects);
  }
  if (objects == objects_) return;
  objects_ = objects;
  follow(objects);
}

void MoveItAttached::follow(const std::vector<Object>& objects) {
  AttachmentList list;
  for (const Object& object : objects) {
    try {
      const AttachmentList parts = attachments_of(object);
      list.insert(list.end(), parts.begin(), parts.end());
    } catch (const std::exception& error) {
      RCLCPP_WARN(logger_, "not attached, as MoveIt did: %s", error.what());
    }
  }
  try {
    change_([&](Attached& attached) { attached.followed = list; });
    RCLCPP_INFO(logger_, "attached what MoveIt did: %zu shapes", list.size());
  } catch (const std::exception& error) {
    // The next message tries again.
    objects_.clear();
    RCLCPP_WARN(logger_, "not attached what MoveIt did: %s", error.what());
  }
}

}  // namespace berth_ros
