#include "berth/scene/answer_result.hpp"

namespace berth {

FrameResult result_of(const Robot& robot, const Answer& answer) {
  const EvaluationSettings& settings = robot.settings();
  const RobotModel& model = robot.model();
  FrameResult result;
  result.stamp_s = answer.frame_stamp_s;
  result.method = name_of(settings.method);
  result.asks_images = asks_images(settings.method);
  result.range_m = settings.distance.range_m;
  result.has_bounds = settings.method == Method::mesh ||
                      settings.distance.tolerance_m.value_or(0) > 0 ||
                      settings.distance.deadline_us;
  result.link_names = model.evaluated_link_names();
  for (const std::size_t link : model.evaluated_links) {
    result.link_is_moved.push_back(model.is_moved(link));
  }
  result.distances = &answer.distances;
  if (settings.visibility) result.visibility = &answer.visibility;
  result.time = answer.time;
  return result;
}

}  // namespace berth
