#pragma once

#include "berth/image_distance/method.hpp"
#include "berth/image_distance/settings.hpp"
#include "berth/pipeline/robot.hpp"

namespace berth {

/// How the frames of a scene are asked: the robot's settings, and whether images are compared
/// instead.
struct SceneEvaluation : EvaluationSettings {
  Method method = Method::mesh;
  ImageSettings images;

  bool operator==(const SceneEvaluation&) const = default;
};

/// The list of these settings but `time`, which has a list of its own.
template <SettingsOf<SceneEvaluation> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"method", {}, "how the distances are found"}, s.method);
  visit_settings(s.distance, visit);
  visit_settings(s.images, visit);
  visit_visibility(s, visit);
}

}  // namespace berth
