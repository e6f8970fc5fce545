// What a slow-down was for, where it is plain.
#include "lab/closed_loop/census.hpp"

#include <gtest/gtest.h>

#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/table.hpp"
#include "sim/shapes.hpp"

namespace berth::lab {
namespace {

constexpr double kAge_s = 0.09, kFor_s = 0.004;

const RobotModel& model() {
  static const RobotModel made = cell_model();
  return made;
}

/// A ball is all that comes near the arm.
const sim::TrueClearance& ball_clearance() {
  static const sim::TrueClearance made(model(),
                                       {sim::make_ellipsoid(Eigen::Vector3d::Constant(0.1), 16)});
  return made;
}

class BallCensus {
 public:
  explicit BallCensus(bool is_along_path)
      : census_(model(), ball_clearance(), {cell_separation(250), is_along_path}, kAge_s) {}

  /// The arm is at the middle of its way to the side, where it is fastest.
  void add(double now_s, double scale, std::string_view cause, const Eigen::Vector3d& p_B_m,
           const Eigen::Vector3d& v_m_s = Eigen::Vector3d::Zero()) {
    census_.add(now_s, kFor_s, scale, cause, 1.35, [&](double after_s) {
      return std::vector<Pose>{Pose(Eigen::Translation3d(p_B_m + after_s * v_m_s))};
    });
  }
  const LostTimes& lost() const { return census_.lost(); }
  LostTime lost(std::string_view cause) const {
    const auto found = lost().find(cause);
    return found == lost().end() ? LostTime{} : found->second;
  }

 private:
  Census census_;
};

const Eigen::Vector3d kFar(2.5, 0, 0.3), kOnTheWay(0.5, 0.3, 0.3), kBehind(-0.75, 0, 0.3);

TEST(Census, ThreeKindsOfNeed) {
  for (const bool is_along_path : {false, true}) {
    BallCensus census(is_along_path);
    census.add(0.0, 0, "occupied", kOnTheWay);
    census.add(0.1, 0, "unknown", kBehind);
    census.add(0.2, 0, "rejected", kFar);
    census.add(0.3, 1, "none", kFar);
    EXPECT_EQ(census.lost("occupied").needed_s, kFor_s);
    EXPECT_EQ(census.lost("rejected").false_s, kFor_s);
    const LostTime behind = census.lost("unknown");
    EXPECT_EQ(behind.needed_s, 0);
    EXPECT_GT(behind.allowed_s, 0.2 * kFor_s) << "the rule asks for some";
    EXPECT_NEAR(behind.sum_s(), kFor_s, 1e-12);
    EXPECT_EQ(census.lost().size(), 3U);
    EXPECT_NEAR(needed_share(census.lost()), 1.0 / 3, 1e-9);
  }
}

TEST(Census, SomebodyWhoComesWithinASecondIsNeeded) {
  const Eigen::Vector3d beyond(0.5, 1.4, 0.3);
  BallCensus census(true);
  census.add(0.0, 0.5, "unknown", beyond);
  EXPECT_EQ(census.lost("unknown").needed_s, 0);
  census.add(0.1, 0.5, "occupied", beyond, {0, -1.1, 0});
  EXPECT_EQ(census.lost("occupied").needed_s, 0.5 * kFor_s);
}

TEST(Census, SpeedingUpIsPartOfWhatSlowedItDown) {
  BallCensus census(true);
  census.add(0.0, 0, "stale", kOnTheWay);
  census.add(0.0, 0.1, "speeding_up", kOnTheWay);
  EXPECT_TRUE(census.lost().empty()) << "nothing has begun";
  census.add(0.1, 0, "unknown", kFar);
  census.add(0.2, 0.5, "speeding_up", kFar);
  EXPECT_NEAR(census.lost("unknown").false_s, 1.5 * kFor_s, 1e-12);
  EXPECT_EQ(main_cause(census.lost()), "unknown");
}

TEST(Census, TheColumnsStandBehindAllOthers) {
  EncounterResult result;
  result.lost["unknown"] = {0, 1, 0};
  result.lost["occupied"] = {3, 0, 0};
  const std::string csv = encounter_csv({{"path", ""}}, {{result, {}}});
  EXPECT_NE(csv.find("reached,cause,needed\n"), std::string::npos);
  EXPECT_NE(csv.find(",0,occupied,0.7500\n"), std::string::npos);
  EXPECT_NE(csv.find(",0,none,0.0000\n"), std::string::npos);
}

}  // namespace
}  // namespace berth::lab
