#include "berth/pipeline/answer.hpp"

namespace berth {
namespace {

void withhold(const Robot& robot, Answer& out) {
  out.distances.pairs = 0;
  out.distances.links.resize(robot.model().link_count());
  LinkId id = kNoLink;
  for (LinkDistance& link : out.distances.links) {
    link = {};
    link.id = ++id;
    link.status = LinkStatus::untimely;
  }
}

/// Nothing is known of any link; empty where nobody asks for it.
void reset_visibility(const Robot& robot, Answer& out) {
  out.visibility.assign(robot.settings().visibility ? robot.model().link_count() : 0, {});
  LinkId id = kNoLink;
  for (LinkVisibility& link : out.visibility) link.id = ++id;
}

}  // namespace

bool begin_answer(const Robot& robot, double frame_stamp_s, double joints_stamp_s,
                  const Timeliness& time, std::span<const CameraState> cameras, Answer& out) {
  out.frame_stamp_s = frame_stamp_s;
  out.joints_stamp_s = joints_stamp_s;
  out.time = time;
  out.cameras.assign(cameras.begin(), cameras.end());
  reset_visibility(robot, out);
  if (time.status == TimeStatus::ok) return true;
  withhold(robot, out);
  return false;
}

void tell_visibility(const Robot& asked, const Frame& frame, const AskedRobot& robot,
                     TellWorkspace& workspace, Answer& out) {
  if (!asked.settings().visibility) return;
  const View& view = *frame.view;
  const SeenFrame seen{view.camera(), frame.robot, frame.obstacles,
                       tolerance_of(view.settings().self_filter)};
  const double range_m = asked.settings().distance.range_m;
  find_visibility(asked.model(), asked.sample_points(), seen, robot, out.distances, range_m,
                  workspace.visibility, out.visibility);
  find_doubtful_distances(view.camera(), robot.image, frame.doubtful, out.distances, range_m,
                          workspace.doubtful, out.visibility);
}

}  // namespace berth
