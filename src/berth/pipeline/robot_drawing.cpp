#include "berth/pipeline/robot_drawing.hpp"

#include <algorithm>

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

}  // namespace berth
