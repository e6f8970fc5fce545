// What a stream plays: a robot, and the images of cameras that saw it move.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "lab/stream/stream.hpp"

namespace berth::lab {

struct FilmedCamera {
  std::shared_ptr<const MountedCamera> mounted;
  std::vector<double> stamps_s;
  /// One for each stamp.
  std::vector<DepthImage> depth_m;
};

struct Film {
  std::shared_ptr<const Robot> robot;
  std::shared_ptr<const JointTrajectory> joints;
  std::vector<FilmedCamera> cameras;
};

/// Between two recorded poses the robot goes straight, however far apart they are.
inline constexpr JointTimeLimits kAnyGap{std::numeric_limits<double>::infinity(),
                                         std::numeric_limits<double>::infinity()};

/// What the settings name: the scene, or its robot in a drawn room. Throws std::runtime_error where
/// the scene cannot be read or played.
Film film_of(const StreamSettings& settings);

/// A robot that sways in a room of sim::draw_scene(), seen by cameras all around it, without noise:
/// 10 images a second for four seconds.
Film film_of_room(const std::shared_ptr<const Robot>& robot, const CameraSettings& settings,
                  const RoomSettings& room, std::size_t cameras);

/// The robot where it is in front of what else an image shows.
DepthImage drawn_over(const DepthImage& robot_m, DepthImage depth_m);

/// The film's time as it plays forth and back, `speed` times as fast.
struct Play {
  double first_s, last_s, speed, begin_s;

  double length_s() const { return (last_s - first_s) / speed; }
  /// The film's time at a time of the clock.
  double film_s(double time_s) const;
  /// When the film comes to a time in its n-th turn.
  double time_s(double film_s, int turn) const;
};

struct Shown {
  double time_s;
  std::size_t camera;
  std::size_t frame;
};

/// The images of all cameras in the order in which they come.
std::vector<Shown> shown_images(const Film& film, const Play& play, double seconds);

}  // namespace berth::lab
