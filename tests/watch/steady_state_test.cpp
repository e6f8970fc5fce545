// A program of its own, because allocation_count replaces the global operator new.
#include <gtest/gtest.h>

#include "berth/watch/pose_watch.hpp"
#include "tests/support/allocation_count.hpp"

namespace berth {
namespace {

TEST(SteadyState, AWatchAllocatesNothingOnceItHasSeenTheImages) {
  const DepthImage depth_m(640, 480, 2.0F);
  const RobotImage robot{DepthImage(640, 480, 2.0F), Image<LinkId>(640, 480, 1)};
  JointState at_exposure{0, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}};
  const WatchSettings settings{
      .max_seen_through = 0.03, .max_displacement_m = 0.01, .check_every_s = 0};
  PoseWatch watch(settings, [](DepthView, const JointState&, const Pose&, std::stop_token) { return 0.001; });
  const auto go_on = [&] {
    at_exposure.stamp_s += 0.03;
    watch.look(depth_m, robot, at_exposure);
    watch.wait();
  };
  go_on();
  const std::size_t before = allocation_count();
  for (int i = 0; i < 100; ++i) go_on();
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace berth
