#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "berth/robot/joint_buffer.hpp"
#include "berth/robot/joints_at_time.hpp"

namespace berth {

/// Tells a clock that was set back from late messages, by the stamps of one source as they come.
/// Those of a publisher that lags come among newer ones; those of another time follow one another
/// for longer.
class BehindNewest {
 public:
  /// How many make a clock that was set back, and how much time they span at least.
  static constexpr int kInARow = 3;
  static constexpr double kSpan_s = 0.1;

  /// Whether this stamp, which lies so far behind the newest one, ends such a row: each above the
  /// one before it.
  bool is_set_back(double behind_s) {
    if (behind_s < 0) count_ = 0;
    if (!(behind_s > 0)) return false;
    if (count_ == 0 || behind_s > last_s_) {
      count_ = 1;
      first_s_ = behind_s;
    } else {
      count_ += behind_s < last_s_;
    }
    last_s_ = behind_s;
    return count_ >= kInARow && first_s_ - last_s_ >= kSpan_s;
  }

 private:
  int count_ = 0;
  double first_s_ = 0;
  double last_s_ = 0;
};

/// How joint messages become whole samples.
struct JointIntakeSettings {
  /// Added to a joint's positions, rad or m, by its name.
  std::map<std::string, double> offsets = {};
  /// The positions of joints that nobody reports, rad or m, by name.
  std::map<std::string, double> fixed = {};
  /// A joint keeps its last position for so long while newer ones of others come: for a gripper
  /// that reports its joints more seldom than the arm. What it moved meanwhile is not known.
  double max_hold_s = 0;
  /// Whole samples that are kept, at least 2.
  std::size_t capacity = 500;
};

/// The joint messages of a running robot, as they come: from several publishers, each with some of
/// the joints, at rates of their own. Each joint is interpolated between its own messages, and a
/// whole sample goes into buffer() as soon as all joints are known at its time. One thread may push
/// while others read the buffer.
class JointIntake {
 public:
  /// Throws std::invalid_argument that names the setting: a name that is no joint of the robot
  /// that moves by itself, a value that is not finite, a negative time, a capacity below 2.
  JointIntake(const RobotModel& model, JointIntakeSettings settings);

  /// Takes one message; positions in rad or m, one for each name, in any order. Names that are no
  /// joints of the robot are passed over. Statuses:
  /// missing_joint where no joint of the robot is left, stamp_jumped for a stamp that is not
  /// finite, stamp_went_back for one that is not above the last of any of these joints. A row of
  /// those (BehindNewest) is no late message but a clock that was set back (a bag that begins
  /// again): all that was known is forgotten, and the row's last message is taken.
  /// Throws std::invalid_argument that names the joint, and takes nothing, for a position that is
  /// not finite or that no robot has: more than a kBeyondLimit outside of the URDF's limits, or
  /// more than kMostPosition; and where names and positions are not equally many.
  TimeStatus push(double stamp_s, std::span<const std::string> names,
                  std::span<const double> positions);

  /// The whole samples.
  const JointBuffer& buffer() const { return buffer_; }
  /// The joint whose messages hold the whole samples back: it never came, or came last. Empty
  /// where all are equally new.
  std::string_view waiting_for() const;
  /// How often the clock was set back.
  int restarts() const;

  /// A whole turn in rad, and 1 m: the limits of some URDFs are narrower than those of the robot,
  /// by a turn at most. What lies beyond is in degrees or mm, or nonsense.
  static constexpr double kBeyondLimit_rad = 6.3;
  static constexpr double kBeyondLimit_m = 1;
  /// rad or m, where there are no limits.
  static constexpr double kMostPosition = 1e6;

 private:
  /// One joint's messages that are not in whole samples yet, and the one before them.
  struct Series {
    std::vector<double> stamp_s;
    std::vector<double> position;
    BehindNewest behind;
    bool is_empty() const { return stamp_s.empty(); }
  };

  /// A joint's position in the message at hand.
  struct Told {
    std::size_t joint;
    double position;
  };

  void find_told(std::span<const std::string> names, std::span<const double> positions);
  void require_possible(std::size_t joint, double position) const;
  bool append(std::size_t joint, double stamp_s, double position);
  bool is_set_back(double stamp_s);
  void restart();
  std::size_t slowest() const;
  void emit_whole_samples();
  bool emit(double stamp_s);
  void drop_before(double stamp_s);

  mutable std::mutex mutex_;
  JointIntakeSettings settings_;
  std::vector<std::string> names_;
  std::vector<bool> is_continuous_;
  /// Positions that a robot may have.
  std::vector<double> least_;
  std::vector<double> most_;
  std::vector<double> offset_;
  /// NaN for joints that are told.
  std::vector<double> fixed_;
  /// All joints are fixed, or there are none: any message's stamp makes a sample.
  bool nobody_tells_ = false;
  std::vector<Series> series_;
  /// Of messages where nobody tells a joint.
  BehindNewest behind_;
  std::vector<Told> told_;
  std::vector<double> stamps_s_;
  std::vector<double> whole_;
  double emitted_s_ = 0;
  int restarts_ = 0;
  JointBuffer buffer_;
};

}  // namespace berth
