#include "berth/robot/attachment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "berth/robot/plausible_size.hpp"

namespace berth {
namespace {

/// Nobody carries what reaches farther; a mesh of 2 cm in millimetres does.
constexpr double kFarthestPart_m = 20;

[[noreturn]] void fail(const Attachment& attachment, const std::string& what) {
  throw std::invalid_argument(fmt::format("attached \"{}\": {}", attachment.name, what));
}

std::size_t find_evaluated(const RobotModel& model, const Attachment& attachment) {
  const auto index = model.find_link(attachment.link);
  if (index && model.links[*index].role == LinkRole::evaluated) return *index;
  // Also a link without geometry, such as a tool's frame, may hold something.
  if (index && attachment.is_link && model.links[*index].role == LinkRole::ignored) return *index;
  fail(attachment,
       fmt::format("link \"{}\" is no evaluated link of robot \"{}\"; expected one of {}",
                   attachment.link, model.name, fmt::join(model.evaluated_link_names(), ", ")));
}

void require_touched(const RobotModel& model, const Attachment& attachment) {
  if (attachment.may_touch.empty()) return;
  if (!attachment.is_link || attachment.is_soft) {
    fail(attachment, "may_touch is for a link of its own; expected a name, and nothing soft");
  }
  for (const std::string& touched : attachment.may_touch) {
    if (model.find_link(touched)) continue;
    fail(attachment, fmt::format("may_touch: no link \"{}\" in robot \"{}\"; expected one", touched,
                                 model.name));
  }
}

}  // namespace

RobotModel with_attachment(const RobotModel& model, const Attachment& attachment) {
  const std::size_t parent = find_evaluated(model, attachment);
  if (attachment.mesh_A.empty()) fail(attachment, "the mesh has no triangles; expected some");
  if (const double reach = reach_m(attachment.mesh_A); !(reach <= kFarthestPart_m)) {
    fail(attachment, fmt::format("reaches {:g} m from its origin; expected at most {:g} m. If its "
                                 "lengths are in millimetres, write them in metres",
                                 reach, kFarthestPart_m));
  }
  if (!attachment.X_LA.matrix().allFinite()) {
    fail(attachment, "the pose X_LA is not set; expected finite numbers");
  }
  require_touched(model, attachment);
  RobotModel result = model;
  if (attachment.is_soft) {
    TriangleMesh mesh_L;
    mesh_L.append(attachment.mesh_A, Eigen::Affine3d(attachment.X_LA));
    try {
      result.soft_bodies.emplace_back(parent, mesh_L);
    } catch (const std::invalid_argument& error) {
      fail(attachment, error.what());
    }
    return result;
  }
  if (!attachment.is_link) {
    result.links[parent].mesh_L.append(attachment.mesh_A, Eigen::Affine3d(attachment.X_LA));
    return result;
  }
  if (model.find_link(attachment.name)) {
    fail(attachment, "a link has this name; expected another one");
  }
  Link link;
  link.name = attachment.name;
  link.parent = parent;
  link.joint.X_PJ = attachment.X_LA;
  link.role = LinkRole::evaluated;
  link.mesh_L = attachment.mesh_A;
  result.evaluated_links.push_back(result.links.size());
  link.id = static_cast<LinkId>(result.evaluated_links.size());
  for (const std::string& touched : attachment.may_touch) {
    result.allowed_contacts.push_back({link.name, touched});
  }
  result.links.push_back(std::move(link));
  return result;
}

}  // namespace berth
