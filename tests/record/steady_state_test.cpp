// Recording costs requests no memory.
#include <chrono>
#include <thread>

#include "berth/record/monitor_loop.hpp"
#include "tests/record/one_camera_loop.hpp"
#include "tests/support/allocation_count.hpp"

namespace berth {
namespace {

using RecorderSteadyState = OneCameraLoop;

TEST_F(RecorderSteadyState, AsksWithoutAnAllocationOnceItIsWarm) {
  const auto black_box = recorder(settings());
  const std::vector<double> velocity(scene_.robot->model().joints.size(), 0.0);
  const JointState joints = scene_.cameras[0].at_exposure[0];
  const std::vector<JointState> way{joints, joints};
  const auto allocations_of_three_requests = [&] {
    observe();
    black_box->put(*frame_, depth_m_);
    const std::vector<std::shared_ptr<const Frame>> frames{frame_};
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      const Request request{.frames = frames, .joints = joints, .now_s = now_s_ + 0.01 * k};
      const std::size_t before = allocation_count_of_this_thread();
      const Result& result = black_box->ask(query_, request);
      black_box->update(monitor_, result, {velocity, way}, now_s_ + 0.01 * k, &query_.frames());
      count += allocation_count_of_this_thread() - before;
    }
    // As in a loop that has its rate: the writer follows.
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return count;
  };
  // A ring turns in this number of rounds. On a busy machine more waits for the writer than ever
  // before, and has to have memory.
  std::size_t in_one_turn = 1;
  for (int turn = 0; turn < 10 && in_one_turn > 0; ++turn) {
    in_one_turn = 0;
    for (int i = 0; i < 20; ++i) in_one_turn += allocations_of_three_requests();
  }
  EXPECT_EQ(in_one_turn, 0U);
  black_box->write();
  black_box->finish();
  EXPECT_EQ(black_box->counts().lost_requests, 0);
  EXPECT_EQ(replay(file()).different, 0);
}

TEST_F(RecorderSteadyState, ALoopMonitorsWithoutAnAllocationOnceItIsWarm) {
  MonitorLoop loop(scene_.robot, {}, scene_.separation);
  const std::vector<double> velocity(scene_.robot->model().joints.size(), 0.0);
  observe();
  const std::vector<std::shared_ptr<const Frame>> frames{frame_};
  std::size_t last = 1;
  for (int k = 0; k < 10; ++k) {
    const Request request{.frames = frames, .now_s = now_s_};
    const std::size_t before = allocation_count_of_this_thread();
    loop.ask(request);
    EXPECT_TRUE(loop.monitor(velocity, now_s_).separation);
    last = allocation_count_of_this_thread() - before;
  }
  EXPECT_EQ(last, 0U);
}

}  // namespace
}  // namespace berth
