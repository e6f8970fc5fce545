// A loop asks, monitors and records as its parts do by themselves.
#include "berth/record/monitor_loop.hpp"

#include <cmath>

#include "berth/pipeline/observer.hpp"
#include "berth/results/result_json.hpp"
#include "tests/record/recorded_scene.hpp"

namespace berth {
namespace {

class MonitorLoopTest : public RecordedScene {
 protected:
  MonitorLoopTest() : observer_(scene_.cameras[0].mounted) {}

  std::vector<std::shared_ptr<const Frame>> observed(std::size_t k) {
    const auto frame = std::make_shared<Frame>();
    observer_.observe(scene_.cameras[0].read_depth(k), scene_.cameras[0].at_exposure[k], *frame);
    return {frame};
  }

  Observer observer_;
};

TEST_F(MonitorLoopTest, ItSaysWhatQueryAndMonitorSay) {
  MonitorLoop loop(scene_.robot, {}, scene_.separation);
  Query query(scene_.robot);
  SeparationMonitor monitor(scene_.robot, *scene_.separation);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto frames = observed(k);
    const double now_s = frames[0]->stamp_s;
    const std::vector<double> velocity(scene_.robot->model().joints.size(), 0.1);
    loop.ask({.frames = frames});
    const Result& result = loop.monitor(velocity, now_s, k != 3);
    Result expected = query.ask({.frames = frames});
    expected.separation =
        monitor.update(expected, velocity, now_s, k == 3 ? nullptr : &query.frames());
    EXPECT_EQ(result_json(result), result_json(expected)) << k;
  }
}

TEST_F(MonitorLoopTest, AfterAStopOfSomebodyElseTheScaleRisesFromZero) {
  SeparationSettings settings = some_separation();
  settings.unknown = settings.camera = UnknownPolicy::ignore;
  MonitorLoop loop(scene_.robot, {}, settings);
  // The robot alone, before a wall that is far away.
  DepthImage depth_m = observed(0)[0]->robot.depth_m;
  for (float& z_m : depth_m.pixels()) z_m = std::isnan(z_m) ? 6 : z_m;
  const auto frame = std::make_shared<Frame>();
  observer_.observe(depth_m, scene_.cameras[0].at_exposure[0], *frame);
  const std::vector<std::shared_ptr<const Frame>> frames{frame};
  const std::vector<double> velocity(scene_.robot->model().joints.size(), 0.5);
  const auto scale_at = [&](double now_s) {
    loop.ask({.frames = frames});
    return loop.monitor(velocity, now_s).separation->speed_scale;
  };
  ASSERT_EQ(scale_at(10), 1) << "nobody knows how fast the robot is at first";
  loop.stopped(10.01);
  const double risen = scale_at(10.11);
  EXPECT_GT(risen, 0);
  EXPECT_LT(risen, 0.9);
}

TEST_F(MonitorLoopTest, WithoutSettingsNothingIsMonitored) {
  MonitorLoop loop(scene_.robot);
  const auto frames = observed(0);
  const Result& asked = loop.ask({.frames = frames});
  EXPECT_FALSE(loop.has_monitor());
  EXPECT_FALSE(loop.monitor({}, 0).separation);
  EXPECT_EQ(&loop.monitor({}, 0), &asked);
}

TEST_F(MonitorLoopTest, ItRecordsAsLongAsItHasARecorder) {
  const auto black_box = recorder(settings());
  MonitorLoop loop(scene_.robot, {}, scene_.separation);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto frames = observed(k);
    black_box->put(*frames[0], scene_.cameras[0].read_depth(k));
    loop.record_with(k < 4 ? black_box.get() : nullptr);
    loop.ask({.frames = frames});
    loop.monitor({}, frames[0]->stamp_s);
  }
  black_box->write();
  black_box->finish();
  const ReplaySummary found = replay(file());
  EXPECT_EQ(found.requests, 4);
  EXPECT_EQ(found.different, 0) << found.first_difference;
}

}  // namespace
}  // namespace berth
