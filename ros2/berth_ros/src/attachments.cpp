#include "attachments.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tf2_eigen/tf2_eigen.hpp>

#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/robot/primitives.hpp"
#include "robot_description.hpp"

namespace berth_ros {
namespace {

/// q and -q are one rotation; a message's numbers may be rounded.
constexpr double kMostOffUnit = 1e-3;

double size_m(const shape_msgs::msg::SolidPrimitive& shape, std::size_t i) {
  if (i >= shape.dimensions.size()) {
    throw std::invalid_argument("shape: " + std::to_string(shape.dimensions.size()) +
                                " dimensions; expected more for its type");
  }
  const double size = shape.dimensions[i];
  if (std::isfinite(size) && size > 0) return size;
  throw std::invalid_argument("shape: dimension " + std::to_string(i) + " is " +
                              std::to_string(size) + "; expected metres above 0");
}

template <class Response, class Act>
void answer(Response& response, Act&& act) {
  try {
    act();
    response.success = true;
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
  }
}

}  // namespace

berth::TriangleMesh mesh_of(const shape_msgs::msg::SolidPrimitive& shape) {
  using Shape = shape_msgs::msg::SolidPrimitive;
  switch (shape.type) {
    case Shape::BOX:
      return berth::make_box(
          {size_m(shape, Shape::BOX_X), size_m(shape, Shape::BOX_Y), size_m(shape, Shape::BOX_Z)});
    case Shape::SPHERE:
      return berth::make_sphere(size_m(shape, Shape::SPHERE_RADIUS));
    case Shape::CYLINDER:
      return berth::make_cylinder(size_m(shape, Shape::CYLINDER_RADIUS),
                                  size_m(shape, Shape::CYLINDER_HEIGHT));
    default:
      throw std::invalid_argument("shape: type " + std::to_string(int{shape.type}) +
                                  "; expected BOX (1), SPHERE (2) or CYLINDER (3)");
  }
}

berth::TriangleMesh mesh_of(const shape_msgs::msg::Mesh& mesh) {
  berth::TriangleMesh out;
  for (const auto& vertex : mesh.vertices) {
    const Eigen::Vector3d p_m(vertex.x, vertex.y, vertex.z);
    if (!p_m.allFinite()) {
      throw std::invalid_argument("mesh: vertex " + std::to_string(out.vertices_m.size()) +
                                  " is not finite; expected metres");
    }
    out.vertices_m.push_back(p_m.cast<float>());
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle.vertex_indices) {
      if (corner < out.vertices_m.size()) continue;
      throw std::invalid_argument("mesh: a triangle has vertex " + std::to_string(corner) +
                                  "; expected one of " + std::to_string(out.vertices_m.size()));
    }
    out.triangles.push_back(triangle.vertex_indices);
  }
  return out;
}

berth::Pose pose_of(const geometry_msgs::msg::Pose& pose) {
  berth::Pose out;
  const auto& q = pose.orientation;
  const Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
  const Eigen::Vector3d position(pose.position.x, pose.position.y, pose.position.z);
  // So is NaN.
  if (!(std::abs(rotation.norm() - 1) <= kMostOffUnit) || !position.allFinite()) {
    throw std::invalid_argument(
        "pose: not finite, or a quaternion whose length is not 1; expected a pose in the link's "
        "frame");
  }
  out = Eigen::Translation3d(position) * rotation.normalized();
  return out;
}

berth::Attachment attachment_of(const berth_msgs::srv::Attach::Request& request) {
  const bool has_shape = request.shape.type != 0;
  const bool has_mesh = !request.mesh.triangles.empty();
  const bool has_resource = !request.mesh_resource.empty();
  if (has_shape + has_mesh + has_resource != 1) {
    throw std::invalid_argument("expected one of shape, mesh and mesh_resource; " +
                                std::to_string(has_shape + has_mesh + has_resource) + " are given");
  }
  if (request.name.empty()) throw std::invalid_argument("name: empty; expected a name");
  berth::Attachment attachment;
  attachment.name = request.name;
  attachment.link = request.link;
  attachment.is_link = request.is_link;
  attachment.X_LA = pose_of(request.pose);
  attachment.may_touch = request.may_touch;
  attachment.mesh_A = has_shape  ? mesh_of(request.shape)
                      : has_mesh ? mesh_of(request.mesh)
                                 : berth::read_mesh_file(mesh_file_of(request.mesh_resource));
  return attachment;
}

AttachmentList Attached::all() const {
  AttachmentList both = told;
  both.insert(both.end(), followed.begin(), followed.end());
  return both;
}

void Attached::detach(const std::string& name) {
  const auto is_it = [&](const berth::Attachment& one) { return one.name == name; };
  if (std::erase_if(told, is_it) > 0) return;
  throw std::invalid_argument("name: nothing called \"" + name + "\" was attached by a message");
}

void keep_touched_of(const berth::RobotModel& model, AttachmentList& list) {
  for (berth::Attachment& one : list) {
    std::erase_if(one.may_touch, [&](const std::string& link) { return !model.find_link(link); });
  }
}

std::vector<std::string> Attached::keep_those_of(const berth::RobotModel& model) {
  std::vector<std::string> lost;
  for (AttachmentList* list : {&told, &followed}) {
    std::erase_if(*list, [&](const berth::Attachment& one) {
      const bool is_lost = !model.find_link(one.link);
      if (is_lost) lost.push_back(one.name);
      return is_lost;
    });
    keep_touched_of(model, *list);
  }
  return lost;
}

Attachments::Attachments(rclcpp_lifecycle::LifecycleNode& node, const ChangeAttached& change) {
  using berth_msgs::srv::Attach;
  using berth_msgs::srv::Detach;
  attach_ = node.create_service<Attach>(
      "~/attach",
      [change](const Attach::Request::SharedPtr& request, const Attach::Response::SharedPtr& out) {
        answer(*out, [&] {
          const berth::Attachment part = attachment_of(*request);
          change([&](Attached& attached) { attached.told.push_back(part); });
        });
      });
  detach_ = node.create_service<Detach>(
      "~/detach",
      [change](const Detach::Request::SharedPtr& request, const Detach::Response::SharedPtr& out) {
        answer(*out, [&] { change([&](Attached& attached) { attached.detach(request->name); }); });
      });
}

}  // namespace berth_ros
