#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "berth/control/distance_rows.hpp"
#include "berth/types/setting.hpp"

namespace berth {

class HalfSpaces;

/// How near the robot may go to what is around it, and how soon it obeys.
struct VelocityFilterSettings {
  /// Nothing comes nearer than this to a link. What is nearer already may only go away.
  double least_distance_m = 0.05;
  /// A distance falls by at most this share of what is above the least one, in each second.
  double approach_rate_1_s = 2;
  /// How long a velocity is obeyed, at most.
  double period_s = 0.01;
  /// From the stamp of the result's joints until the velocity is obeyed.
  double latency_s = 0.01;
  /// Of each joint, rad/s^2 or m/s^2; no URDF has it. Infinite: it does not count.
  double max_acceleration = std::numeric_limits<double>::infinity();
  /// Whether the robot stands while a camera is left out, or a moved link is not seen or not
  /// observed: nothing is promised of what is near it then.
  bool stop_unseen = true;
};

/// The list of these settings.
template <SettingsOf<VelocityFilterSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"least_distance_m", kNotNegative, "nothing comes nearer than this to a link"},
        s.least_distance_m);
  visit({"approach_rate_1_s", kAboveZero,
         "a distance falls by at most this share of what is above the least one, in each second"},
        s.approach_rate_1_s);
  visit({"period_s", kAboveZero, "how long a velocity is obeyed, at most"}, s.period_s);
  visit({"latency_s", kNotNegative, "from the joints' stamp until the velocity is obeyed"},
        s.latency_s);
  visit({"max_acceleration",
         {.is_open = true, .may_be_infinite = true},
         "how fast each joint's velocity may change, in rad/s^2 or m/s^2"},
        s.max_acceleration);
  visit({"stop_unseen",
         {},
         "whether the robot stands while a camera is left out, or a link is not seen or not "
         "observed"},
        s.stop_unseen);
}

/// The joints that a velocity is asked for, in the order of RobotModel::joints; rad, rad/s, or m,
/// m/s where a joint slides.
struct JointMotion {
  /// Those that the result is about.
  std::span<const double> position;
  /// How fast they move until the new velocity is obeyed.
  std::span<const double> velocity;
  /// What the program wants.
  std::span<const double> wanted;
  /// How much a difference from that counts, above 0: what one row asks, a joint with twice the
  /// weight gives a quarter of. Empty: all alike.
  std::span<const double> weight = {};
};

/// Why a filtered velocity is what it is.
enum class FilterStatus : std::uint8_t {
  ok,           ///< it is as near to the wanted one as rows and limits allow
  stale,        ///< 0: the result is no answer
  bad_joints,   ///< 0: a number of the joints is missing or not finite, or a weight not above 0
  unseen,       ///< 0: a camera is left out, or the links in held_by are not seen or not observed
  contact,      ///< 0: something may touch already, and no direction is known that leads away
  no_solution,  ///< 0: the joints cannot brake as fast as rows ask
};
/// By enumerator.
inline constexpr std::array<std::string_view, 6> kFilterStatusNames = {
    "ok", "stale", "bad_joints", "unseen", "contact", "no_solution"};
constexpr std::string_view name_of(FilterStatus status) {
  return kFilterStatusNames[static_cast<std::size_t>(status)];
}

/// A row of DistanceRows, by its link, kind and candidate.
struct LinkRow {
  LinkId link = kNoLink;
  RowKind kind = RowKind::nearest;
  int candidate = 0;

  bool operator==(const LinkRow&) const = default;
};

/// What VelocityFilter gives.
struct FilteredVelocity {
  FilterStatus status = FilterStatus::stale;
  /// rad/s or m/s, one for each joint.
  std::vector<double> velocity;
  /// The share, 0 to 1, that the check without a model left of what was solved.
  double scale = 0;
  /// The rows without which the velocity would be another one; no limit of a joint is among them.
  std::vector<LinkRow> held_by;
};

/// Turns the velocity that a program wants into the nearest one that keeps the links apart from all
/// that cameras see and the model knows. **Not a certified safety function.** One for each thread;
/// once made, nothing allocates.
///
/// It solves for the velocity v nearest to the wanted one, weighted, with
///   gradient . v >= -approach_rate_1_s (lower bound - least_distance_m)
/// for each row, and within the joints' limits. Then, whatever was solved, it shortens v until
///   lower bound - sum over joints j of |v_j| reach_m(j) period_s >= least_distance_m
/// holds by DistanceRows::reach_m, after what the joints still move in latency_s. So what stands
/// still is never touched by a robot that obeys; of what moves by itself nothing is known. The
/// shortened velocity, and 0, may ask for more than max_acceleration.
class VelocityFilter {
 public:
  /// Throws std::invalid_argument that names the setting, its value and what was expected. Of
  /// RobotModel::joints, `others` are those that another controller moves: they are taken to stand.
  VelocityFilter(std::shared_ptr<const Robot> robot, const VelocityFilterSettings& settings,
                 const std::vector<std::size_t>& others = {});
  ~VelocityFilter();

  /// Valid until the next update. The result is one of this robot; else std::invalid_argument.
  const FilteredVelocity& update(const Result& result, const JointMotion& joints);

  const VelocityFilterSettings& settings() const { return settings_; }
  /// Of the last update.
  const DistanceRows& rows() const { return rows_; }

 private:
  using Vector = Eigen::Map<const Eigen::VectorXd>;
  struct Bound;

  bool are_good(const JointMotion& joints) const;
  Eigen::Index add_half_space(double bound);
  bool is_all_seen(const Result& result);
  void find_limits(const JointMotion& joints);
  /// Whether nothing may touch already.
  bool find_bounds(const Result& result);
  void add_half_spaces();
  void solve(const JointMotion& joints);
  void shorten();
  /// A row's distance falls by no more with these speeds of the joints.
  double speed_m_s(const LinkRow& row, const Eigen::VectorXd& joints) const;

  std::shared_ptr<const Robot> robot_;
  VelocityFilterSettings settings_;
  DistanceRows rows_;
  std::unique_ptr<HalfSpaces> spaces_;
  /// Of each joint.
  std::vector<bool> is_of_others_;
  std::vector<Bound> bounds_;
  /// Of each joint's velocity.
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  /// |velocity|, |wanted| within the limits, and |v|.
  Eigen::VectorXd before_;
  Eigen::VectorXd planned_;
  Eigen::VectorXd speed_;
  Eigen::VectorXd normal_;
  /// JointMotion::weight, and the wanted velocity by it.
  Eigen::VectorXd weight_;
  Eigen::VectorXd weighted_;
  FilteredVelocity out_;
};

}  // namespace berth
