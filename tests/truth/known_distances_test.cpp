// Distances to what is known against FCL, link by link: robots of the data folder, two arms in one
// URDF and in two. BERTH_KNOWN_TWIN=full in the environment makes it 10^5 poses.
#include "berth/distance/known_distances.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <string_view>

#include "berth/robot/primitives.hpp"
#include "sim/mesh_distance.hpp"
#include "sim/random.hpp"
#include "sim/winding_number.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/known_arms.hpp"
#include "tests/support/thinned.hpp"

namespace berth::sim {
namespace {

constexpr double kRange_m = 1, kTolerance_m = 1e-3;
/// Single precision at some metres; FCL's own.
constexpr double kRounding_m = 2e-5, kMargin_m = 1e-3;

/// As two_arms_in_two(), in one file.
RobotSettings two_arms_in_one() {
  RobotSettings settings = bundled_arm();
  std::ostringstream text;
  text << std::ifstream(settings.urdf).rdbuf();
  const std::string first = text.str();
  const std::size_t body = first.find("<link name=\"arm_link_0\">");
  std::string second = first.substr(body, first.rfind("</robot>") - body);
  second = std::regex_replace(second, std::regex("\"arm_"), "\"second_arm_");
  settings.urdf_text = first.substr(0, first.rfind("</robot>")) + second +
                       "<joint name=\"second_mount\" type=\"fixed\"><parent link=\"table\"/>"
                       "<child link=\"second_arm_link_0\"/><origin xyz=\"0.6 0.1 0\"/></joint>"
                       "</robot>";
  return settings;
}

class KnownRobot {
 public:
  explicit KnownRobot(const RobotSettings& settings)
      : model_(load_robot(settings)),
        known_(build_known_model(model_, build_robot_patches(model_))),
        trees_(build_link_trees(model_)) {}

  const RobotModel& model() const { return model_; }
  const KnownModel& known() const { return *known_; }

  std::vector<KnownPair> ask(const std::vector<double>& positions, KnownWorkspace& workspace,
                             double tolerance_m = kTolerance_m) {
    forward_kinematics(model_, positions, pose_);
    std::vector<KnownPair> out;
    known_distances(*known_, pose_, {.range_m = kRange_m, .tolerance_m = tolerance_m}, workspace,
                    out);
    return out;
  }

  /// Of each body's surface in the pose asked last, by FCL; infinite where nothing is nearer than
  /// what was found and a millimetre.
  std::vector<double> true_m(const std::vector<KnownPair>& found) const {
    std::vector<double> least_m(known_->bodies.size(), 0);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!known_->bodies[i].is_asked) continue;
      least_m[i] = (found[i].is_known() ? found[i].distance_m : kRange_m) + kMargin_m;
    }
    const std::vector<double> margin_m = least_m;
    for (const auto& [a, b] : known_->pairs) {
      const std::size_t p = known_->bodies[a].link, q = known_->bodies[b].link;
      const double distance_m = closest_points(trees_[p], pose_.X_BL[p], trees_[q], pose_.X_BL[q],
                                               std::max(least_m[a], least_m[b]))
                                    .distance_m;
      for (const std::size_t i : {a, b}) least_m[i] = std::min(least_m[i], distance_m);
    }
    for (std::size_t i = 0; i < least_m.size(); ++i) {
      if (least_m[i] == margin_m[i]) least_m[i] = std::numeric_limits<double>::infinity();
    }
    return least_m;
  }

  /// Whether a corner of one of the two lies within the other.
  bool is_inside(std::size_t a, std::size_t b) const {
    return has_corner_in(a, b) || has_corner_in(b, a);
  }

  void expect_holds(const std::vector<KnownPair>& found) const {
    const std::vector<double> all_true_m = this->true_m(found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const KnownPair& pair = found[i];
      if (!known_->bodies[i].is_asked) {
        EXPECT_TRUE(std::isnan(pair.distance_m) && std::isnan(pair.lower_bound_m));
        continue;
      }
      const std::size_t link = known_->bodies[i].link;
      const std::string& name = model_.links[link].name;
      const double true_m = all_true_m[i];
      if (!pair.is_known()) {
        EXPECT_GE(true_m, kRange_m - kRounding_m) << name;
        EXPECT_EQ(pair.lower_bound_m, static_cast<float>(kRange_m)) << name;
        continue;
      }
      if (pair.distance_m == 0 && true_m > kRounding_m) {
        EXPECT_TRUE(is_inside(link, static_cast<std::size_t>(pair.link)))
            << name << " in " << model_.links[static_cast<std::size_t>(pair.link)].name;
        continue;
      }
      EXPECT_LE(pair.lower_bound_m, true_m + kRounding_m) << name;
      EXPECT_GE(pair.distance_m, true_m - kRounding_m) << name;
      EXPECT_LE(pair.distance_m, pair.lower_bound_m + kTolerance_m + kRounding_m) << name;
      EXPECT_TRUE(true_m > 0 || pair.distance_m == 0) << name << pair.distance_m;
      EXPECT_NEAR((pair.robot_point_B_m - pair.obstacle_point_B_m).norm(), pair.distance_m,
                  kRounding_m);
    }
  }

  std::vector<double> draw_positions(Random& random) const {
    std::vector<double> positions;
    for (const MovableJoint& joint : model_.joints) {
      const bool is_limited = std::isfinite(joint.upper - joint.lower);
      positions.push_back(is_limited ? random(joint.lower, joint.upper) : random(-3, 3));
    }
    return positions;
  }

 private:
  bool has_corner_in(std::size_t a, std::size_t b) const {
    const Pose X_BA = pose_.X_BL[b].inverse() * pose_.X_BL[a];
    return std::ranges::any_of(model_.links[a].mesh_L.vertices_m, [&](const Eigen::Vector3f& p) {
      return std::abs(winding_number(model_.links[b].mesh_L, X_BA * p.cast<double>())) > 0.5;
    });
  }

  RobotModel model_;
  std::shared_ptr<const KnownModel> known_;
  std::vector<MeshTree> trees_;
  RobotPose pose_;
};

int poses(int share) {
  const char* const full = std::getenv("BERTH_KNOWN_TWIN");
  return full && full == std::string_view("full") ? share : thinned(share / 100);
}

/// Some steps of a motion after each jump, of up to 4 mm at the end of the arm.
/// Returns in how many poses something touches.
int check_against_fcl(const RobotSettings& settings, int count) {
  KnownRobot robot(settings);
  KnownWorkspace workspace;
  Random random(11);
  constexpr int kSteps = 10;
  constexpr double kStep_rad = 0.002;
  int contacts = 0;
  for (int i = 0; i < count / kSteps && !testing::Test::HasFailure(); ++i) {
    std::vector<double> positions = robot.draw_positions(random);
    std::vector<double> step;
    for (std::size_t j = 0; j < positions.size(); ++j) {
      step.push_back(random(-kStep_rad, kStep_rad));
    }
    for (int k = 0; k < kSteps; ++k) {
      SCOPED_TRACE(fmt::format("pose {} step {}", i, k));
      const std::vector<KnownPair> found = robot.ask(positions, workspace);
      robot.expect_holds(found);
      contacts += std::ranges::count(found, 0.0f, &KnownPair::distance_m) > 0;
      for (std::size_t j = 0; j < positions.size(); ++j) positions[j] += step[j];
    }
  }
  EXPECT_LT(contacts, count);
  return contacts;
}

TEST(KnownDistances, OfTheBundledArmAreThoseOfFcl) {
  EXPECT_GT(check_against_fcl(bundled_arm(), poses(20000)), 0);
}
TEST(KnownDistances, OfTwoArmsInOneUrdfAreThoseOfFcl) {
  EXPECT_GT(check_against_fcl(two_arms_in_one(), poses(10000)), 0);
}
TEST(KnownDistances, OfTwoArmsInTwoUrdfsAreThoseOfFcl) {
  EXPECT_GT(check_against_fcl(two_arms_in_two(), poses(10000)), 0);
}

class KnownRealRobot : public testing::TestWithParam<const char*> {};

TEST_P(KnownRealRobot, HasTheDistancesOfFcl) {
  const auto urdf = data_folder() / "robots" / GetParam();
  if (!std::filesystem::exists(urdf)) GTEST_SKIP() << "no " << urdf << "; set BERTH_DATA";
  check_against_fcl({.urdf = urdf}, poses(20000));
}
INSTANTIATE_TEST_SUITE_P(All, KnownRealRobot,
                         testing::Values("xarm7/xarm7.urdf", "kuka_lbr_med7/lbr_med7.urdf",
                                         "kinova_gen3_2f85/gen3_robotiq_2f_85.urdf"));

}  // namespace
}  // namespace berth::sim
