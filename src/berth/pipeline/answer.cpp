#include "berth/pipeline/answer.hpp"

namespace berth {
namespace {

void withhold(const Rig& rig, Answer& out) {
  out.distances.pairs = 0;
  out.distances.links.resize(rig.model().link_count());
  LinkId id = kNoLink;
  for (LinkDistance& link : out.distances.links) {
    link = {};
    link.id = ++id;
    link.status = LinkStatus::untimely;
  }
  if (!rig.settings().visibility) return;
  out.visibility.clear();
  for (const LinkDistance& link : out.distances.links) out.visibility.emplace_back().id = link.id;
}

}  // namespace

bool begin_answer(const Rig& rig, double frame_stamp_s, double joints_stamp_s,
                  const Timeliness& time, Answer& out) {
  out.frame_stamp_s = frame_stamp_s;
  out.joints_stamp_s = joints_stamp_s;
  out.time = time;
  if (time.status == TimeStatus::ok) return true;
  withhold(rig, out);
  return false;
}

void tell_visibility(const Rig& rig, const Frame& frame, const AskedRobot& robot,
                     TellWorkspace& workspace, Answer& out) {
  if (!rig.settings().visibility) return;
  const SeenFrame seen{rig.camera(), frame.robot, frame.obstacles,
                       tolerance_of(rig.settings().self_filter)};
  const double range_m = rig.settings().distance.range_m;
  find_visibility(rig.model(), rig.sample_points(), seen, robot, out.distances, range_m,
                  workspace.visibility, out.visibility);
  find_doubtful_distances(rig.camera(), robot.image, frame.doubtful, out.distances, range_m,
                          workspace.doubtful, out.visibility);
}

}  // namespace berth
