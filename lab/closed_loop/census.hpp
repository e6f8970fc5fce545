// What each slow-down of an encounter was for.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lab/closed_loop/moving_arm.hpp"
#include "lab/closed_loop/supervisor.hpp"
#include "sim/true_clearance.hpp"

namespace berth::lab {

/// Time that an arm lost: 1 - scale of each second. The true people divide it, not the images.
struct LostTime {
  /// Going on along its way at full speed, the arm would within a second have been nearer to
  /// somebody than the way that it stops over from there.
  double needed_s = 0;
  /// Not needed, but taken by the policy's own rule, if it is given the true distances: somebody
  /// could have come at v_h and reached C farther, and did not.
  double allowed_s = 0;
  /// The rest: nobody was as near as the rule asks for. Unknown space, readings of nothing,
  /// readings nearer than the thing, older images, and what proofs leave.
  double false_s = 0;
  double sum_s() const { return needed_s + allowed_s + false_s; }
};

/// By the cause that the policy named.
using LostTimes = std::map<std::string, LostTime, std::less<>>;

/// The one that lost most; "none" without any.
std::string main_cause(const LostTimes& lost);
/// Of all lost time; 0 without any.
double needed_share(const LostTimes& lost);

/// Distances are those of convex hulls (TrueClearance::at_least()), at most some centimetres less
/// than those of the meshes.
class Census {
 public:
  /// Where people are, so many seconds from now.
  using People = std::function<std::vector<Pose>(double)>;

  /// `model` and `clearance` outlive it. `age_s`: how old images may be.
  Census(const RobotModel& model, const sim::TrueClearance& clearance, Assumption assumed,
         double age_s);

  /// A request at now_s was answered with this scale for the next `for_s` seconds; the arm is at
  /// this place of its path. What is lost until the first images are there does not count. Time in
  /// which the arm gains speed again has the cause and the need of what slowed it down.
  void add(double now_s, double for_s, double scale, std::string_view cause, double phase_s,
           const People& people_after);

  const LostTimes& lost() const { return lost_; }

 private:
  void judge(double phase_s, const People& people_after);
  bool is_needed(double phase_s, const People& people_after);
  /// By the policy's rule, of the true distances.
  double rightful_scale(double phase_s, const std::vector<Pose>& X_BP);
  bool has_room(double scale, double phase_s, const std::vector<Pose>& X_BP);
  double clearance_m(double phase_s, const std::vector<Pose>& X_BP);

  const sim::TrueClearance& clearance_;
  Assumption assumed_;
  double age_s_;
  MovingArm arm_;
  double judged_s_;
  std::string cause_;
  bool is_needed_ = false;
  /// Of what is lost at the last judgement.
  double false_share_ = 0;
  double rightful_scale_ = 1;
  LostTimes lost_;
};

}  // namespace berth::lab
