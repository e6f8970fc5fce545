// One encounter of arm and person, millisecond by millisecond.
#pragma once

#include "lab/closed_loop/census.hpp"
#include "lab/closed_loop/supervisor.hpp"
#include "sim/visit.hpp"

namespace berth::lab {

/// What may go wrong, from fault_s on.
enum class Fault {
  none,
  late_images,      ///< each image takes half a second more
  no_images,        ///< of one camera
  covered_camera,   ///< no pixel of it has a reading
  no_joints,        ///< joint states stop
  not_a_number,     ///< one joint is NaN
  frozen_joints,    ///< joint states come, and say that the arm stands still
  moved_camera,     ///< one of them is turned by 6 degrees
  late_controller,  ///< the arm obeys after twice the time, as late as reaction_time_s allows
};

struct SimulationSettings {
  double image_hz = 30;
  double image_latency_s = 0.060;
  double joint_latency_s = 0.002;
  double request_hz = 250;
  Fault fault = Fault::none;
  double fault_s = 0;
  /// The kind of visit, and the share of the time in which somebody is there; 0: nobody ever.
  sim::VisitKind kind = sim::VisitKind::reaching;
  double presence = 1;
  /// For VisitKind::bvh.
  std::shared_ptr<const std::vector<sim::Bvh>> motions;
  /// At most so long; less where the encounter is over.
  double most_s = 60;
};

struct EncounterResult {
  std::uint32_t seed = 0;
  double duration_s = 0;
  /// How far the arm came, as a time at full speed.
  double phase_s = 0;
  /// How many stations it reached, if it has any.
  int reached = 0;
  /// Between arm and person while the arm moved; infinite where it never did.
  double least_moving_m = std::numeric_limits<double>::infinity();
  /// The same between the arm and its table, its floor and its own links.
  double least_known_m = std::numeric_limits<double>::infinity();
  /// Of the arm's fastest point while it met any of these; 0 where it did not, or it stood.
  double contact_m_s = 0;
  bool has_touched = false;
  /// The share of the time in which the arm stood still.
  double stopped_share = 0;
  /// Empty for an arm that leaves its path.
  LostTimes lost;
  /// When the first stop was commanded after the fault, and when the arm stood; NaN where never.
  double commanded_stop_s = std::numeric_limits<double>::quiet_NaN();
  double stopped_s = std::numeric_limits<double>::quiet_NaN();
};

/// What was so at one request.
struct LoopSample {
  double time_s;
  double clearance_m;
  double fastest_m_s;
  double scale;
};

/// `samples` get one for each request, unless they are null.
EncounterResult simulate(std::uint32_t seed, Supervisor& supervisor,
                         const SimulationSettings& settings,
                         std::vector<LoopSample>* samples = nullptr);

}  // namespace berth::lab
