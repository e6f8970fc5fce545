#pragma once

#include <span>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/view.hpp"
#include "berth/types/camera_status.hpp"
#include "berth/types/link_distance.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/types/time_status.hpp"
#include "berth/visibility/visibility.hpp"

namespace berth {

/// An answer, and what it was made from.
struct Answer {
  /// When the depth image was exposed, and the time of the joint angles that were asked for.
  double frame_stamp_s = 0;
  double joints_stamp_s = 0;
  /// Unless its status is ok, every link is LinkStatus::untimely.
  Timeliness time;
  LinkDistances distances;
  /// Method `mesh`: camera k's part in it, in the order of the question's frames.
  std::vector<CameraState> cameras;
  /// What the cameras see of each link and around it: visibility[i] belongs to the link with the id
  /// i + 1. Empty unless EvaluationSettings::visibility is set.
  std::vector<LinkVisibility> visibility;
};

/// The first step of each question: writes the stamps and what became of the cameras (none, but
/// with method `mesh`), and sets visibility to nothing known. Whether the answer is in time; if not
/// it is withheld, with every link untimely.
bool begin_answer(const Robot& robot, double frame_stamp_s, double joints_stamp_s,
                  const Timeliness& time, std::span<const CameraState> cameras, Answer& out);

/// The memory of tell_visibility(), one for each thread.
struct TellWorkspace {
  VisibilityWorkspace visibility;
  DoubtfulWorkspace doubtful;
};

/// The last step of each question: fills the visibility where the settings ask for it.
/// `robot` is the one that `out.distances` are about.
void tell_visibility(const Robot& asked, const Frame& frame, const AskedRobot& robot,
                     TellWorkspace& workspace, Answer& out);

}  // namespace berth
