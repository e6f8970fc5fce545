// Days of running, thinned: BERTH_LONG_RUN=full in the environment makes it a million requests and
// 100 000 frames. A program of its own, because allocation_count replaces the global operator new.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>

#include "berth/pipeline/observer.hpp"
#include "tests/pipeline/frame_query.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

constexpr int kPoses = 16;

bool is_full() {
  const char* set = std::getenv("BERTH_LONG_RUN");
  return set != nullptr && std::string_view(set) == "full";
}

RobotModel make_robot() {
  std::string links =
      R"(<link name="l0"><visual><geometry><box size="0.2 0.2 0.3"/></geometry></visual></link>)";
  for (int i = 1; i <= 4; ++i) {
    links += fmt::format(
        R"(<link name="l{0}"><visual><origin xyz="0 0 0.15"/><geometry><box size="0.1 0.1 0.3"/></geometry></visual></link>
<joint name="j{0}" type="continuous"><parent link="l{1}"/><child link="l{0}"/><origin xyz="0 0 0.25"/><axis xyz="0 1 0"/></joint>)",
        i, i - 1);
  }
  const TemporaryFolder folder;
  return load_robot(
      {.urdf = folder.write("robot.urdf", "<robot name=\"chain\">" + links + "</robot>")});
}

std::shared_ptr<const MountedCamera> make_view() {
  CameraMount mount{{64, 48, 50, 50, 31.5, 23.5}, "l0"};
  mount.X_PC.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  mount.X_PC.translation() << 2, 0, 0.5;
  CameraSettings settings;
  settings.watch.min_at_robot = 0;  // the images show no robot
  return std::make_shared<const MountedCamera>(std::make_shared<const Robot>(make_robot()), mount,
                                               settings);
}

JointState joints_of(int pose) {
  JointState joints{0.01 * pose, {}};
  for (int i = 0; i < 4; ++i) joints.position.push_back(0.2 * std::sin(0.7 * pose + i));
  return joints;
}

/// A wall, and a block that moves before it.
DepthImage image_of(int pose) {
  DepthImage depth_m(64, 48, 2.8F);
  for (int v = 10; v < 20; ++v) {
    for (int u = 0; u < 8; ++u) depth_m(3 * pose + u, v) = 1.6F + 0.02F * pose;
  }
  return depth_m;
}

template <typename T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same_bits(const SpacePair& a, const SpacePair& b) {
  return same_bits(a.distance_m, b.distance_m) && same_bits(a.lower_bound_m, b.lower_bound_m) &&
         same_bits(a.robot_point_B_m, b.robot_point_B_m) &&
         same_bits(a.obstacle_point_B_m, b.obstacle_point_B_m) && a.obstacle_is == b.obstacle_is &&
         a.camera == b.camera && a.obstacle_pixel == b.obstacle_pixel;
}

bool same_bits(const LinkResult& a, const LinkResult& b) {
  return same_bits(static_cast<const SpacePair&>(a), static_cast<const SpacePair&>(b)) &&
         same_bits(static_cast<const SpacePair&>(a.occupied), b.occupied) && a.id == b.id &&
         a.status == b.status && same_bits(a.robot_point_C_m, b.robot_point_C_m) &&
         same_bits(a.obstacle_point_C_m, b.obstacle_point_C_m) &&
         same_bits(a.mean_direction_B, b.mean_direction_B) && a.mean_count == b.mean_count;
}

bool same_bits(const Result& a, const Result& b) {
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    if (!same_bits(a.links[i], b.links[i])) return false;
  }
  return !a.links.empty() && a.links.size() == b.links.size();
}

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0;
  statm >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Goes through the poses again and again, `count` steps in all: nothing allocates, no memory is
/// taken, and each result has the bits of the one before of its pose. Not of the very first one: of
/// two pixels that are equally near, the last request's is told.
template <typename Step>
void run_long(const char* what, int count, Step step) {
  // A second worker of TBB may come at any time, and allocates then.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  for (int i = 0; i < 4 * kPoses; ++i) step(i % kPoses);
  std::vector<Result> first;
  for (int pose = 0; pose < kPoses; ++pose) first.push_back(step(pose));
  int distances = 0;
  for (const LinkResult& link : first[0].links) distances += link.status == LinkStatus::ok;
  ASSERT_GE(distances, 3) << "a run without distances shows nothing";
  EXPECT_FALSE(same_bits(first[0], first[5]));
  const double before_mb = resident_mb();
  const std::size_t allocations_before = allocation_count();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < count; ++i) {
    ASSERT_TRUE(same_bits(step(i % kPoses), first[i % kPoses])) << what << " " << i;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const std::size_t allocations = allocation_count() - allocations_before;
  const double after_mb = resident_mb();
  EXPECT_EQ(allocations, 0U);
  EXPECT_LT(after_mb, before_mb + 1);
  fmt::print("{} {}: {:.0f} s, {} allocations, resident {:.2f} MB before and {:.2f} MB after\n",
             count, what, took.count(), allocations, before_mb, after_mb);
}

class LongRun : public ::testing::Test {
 protected:
  std::shared_ptr<const MountedCamera> mounted_ = make_view();
  testing::FrameQuery query_{mounted_->robot()};
  Observer observer_{mounted_};
  Frame frame_;
};
TEST_F(LongRun, RequestsTakeNoMemoryAndTheirAnswersStayTheSame) {
  observer_.observe(image_of(3), joints_of(3), frame_);
  std::vector<JointState> joints;
  for (int pose = 0; pose < kPoses; ++pose) joints.push_back(joints_of(pose));
  run_long("requests", is_full() ? 1'000'000 : thinned(2'000),
           [&](int pose) -> const Result& { return query_.ask(frame_, joints[pose]); });
}

TEST_F(LongRun, FramesTakeNoMemoryAndTheirAnswersStayTheSame) {
  std::vector<JointState> joints;
  std::vector<DepthImage> images;
  for (int pose = 0; pose < kPoses; ++pose) {
    joints.push_back(joints_of(pose));
    images.push_back(image_of(pose));
  }
  run_long("frames", is_full() ? 100'000 : thinned(1'000), [&](int pose) -> const Result& {
    observer_.observe(images[pose], joints[pose], frame_);
    return query_.ask(frame_);
  });
}

/// The newest frame of a camera, for any number of queries: it is swapped as a whole, and who holds
/// it the one before keeps it until the answer is there.
class LatestFrame {
 public:
  void set(std::shared_ptr<const Frame> frame) {
    const std::lock_guard lock(mutex_);
    frame_.swap(frame);
  }
  std::shared_ptr<const Frame> get() const {
    const std::lock_guard lock(mutex_);
    return frame_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const Frame> frame_;
};

TEST_F(LongRun, AFrameThatIsReplacedWhileTwoThreadsAskGivesTheAnswersOfOneFrameEach) {
  const int frames = is_full() ? 20'000 : thinned(300);
  const JointState asked = joints_of(1);
  Result expected[2];
  for (int i = 0; i < 2; ++i) {
    Frame frame;
    Observer(mounted_).observe(image_of(5 * i), joints_of(5 * i), frame);
    expected[i] = query_.ask(frame, asked);
  }
  ASSERT_FALSE(same_bits(expected[0], expected[1]));
  LatestFrame latest;
  std::atomic<bool> stop = false;
  std::atomic<int> wrong = 0, answers = 0;
  const auto observe = [&](Observer& observer, int i) {
    auto frame = std::make_shared<Frame>();
    JointState joints = joints_of(5 * (i % 2));
    joints.stamp_s = i;
    observer.observe(image_of(5 * (i % 2)), joints, *frame);
    latest.set(std::move(frame));
  };
  observe(observer_, 0);
  const auto ask = [&] {
    testing::FrameQuery query(mounted_->robot());
    while (!stop) {
      const std::shared_ptr<const Frame> frame = latest.get();
      const Result& result = query.ask(*frame, asked);
      const int which = static_cast<int>(result.stamp_s) % 2;
      wrong += !same_bits(result, expected[which]);
      ++answers;
    }
  };
  std::thread askers[2] = {std::thread(ask), std::thread(ask)};
  for (int i = 1; i < frames; ++i) observe(observer_, i);
  while (answers < 100) std::this_thread::yield();
  stop = true;
  for (std::thread& asker : askers) asker.join();
  EXPECT_EQ(wrong, 0);
  fmt::print("{} frames replaced under {} answers\n", frames, answers.load());
}

}  // namespace
}  // namespace berth
