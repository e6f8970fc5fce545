#include "thesis/opengl/gl_evaluate.hpp"

#include <fmt/format.h>

#include <cassert>
#include <optional>
#include <stdexcept>

#include "thesis/opengl/gl_exact.hpp"
#include "thesis/opengl/gl_hybrid.hpp"
#include "thesis/opengl/gl_lattice.hpp"

namespace berth {

struct GlEvaluator::State {
  std::optional<GlUploadedImages> uploaded;
  std::optional<GlExact> exact;
  std::optional<GlLattice> lattice;
  std::optional<GlHybrid> hybrid;
  /// For hybrid, whose lattices are made on the CPU.
  RobotImage robot;

  GlHybrid& made_hybrid() { return hybrid ? *hybrid : hybrid.emplace(); }
};

GlEvaluator::GlEvaluator() : state_(std::make_unique<State>()) {}

GlEvaluator::~GlEvaluator() = default;

void GlEvaluator::evaluate(Method method, const Camera& camera, const GlRobotImage& robot,
                           const GlTexture& obstacle_depth_m, int link_count,
                           const ImageDistanceSettings& settings, LinkDistances& out) {
  if (method == Method::gl_exact) {
    if (!state_->exact) state_->exact.emplace();
    return state_->exact->evaluate(camera, robot, obstacle_depth_m, link_count, settings, out);
  }
  if (method == Method::gl_lattice) {
    if (!state_->lattice) state_->lattice.emplace();
    return state_->lattice->evaluate(camera, robot, obstacle_depth_m, link_count, settings, out);
  }
  if (method == Method::gl_hybrid) {
    read_back(robot, state_->robot);
    return state_->made_hybrid().evaluate(camera, state_->robot, obstacle_depth_m, link_count,
                                          settings, out);
  }
  throw std::invalid_argument(
      fmt::format("method {} does not run on OpenGL; expected one that does", name_of(method)));
}

void GlEvaluator::evaluate(Method method, const ImageRequest& request, LinkDistances& out) {
  const DepthView obstacle_depth_m = request.obstacles.depth_m();
  std::optional<GlUploadedImages>& uploaded = state_->uploaded;
  if (!uploaded || !uploaded->has_size(obstacle_depth_m.width, obstacle_depth_m.height))
    uploaded.emplace(obstacle_depth_m.width, obstacle_depth_m.height);
  uploaded->upload.send(obstacle_depth_m, uploaded->obstacle_depth_m);
  if (method == Method::gl_hybrid) {
    state_->made_hybrid().evaluate(request.camera, request.robot, uploaded->obstacle_depth_m,
                                   request.link_count, request.settings, out);
    return;
  }
  uploaded->upload.send(request.robot, uploaded->robot);
  evaluate(method, request.camera, uploaded->robot, uploaded->obstacle_depth_m, request.link_count,
           request.settings, out);
}

}  // namespace berth
