#include <cmath>
#include <numbers>

#include "sim/person.hpp"

namespace berth::sim {
namespace {

constexpr int kSegments = 40;

TriangleMesh make_trunk() {
  const Profile outline{{0, -0.10},    {0.115, -0.08}, {0.170, 0.00}, {0.150, 0.16},
                        {0.175, 0.34}, {0.190, 0.43},  {0.150, 0.51}, {0.085, 0.545},
                        {0.072, 0.60}, {0.070, 0.64},  {0, 0.65}};
  TriangleMesh trunk;
  append(trunk, make_lathe(smooth_profile(outline, 6), kSegments, 0.62),
         rotation(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  return trunk;
}

TriangleMesh make_head() {
  TriangleMesh head = make_ellipsoid({0.098, 0.077, 0.120}, kSegments);
  append(head, make_ellipsoid({0.018, 0.013, 0.024}, 16), translation(0.098, 0, -0.015));
  for (const double side : {-1.0, 1.0})
    append(head, make_ellipsoid({0.018, 0.008, 0.030}, 16), translation(-0.005, side * 0.078, 0));
  return head;
}

TriangleMesh make_foot() {
  TriangleMesh foot;
  append(foot, make_ellipsoid({0.135, 0.048, 0.042}, 32), translation(0.065, 0, -0.036));
  return foot;
}

TriangleMesh make_limb(double length_m, double r0_m, double bulge_m, double r1_m) {
  const double l = length_m;
  return make_lathe(smooth_profile({{0, -0.95 * r0_m},
                                    {0.75 * r0_m, -0.65 * r0_m},
                                    {r0_m, 0},
                                    {bulge_m, 0.3 * l},
                                    {0.5 * (bulge_m + r1_m), 0.7 * l},
                                    {r1_m, l},
                                    {0.75 * r1_m, l + 0.65 * r1_m},
                                    {0, l + 0.95 * r1_m}},
                                   5),
                    kSegments);
}

}  // namespace

TriangleMesh make_hand() {
  TriangleMesh hand;
  append(hand, make_ellipsoid({0.042, 0.020, 0.056}, 32), translation(0, 0, 0.050));
  for (int finger = 0; finger < 4; ++finger) {
    const double x = -0.030 + 0.020 * finger;
    append(hand, make_capsule(0.062 - 0.006 * std::abs(finger - 1.5), 0.0095, 0.0080, 16),
           translation(x, 0, 0.092) * rotation(0.12 * (finger - 1.5), Eigen::Vector3d::UnitY()));
  }
  append(hand, make_capsule(0.060, 0.0120, 0.0095, 16),
         translation(-0.034, 0, 0.035) * rotation(-0.75, Eigen::Vector3d::UnitY()));
  return hand;
}

std::vector<TriangleMesh> make_person_meshes() {
  const TriangleMesh upper_arm = make_limb(kUpperArm_m, 0.056, 0.050, 0.040);
  const TriangleMesh forearm = make_limb(kForearm_m, 0.040, 0.043, 0.027);
  const TriangleMesh thigh = make_limb(kThigh_m, 0.085, 0.082, 0.056);
  const TriangleMesh shin = make_limb(kShin_m, 0.054, 0.058, 0.038);
  const TriangleMesh hand = make_hand(), foot = make_foot();
  return {make_trunk(), make_head(), upper_arm, forearm, hand,  upper_arm, forearm,
          hand,         thigh,       shin,      foot,    thigh, shin,      foot};
}

}  // namespace berth::sim
