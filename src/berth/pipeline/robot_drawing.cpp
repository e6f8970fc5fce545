#include "berth/pipeline/robot_drawing.hpp"

#include <algorithm>

#include "berth/space/serial_number.hpp"

namespace berth {

void RobotDrawing::draw(const RobotPose& pose, const Pose& X_BC, RobotImage& image) {
  const bool stands_still = still_.stand_at(pose, X_BC);
  if (stands_still && has_rendered_) {
    image = rendered_;
    return;
  }
  renderer_.render(pose, X_BC, image);
  still_.drawn_at(pose, X_BC);
  has_rendered_ = stands_still;
  if (stands_still) rendered_ = image;
}

namespace {

double reach_of(const TriangleMesh& mesh_L) {
  double reach_m = 0;
  for (const auto& triangle : mesh_L.triangles) {
    for (const auto vertex : triangle) {
      reach_m = std::max(reach_m, static_cast<double>(mesh_L.vertices_m[vertex].norm()));
    }
  }
  return reach_m;
}

}  // namespace

StillLinks::StillLinks(const RobotModel& model, DrawnLinks drawn) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (link.mesh_L.triangles.empty() || !is_drawn(link, drawn)) continue;
    links_.push_back({i, reach_of(link.mesh_L), Pose::Identity()});
  }
}

bool StillLinks::stand_at(const RobotPose& pose, const Pose& X_BC) const {
  const Pose X_CB = X_BC.inverse();
  return has_drawn_ && std::ranges::all_of(links_, [&](const Drawn& drawn) {
           const Pose X_CL = X_CB * pose.X_BL[drawn.link];
           const double shift_m = (X_CL.translation() - drawn.X_CL.translation()).norm();
           const double turn = (X_CL.linear() - drawn.X_CL.linear()).norm();
           return shift_m + turn * drawn.reach_m <= kStill_m;
         });
}

void StillLinks::drawn_at(const RobotPose& pose, const Pose& X_BC) {
  const Pose X_CB = X_BC.inverse();
  for (Drawn& drawn : links_) drawn.X_CL = X_CB * pose.X_BL[drawn.link];
  has_drawn_ = true;
}

EnvironmentBack::EnvironmentBack(const RobotModel& model, const Camera& camera)
    : still_(model, DrawnLinks::environment) {
  if (still_.is_empty()) return;
  renderer_.emplace(build_link_meshes(model, DrawnLinks::environment), camera);
}

EnvironmentSurfaces EnvironmentBack::at(const RobotPose& pose, const Pose& X_BC) {
  if (renderer_ && !still_.stand_at(pose, X_BC)) render(pose, X_BC);
  return {front_.depth_m, back_.depth_m, serial_number_};
}

void EnvironmentBack::render(const RobotPose& pose, const Pose& X_BC) {
  renderer_->render(pose, X_BC, front_);
  renderer_->render_behind(pose, X_BC, front_, back_);
  still_.drawn_at(pose, X_BC);
  serial_number_ = mesh::next_serial_number();
  auto& back_m = back_.depth_m.pixels();
  for (std::size_t i = 0; i < back_m.size(); ++i) {
    if (back_.link_id.pixels()[i] != kNoLink) continue;
    back_m[i] = front_.depth_m.pixels()[i];
    back_.link_id.pixels()[i] = front_.link_id.pixels()[i];
  }
}

}  // namespace berth
