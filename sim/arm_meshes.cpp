#include "sim/arm_meshes.hpp"

#include <algorithm>
#include <numbers>

#include "sim/arm_shells.hpp"

namespace berth::sim {
namespace {

using std::numbers::pi;

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX();
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

TriangleMesh make_base() {
  TriangleMesh base;
  append(base, make_lathe(
                   {{0, 0}, {0.098, 0}, {0.100, 0.002}, {0.100, 0.012}, {0.097, 0.015}, {0, 0.015}},
                   kSegments));
  append(base, make_lathe(smooth_profile(
                              {{0.080, 0.014}, {0.075, 0.03}, {0.064, 0.06}, {0.060, 0.089}}, 8),
                          kSegments));
  append(base, make_collar(0.060), translation(0, 0, 0.088));
  append(base, make_lathe({{0.060, 0.088}, {0.060, 0.1095}, {0, 0.1095}}, kSegments));
  append(base, make_screws(8, 0.089, 0.015));
  append(base, make_cuboid({0.05, 0.07, 0.035}), translation(-0.075, 0, 0.0325));
  return base;
}

// An elbow with its collars and the motor cover that faces away from the y-axis joint.
TriangleMesh make_elbow_link(double height_m, double z_end_radius_m, double y_end_radius_m) {
  TriangleMesh link = make_elbow(height_m, z_end_radius_m, y_end_radius_m);
  append(link, make_collar(z_end_radius_m), translation(0, 0, 0.001));
  append(link, make_collar(y_end_radius_m),
         translation(0, -0.001, height_m) * rotation(pi / 2, kX));
  const double arc = std::max(z_end_radius_m, y_end_radius_m);
  append(link, make_cover(0.8 * y_end_radius_m, 6),
         translation(0, -2 * arc - 0.002, height_m) * rotation(pi / 2, kX));
  return link;
}

TriangleMesh make_wrist() {
  TriangleMesh wrist;
  const Profile barrel{{0, 0.001},      {0.049, 0.001},  {0.050, 0.002}, {0.050, 0.030},
                       {0.0475, 0.032}, {0.0475, 0.035}, {0.050, 0.037}, {0.049, 0.046},
                       {0.046, 0.055},  {0.040, 0.062},  {0.030, 0.066}, {0, 0.067}};
  append(wrist, make_lathe(barrel, kSegments), rotation(-pi / 2, kX));
  append(wrist, make_cover(0.028, 5), translation(0, 0.064, 0) * rotation(-pi / 2, kX));
  append(wrist, make_lathe({{0.036, 0}, {0.036, 0.045}, {0.038, 0.049}, {0.038, 0.053}, {0, 0.053}},
                           kSegments));
  return wrist;
}

TriangleMesh make_finger() {
  TriangleMesh finger = make_cuboid({0.018, 0.012, 0.050});
  append(finger, make_capsule(0.030, 0.0085, 0.0065, 32), translation(0, 0, 0.02));
  return finger;
}

// The frame is the flange's; the gripper begins there.
TriangleMesh make_flange_and_gripper() {
  TriangleMesh hand = make_lathe({{0, -0.0245},
                                  {0.038, -0.0245},
                                  {0.040, -0.022},
                                  {0.040, -0.008},
                                  {0.037, -0.006},
                                  {0.037, -0.002},
                                  {0.039, 0},
                                  {0, 0}},
                                 kSegments);
  append(hand, make_screws(7, 0.032, 0));
  append(hand, make_lathe(smooth_profile({{0.026, 0},
                                          {0.027, 0.01},
                                          {0.036, 0.022},
                                          {0.037, 0.045},
                                          {0.030, 0.056},
                                          {0, 0.058}},
                                         6),
                          kSegments));
  append(hand, make_cuboid({0.030, 0.100, 0.022}), translation(0, 0, 0.050));
  append(hand, make_finger(), translation(0, 0.034, 0.083));
  append(hand, make_finger(), translation(0, -0.034, 0.083));
  return hand;
}

}  // namespace

std::array<TriangleMesh, kArmLinks> make_arm_meshes() {
  std::array<TriangleMesh, kArmLinks> mesh;
  const Pose turned = rotation(pi, kZ);
  mesh[0] = make_base();
  mesh[1] = make_elbow_link(0.200, 0.060, 0.060);
  append(mesh[2], make_elbow_link(0.200, 0.058, 0.060), upside_down(0.200));
  append(mesh[3], make_elbow_link(0.200, 0.058, 0.057), turned);
  append(mesh[4], make_elbow_link(0.200, 0.055, 0.057), turned * upside_down(0.200));
  mesh[5] = make_elbow_link(0.190, 0.055, 0.050);
  mesh[6] = make_wrist();
  mesh[7] = make_flange_and_gripper();
  return mesh;
}

}  // namespace berth::sim
