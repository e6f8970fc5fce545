#include "lab/closed_loop/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/cell_sensors.hpp"
#include "sim/contact_check.hpp"
#include "sim/known_check.hpp"

namespace berth::lab {
namespace {

constexpr double kStep_s = 0.001;

struct Image {
  std::size_t which;
  double stamp_s;
  double arrives_s;
  DepthImage depth_m;
};

struct JointSample {
  double stamp_s;
  std::vector<double> position;
};

struct Command {
  double obeyed_s;
  double scale;
  std::optional<std::vector<double>> velocity_rad_s;
};

/// What the supervisor takes for granted.
Assumption assumption_of(const Supervisor& supervisor, double request_hz) {
  return supervisor.assumption().value_or(Assumption{cell_separation(request_hz)});
}

/// Arm and person come nearer by less than this.
double fastest_m_s(sim::VisitKind kind) { return kind == sim::VisitKind::bvh ? 12 : 5; }

std::span<const sim::Bvh> motions_of(const SimulationSettings& settings) {
  if (!settings.motions) return {};
  return *settings.motions;
}

/// Of the cell, before anything was added to it.
const sim::KnownCheck& empty_known_check() {
  static const sim::KnownCheck check(cell_model());
  return check;
}

double range_of(const std::vector<Pose>& X_BP) {
  double range_m = std::numeric_limits<double>::infinity();
  for (const Pose& X : X_BP) range_m = std::min(range_m, X.translation().head<2>().norm());
  return range_m;
}

std::vector<std::string> joint_names(const RobotModel& model) {
  std::vector<std::string> names;
  for (const MovableJoint& joint : model.joints) names.push_back(joint.name);
  return names;
}

/// All that happens in one encounter.
class Loop {
 public:
  Loop(std::uint32_t seed, Supervisor& supervisor, const SimulationSettings& settings)
      : settings_(settings),
        supervisor_(supervisor),
        model_(cell_model()),
        names_(joint_names(model_)),
        visit_(settings.kind, seed, motions_of(settings)),
        visitors_(visit_.meshes()),
        arm_(model_, visit_.first_phase()),
        clearance_(model_, visitors_),
        check_(clearance_, fastest_m_s(settings.kind)),
        census_(model_, clearance_, assumption_of(supervisor, settings.request_hz),
                settings.image_latency_s + 1 / settings.image_hz),
        known_(empty_known_check()),
        sensors_(model_, visitors_, seed),
        joints_(model_, 500),
        cameras_(supervisor.cameras()),
        next_image_s_(cameras_.size()) {
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      next_image_s_[c] = (1.0 + static_cast<double>(c) / 3) / settings.image_hz;
    }
    first_phase_s_ = arm_.phase_s();
    result_.seed = seed;
  }

  EncounterResult run(std::vector<LoopSample>* samples) {
    begin_visit();
    const double end_s = std::min(settings_.most_s, duration_s_);
    const int steps = static_cast<int>(end_s / kStep_s);
    for (int i = 0; i < steps; ++i) {
      time_s_ = i * kStep_s;
      step(samples);
    }
    check_.finish();
    result_.least_moving_m = check_.least_moving_m();
    result_.least_known_m = known_.least_m();
    result_.contact_m_s = std::max(check_.contact_m_s(), known_.contact_m_s());
    result_.has_touched = check_.has_touched() || known_.contact_m_s() > 0;
    result_.duration_s = steps * kStep_s;
    result_.lost = census_.lost();
    const Progress progress = supervisor_.progress();
    result_.reached = progress.reached;
    result_.phase_s =
        commanded_.velocity_rad_s ? progress.phase_s : arm_.phase_s() - first_phase_s_;
    result_.stopped_share = stopped_steps_ / static_cast<double>(steps);
    return result_;
  }

 private:
  bool is_faulty(Fault fault) const {
    return settings_.fault == fault && time_s_ >= settings_.fault_s;
  }

  /// With nobody there half of the rest of the time before the visit, and half after it. Who was
  /// not there always walks up from where nobody sees him.
  void begin_visit() {
    const double presence = settings_.presence;
    const double lead_s = presence < 1 ? visit_.lead_s() : 0;
    const double present_s = visit_.duration_s() + 2 * lead_s;
    duration_s_ = presence > 0 ? present_s / presence : present_s;
    first_s_ = (duration_s_ - present_s) / 2;
    begins_s_ = first_s_ + lead_s;
    last_s_ = first_s_ + present_s;
  }

  bool is_anybody_there(double time_s) const {
    return settings_.presence > 0 && time_s >= first_s_ && time_s <= last_s_;
  }

  std::vector<Pose> visitors(double after_s = 0) const {
    const double time_s = time_s_ + after_s;
    if (!is_anybody_there(time_s)) return sim::nowhere(visitors_.size());
    return visit_.pose_at(time_s - begins_s_);
  }

  void step(std::vector<LoopSample>* samples) {
    send_joints();
    send_images();
    if (time_s_ >= next_request_s_) ask(samples);
    while (!commands_.empty() && commands_.front().obeyed_s <= time_s_) {
      commanded_ = commands_.front();
      commands_.pop_front();
    }
    if (commanded_.velocity_rad_s) {
      arm_.lead(*commanded_.velocity_rad_s, kStep_s);
    } else {
      arm_.step(commanded_.scale, kStep_s);
    }
    look();
  }

  void send_joints() {
    if (is_faulty(Fault::no_joints)) return;
    sent_.push_back({time_s_, arm_.position_rad()});
    if (is_faulty(Fault::not_a_number)) {
      sent_.back().position[2] = std::numeric_limits<double>::quiet_NaN();
    }
    if (is_faulty(Fault::frozen_joints)) sent_.back().position = frozen_;
    frozen_ = sent_.back().position;
    while (!sent_.empty() && sent_.front().stamp_s + settings_.joint_latency_s <= time_s_) {
      joints_.push(sent_.front().stamp_s, names_, sent_.front().position);
      sent_.pop_front();
    }
  }

  void send_images() {
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      if (time_s_ < next_image_s_[c]) continue;
      next_image_s_[c] += 1 / settings_.image_hz;
      if (c == 0 && is_faulty(Fault::no_images)) continue;
      Image image{c, time_s_, time_s_ + settings_.image_latency_s, {}};
      if (is_faulty(Fault::late_images)) image.arrives_s += 0.5;
      const bool is_turned = c == 0 && is_faulty(Fault::moved_camera);
      image.depth_m = sensors_.take_image(cameras_[c], arm_.pose(), visitors(), is_turned);
      if (c == 0 && is_faulty(Fault::covered_camera)) {
        std::ranges::fill(image.depth_m.pixels(), std::numeric_limits<float>::quiet_NaN());
      }
      images_.push_back(std::move(image));
    }
    while (!images_.empty() && images_.front().arrives_s <= time_s_) {
      const Image& image = images_.front();
      supervisor_.see(image.which, image.depth_m, image.stamp_s, joints_);
      images_.pop_front();
    }
  }

  void ask(std::vector<LoopSample>* samples) {
    next_request_s_ += 1 / settings_.request_hz;
    const std::vector<Pose> X_BP = visitors();
    tell_path();
    const double scale =
        supervisor_.scale({time_s_, joints_, arm_.plan(), ahead_, arm_.full_m_s(), range_of(X_BP)});
    const double late = is_faulty(Fault::late_controller) ? kLateController : 1;
    commands_.push_back({time_s_ + late * kController_s, scale, supervisor_.velocity_rad_s()});
    const bool is_after_fault = settings_.fault != Fault::none && time_s_ >= settings_.fault_s;
    if (is_after_fault && scale == 0 && std::isnan(result_.commanded_stop_s)) {
      result_.commanded_stop_s = time_s_ - settings_.fault_s;
    }
    // An arm that leaves its path has no time that it would take at full speed.
    if (!commands_.back().velocity_rad_s) {
      census_.add(time_s_, 1 / settings_.request_hz, scale, supervisor_.cause(), arm_.phase_s(),
                  [this](double after_s) { return visitors(after_s); });
    }
    if (!samples) return;
    samples->push_back({time_s_, clearance_.at(arm_.pose(), X_BP), arm_.fastest_m_s(), scale});
  }

  /// What the arm's controller knows of its way.
  void tell_path() {
    constexpr double kAhead_s = 1.2, kBetween_s = 0.02;
    ahead_.resize(static_cast<std::size_t>(kAhead_s / kBetween_s) + 1);
    for (std::size_t i = 0; i < ahead_.size(); ++i) {
      ahead_[i].stamp_s = static_cast<double>(i) * kBetween_s;
      ahead_[i].position = path_at(arm_.phase_s() + ahead_[i].stamp_s).position_rad;
    }
  }

  void look() {
    const double fastest_m_s = arm_.fastest_m_s();
    if (fastest_m_s < sim::kMoving_m_s) {
      ++stopped_steps_;
      const bool is_after_fault = !std::isnan(result_.commanded_stop_s);
      if (is_after_fault && std::isnan(result_.stopped_s)) {
        result_.stopped_s = time_s_ - settings_.fault_s;
      }
    }
    if (fastest_m_s >= sim::kMoving_m_s) known_.add(arm_.pose(), fastest_m_s);
    // Somebody who comes out of nowhere comes faster than the check's bounds allow for.
    if (is_anybody_there(time_s_) && check_.is_due(time_s_))
      check_.add({time_s_, arm_.pose(), visitors(), fastest_m_s});
  }

  SimulationSettings settings_;
  Supervisor& supervisor_;
  const RobotModel& model_;
  std::vector<std::string> names_;
  sim::Visit visit_;
  std::vector<TriangleMesh> visitors_;
  MovingArm arm_;
  sim::TrueClearance clearance_;
  sim::ContactCheck check_;
  Census census_;
  sim::KnownCheck known_;
  CellSensors sensors_;
  JointBuffer joints_;
  std::vector<int> cameras_;
  std::vector<double> next_image_s_;
  std::deque<JointSample> sent_;
  std::vector<double> frozen_;
  std::deque<Image> images_;
  std::deque<Command> commands_;
  Command commanded_{};
  std::vector<JointState> ahead_;
  double time_s_ = 0;
  double next_request_s_ = 0;
  double first_phase_s_ = 0;
  double duration_s_ = 0;
  /// When somebody comes into sight, begins what he does, and is out of sight again.
  double first_s_ = 0;
  double begins_s_ = 0;
  double last_s_ = 0;
  int stopped_steps_ = 0;
  EncounterResult result_;
};

}  // namespace

EncounterResult simulate(std::uint32_t seed, Supervisor& supervisor,
                         const SimulationSettings& settings, std::vector<LoopSample>* samples) {
  return Loop(seed, supervisor, settings).run(samples);
}

}  // namespace berth::lab
