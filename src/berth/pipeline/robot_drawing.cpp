#include "berth/pipeline/robot_drawing.hpp"

#include <algorithm>

namespace berth {
namespace {

double reach_of(const TriangleMesh& mesh_L) {
  double reach_m = mesh_L.triangles.empty() ? -1 : 0;
  for (const auto& triangle : mesh_L.triangles) {
    for (const auto vertex : triangle) {
      reach_m = std::max(reach_m, static_cast<double>(mesh_L.vertices_m[vertex].norm()));
    }
  }
  return reach_m;
}

}  // namespace

RobotDrawing::RobotDrawing(const Robot& robot, const Camera& camera)
    : renderer_(robot.meshes(), camera) {
  for (const auto& link : robot.model().links) reach_m_.push_back(reach_of(link.mesh_L));
}

void RobotDrawing::find_places(const RobotPose& pose, const Pose& X_BC) {
  const Pose X_CB = X_BC.inverse();
  X_CL_.clear();
  for (const Pose& X_BL : pose.X_BL) X_CL_.push_back(X_CB * X_BL);
}

bool RobotDrawing::stands_still() const {
  if (rendered_X_CL_.size() != X_CL_.size()) return false;
  for (std::size_t i = 0; i < X_CL_.size(); ++i) {
    if (reach_m_[i] < 0) continue;
    const double shift_m = (X_CL_[i].translation() - rendered_X_CL_[i].translation()).norm();
    const double turn = (X_CL_[i].linear() - rendered_X_CL_[i].linear()).norm();
    if (!(shift_m + turn * reach_m_[i] <= kStill_m)) return false;
  }
  return true;
}

void RobotDrawing::draw(const RobotPose& pose, const Pose& X_BC, RobotImage& image) {
  find_places(pose, X_BC);
  if (!stands_still()) {
    rendered_X_CL_.clear();
    renderer_.render(pose, X_BC, image);
    rendered_X_CL_.swap(X_CL_);
    has_rendered_ = false;
    return;
  }
  if (!has_rendered_) {
    renderer_.render(pose, X_BC, rendered_);
    rendered_X_CL_.swap(X_CL_);
    has_rendered_ = true;
  }
  image = rendered_;
}

}  // namespace berth
