// How far away everything has to be (ISO/TS 15066, 5.5.4).
#pragma once

#include <span>
#include <string>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/separation/settings.hpp"

namespace berth {

/// How long, and over which way, a robot brakes from a speed.
struct Stopping {
  double time_s = 0;
  double distance_m = 0;
};

/// Until it goes at end_m_s. By the settings' table until it stands, since a table does not tell
/// how it gets there; both are infinite above the last row.
Stopping stopping_from(const SeparationSettings& settings, double speed_m_s, double end_m_s = 0);

/// The longest time that the robot may brake for if that ends within distance_m: from the greatest
/// speed up to most_m_s that it can brake from over that way, as by stopping_from().
double time_to_stop_within_s(const SeparationSettings& settings, double distance_m, double most_m_s,
                             double end_m_s = 0);

/// C: that of the settings; else from the detection capability that was shown, but no less than
/// what the cameras are set to tell: 8 (d - 14 mm) up to d = 40 mm; else kUnprovenIntrusion_m.
double intrusion_m(const SeparationSettings& settings, double least_detection_m = 0);

/// The terms of the protective distance that no speed changes.
struct ProtectiveTerms {
  /// T_r: from the exposure to the moment at which the robot begins to brake.
  double reaction_time_s = 0;
  /// Z_d.
  double camera_uncertainty_m = 0;
  /// Anything smaller may hide from the cameras by their settings
  /// (SpaceSettings::detection_capability_m).
  double least_detection_m = 0;
  /// At this speed the robot need not brake any more: a contact is tolerable.
  double contact_m_s = 0;
};

/// How fast a link moves, and the robot that it belongs to.
struct LinkSpeed {
  /// v_r: of the link's fastest point.
  double link_m_s = 0;
  /// Of the robot's fastest point: all links brake as long as it does. At least link_m_s.
  double robot_m_s = 0;
};

/// S = v_h (T_r + T_s) + v_r T_r + S_s + C + Z_d + Z_r, with the robot's T_s, and the link's part
/// of its S_s, both until it stands or a contact is tolerable. It grows with the speed.
double protective_distance_m(const SeparationSettings& settings, const ProtectiveTerms& terms,
                             const LinkSpeed& speed);

/// The greatest share, 0 to `most`, of the speed at which everything may be as near as
/// `distance_m`. 0 where not even a robot that stands still would have enough room.
double greatest_speed_scale(const SeparationSettings& settings, const ProtectiveTerms& terms,
                            const LinkSpeed& speed, double distance_m, double most = 1);

/// The greatest detection_capability_m() of the cameras in use; 0 where none is.
double least_detection_m(std::span<const CameraResult> cameras);

/// That more may hide from this camera than the monitor was told the cameras detect, and what C is
/// for it; empty where it may not, or C does not follow from what is detected.
std::string detection_trouble(const SeparationSettings& settings, const MountedCamera& camera);

}  // namespace berth
