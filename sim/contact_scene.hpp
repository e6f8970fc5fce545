// Things that touch a robot, lie on its table, give no reading, or stand beside all images.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/drawn_scene.hpp"

namespace berth::sim {

enum class ContactKind {
  box_at_arm,     ///< a box, cube or bar of 4 cm and more, in contact with a link or up to 3 cm off
  hand_on_arm,    ///< a hand of 2.5 to 6 cm that lies on a link
  hand_on_table,  ///< below a link on a table that the robot's model has, among clutter; half of
                  ///< them with a forearm that lies on the table, too
  black,          ///< a sleeve or a person without readings, near a link
  beside_images,  ///< somebody near a link whom no image shows
};
inline constexpr std::array<std::string_view, 5> kContactKindNames = {
    "box at the arm", "hand on the arm", "hand on the table", "black", "beside all images"};

struct ContactSettings {
  ContactKind kind = ContactKind::box_at_arm;
  int width_px = 640;
  int height_px = 480;
  int cameras = 2;
};

struct ContactView {
  Camera camera;
  Pose X_BC;
};

/// A robot in a closed room, in which all rays end, and things near it.
struct ContactScene {
  /// With a table (environment) that the robot has in this scene alone.
  RobotModel model;
  JointState joints;
  RobotPose pose;
  std::vector<DrawnObstacle> room;
  std::vector<DrawnObstacle> things;
  std::vector<ContactView> views;
  /// How far things stand off what they lie on, at least.
  double thickness_m = 0;
  /// [i] is that of the link with the id i + 1 to the nearest surface of thing or room, mesh to
  /// mesh; 0 where they meet.
  std::vector<double> truth_m;
  /// Whether that surface's nearest point is in an image, and no part of the robot before it.
  std::vector<bool> is_covered;
};

/// Depends on its arguments alone. But for `beside_images` some camera sees at least 10 cm^2 of the
/// things. Throws std::runtime_error where no such scene is found.
ContactScene draw_contact(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                          const ContactSettings& settings, std::uint32_t seed);

/// What a camera's rays meet, with or without the things.
class ContactRays {
 public:
  ContactRays(const ContactScene& scene, const ContactView& view, bool has_things);
  const RayCaster& rays() const { return rays_; }
  bool shows_thing(const SurfaceHit& hit) const {
    return hit.mesh != kNoMesh && hit.mesh >= first_thing_;
  }

 private:
  std::uint32_t first_thing_ = 0;
  RayCaster rays_;
};

}  // namespace berth::sim
