// Supervisors decide how fast the arm may go.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/prepared_space.hpp"
#include "berth/record/monitor_loop.hpp"
#include "lab/closed_loop/path.hpp"

namespace berth::lab {

/// What there is to decide by.
struct Situation {
  double now_s;
  const JointBuffer& joints;
  const PathPoint& plan;
  /// Where the arm goes from here, as PlannedMotion::path.
  std::span<const JointState> path;
  /// Of the arm's fastest point on its way at full speed, now.
  double full_m_s;
  /// From the base's axis to the person's nearest part.
  double person_range_m;
};

/// Of an arm with goals.
struct Progress {
  /// What its ways take at full speed: of those that it went, and of its share of the last one.
  double phase_s = 0;
  int reached = 0;
};

/// What a policy takes for granted of people, cameras and brake.
struct Assumption {
  SeparationSettings settings;
  /// Whether everything has to be far enough from the arm's way until it stands; else S is needed.
  bool is_along_path = false;
};

class Supervisor {
 public:
  virtual ~Supervisor() = default;
  /// By their place in cell_cameras().
  virtual std::vector<int> cameras() const { return {}; }
  /// An image of cameras()[which] has come.
  virtual void see(std::size_t which, const DepthImage& depth_m, double stamp_s,
                   const JointBuffer& joints);
  /// Of the planned velocity, 0 to 1.
  virtual double scale(const Situation& situation) = 0;
  /// What kept the last scale below 1, in a word.
  virtual std::string_view cause() const { return "none"; }
  /// None: the cell's, without a path.
  virtual std::optional<Assumption> assumption() const { return {}; }
  /// Of each joint, after the last request; none: the arm keeps to its path.
  virtual std::optional<std::vector<double>> velocity_rad_s() const { return {}; }
  /// Where the arm leaves its path.
  virtual Progress progress() const { return {}; }
};

/// Nobody.
class NoSupervisor : public Supervisor {
 public:
  double scale(const Situation&) override { return 1; }
};

/// A scanner around the cell: stop whenever anybody is nearer than stop_m; nearer than slow_m the
/// arm's fastest point may go at slow_m_s.
class FixedZone : public Supervisor {
 public:
  explicit FixedZone(double stop_m, double slow_m = 0, double slow_m_s = 0)
      : stop_m_(stop_m), slow_m_(slow_m), slow_m_s_(slow_m_s) {}
  double scale(const Situation& situation) override {
    if (situation.person_range_m < stop_m_) return 0;
    if (situation.person_range_m >= slow_m_) return 1;
    return std::min(1.0, slow_m_s_ / situation.full_m_s);
  }
  std::string_view cause() const override { return "zone"; }

 private:
  double stop_m_;
  double slow_m_;
  double slow_m_s_;
};

/// What a monitor is given to show its scale by.
enum class ShownBy {
  formula,      ///< nothing but the joints' velocities
  straight_on,  ///< what the cameras left of space
  along_path,   ///< and the way that the arm is going to take
};

/// berth. The cameras tell what is as large as settings.detection_m.
class MonitorSupervisor : public Supervisor {
 public:
  /// With a deadline requests are those of a running robot: each has so long, and an image's space
  /// is made ready when it comes, as LiveSpace's thread does, not by the first request about it.
  MonitorSupervisor(std::vector<int> cameras, const SeparationSettings& settings,
                    ShownBy shown = ShownBy::along_path, std::optional<double> deadline_us = {});
  std::vector<int> cameras() const override { return cameras_; }
  void see(std::size_t which, const DepthImage& depth_m, double stamp_s,
           const JointBuffer& joints) override;
  double scale(const Situation& situation) override;
  std::string_view cause() const override { return name_of(last().reason); }
  const Separation& last() const { return *result_->separation; }
  const std::shared_ptr<const Robot>& robot() const { return robot_; }
  const Result& result() const { return *result_; }
  /// How long the monitor took, in each request.
  const std::vector<double>& monitor_us() const { return monitor_us_; }
  /// Requests and monitor.
  const std::vector<double>& request_us() const { return request_us_; }
  /// Null where it has none yet.
  const std::shared_ptr<const Frame>& newest(std::size_t which) const { return frames_[which]; }

 protected:
  const std::vector<std::shared_ptr<const Frame>>& newest() const { return frames_; }
  const Result& ask(const Situation& situation);
  /// The scale of this motion, after ask().
  double monitor(const PlannedMotion& motion, double now_s, bool with_frames);

 private:
  std::shared_ptr<const Robot> robot_;
  std::vector<int> cameras_;
  std::vector<std::unique_ptr<Observer>> observers_;
  /// Of each camera, whose frames keep what its environment is.
  std::vector<FramePool> pools_;
  std::vector<std::shared_ptr<const Frame>> frames_;
  MonitorLoop loop_;
  ShownBy shown_;
  const Result* result_ = nullptr;
  Pool<PreparedSpace> spaces_;
  std::shared_ptr<const PreparedSpace> space_;
  std::vector<double> monitor_us_;
  std::vector<double> request_us_;
};

}  // namespace berth::lab
