// The ring, what writes a recording, and trouble.
#include <sys/resource.h>

#include <csignal>
#include <thread>

#include "berth/record/recorded_messages.hpp"
#include "tests/record/one_camera_loop.hpp"

namespace berth {
namespace {

using RecorderTest = OneCameraLoop;

struct Span {
  double first_s = 0;
  double last_s = 0;
  std::int64_t requests = 0;
};

Span span_of(const std::filesystem::path& file) {
  Span span;
  for (Replay again(file); again.next(); ++span.requests) {
    if (span.requests == 0) span.first_s = again.time_s();
    span.last_s = again.time_s();
  }
  return span;
}

TEST_F(RecorderTest, KeepsTheLastSecondsAndNoMoreThanAQuarterMore) {
  const auto black_box = recorder(settings());
  for (int i = 0; i < 40; ++i) step(*black_box);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "stop.mcap.ring"));
  black_box->write();
  black_box->finish();
  const Span span = span_of(file());
  EXPECT_NEAR(span.last_s, now_s_, 1e-6);
  EXPECT_GE(span.last_s - span.first_s, 1.0 - 1e-6);
  EXPECT_LE(span.last_s - span.first_s, 1.4);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"stop.mcap"});
}

TEST_F(RecorderTest, WritesWhenTheMonitorStopsTheRobotAndNeverOverAnything) {
  RecorderSettings with = settings();
  with.after_stop_s = 0.25;
  std::vector<std::string> told;
  with.tell = [&told](const std::string& sentence) { told.push_back(sentence); };
  const auto black_box = recorder(with);
  // It stands at first: nothing is stopped.
  for (int i = 0; i < 5; ++i) step(*black_box, true);
  for (int i = 0; i < 5; ++i) step(*black_box);
  step(*black_box, true);
  const double first_stop_s = now_s_;
  for (int i = 0; i < 5; ++i) step(*black_box, true);
  for (int i = 0; i < 5; ++i) step(*black_box);
  step(*black_box, true);
  const double second_stop_s = now_s_;
  black_box->finish();
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"stop.mcap", "stop_2.mcap"}));
  EXPECT_NEAR(span_of(folder_ / "stop.mcap").last_s, first_stop_s + 0.3, 1e-6);
  // It ended before its time.
  EXPECT_NEAR(span_of(folder_ / "stop_2.mcap").last_s, second_stop_s, 1e-6);
  EXPECT_EQ(told, (std::vector<std::string>{(folder_ / "stop.mcap").string() + ": written",
                                            (folder_ / "stop_2.mcap").string() + ": written"}));
  EXPECT_EQ(replay(folder_ / "stop_2.mcap").different, 0);
}

TEST_F(RecorderTest, WritesNothingForAStopWhereThatIsOffAndNoMoreThanItsMost) {
  RecorderSettings with = settings();
  with.on_stop = false;
  {
    const auto black_box = recorder(with);
    step(*black_box);
    step(*black_box, true);
  }
  EXPECT_TRUE(folder_.names().empty());
  with.on_stop = true;
  with.most_files = 1;
  with.after_stop_s = 0;
  std::vector<std::string> told;
  with.tell = [&told](const std::string& sentence) { told.push_back(sentence); };
  const auto black_box = recorder(with);
  for (int i = 0; i < 6; ++i) step(*black_box, i % 2 == 1);
  black_box->finish();
  EXPECT_EQ(folder_.names().size(), 1U);
  expect_parts(told.at(told.size() - 1) + told.at(told.size() - 2),
               {"stop 3 is not written", "most_files is 1"});
}

TEST_F(RecorderTest, WritesWhatIsAskedForHoweverManyStopsThereWere) {
  RecorderSettings with = settings();
  with.most_files = 1;
  with.after_stop_s = 10;
  const auto black_box = recorder(with);
  for (int i = 0; i < 3; ++i) {
    step(*black_box);
    step(*black_box, true);
    black_box->write();
  }
  black_box->finish();
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"stop.mcap", "stop_2.mcap", "stop_3.mcap"}));
}

TEST_F(RecorderTest, WritesNothingWhereNothingWasAsked) {
  RecorderSettings with = settings();
  std::string told;
  with.tell = [&told](const std::string& sentence) { told = sentence; };
  const auto black_box = recorder(with);
  black_box->write();
  black_box->finish();
  expect_parts(told, {"stop.mcap: not written", "no request"});
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(RecorderTest, HasWhatIsPutBesideIt) {
  RecorderSettings with = settings();
  with.also = {{"arm.urdf", "application/xml", "<robot/>"}};
  const auto black_box = recorder(with);
  step(*black_box);
  black_box->push_joints(now_s_, std::vector<std::string>{"a"}, std::vector<double>{0.5});
  black_box->write();
  black_box->finish();
  mcap::FileReader in(file());
  EXPECT_EQ(in.attachment("arm.urdf").data, "<robot/>");
  int joints = 0;
  for (mcap::Message message; in.next(message);) {
    joints += message.channel == kJointsChannel;
  }
  EXPECT_EQ(joints, 1);
}

TEST_F(RecorderTest, TellsWhatIsLostAndGoesOnAfterIt) {
  RecorderSettings with = settings();
  // Room for two images and some requests.
  with.most_waiting_bytes = depth_m_.pixels().size() * sizeof(float) * 5 / 2;
  const auto black_box = recorder(with);
  step(*black_box);
  observe();
  for (int i = 0; i < 50; ++i) black_box->put(*frame_, depth_m_);
  EXPECT_GT(black_box->counts().lost_images, 0);
  // It answers all the same.
  ask(*black_box, false);
  const std::int64_t before = black_box->counts().requests;
  for (int i = 0; i < 200 && black_box->counts().requests < before + 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    step(*black_box);
  }
  EXPECT_GE(black_box->counts().requests, before + 3);
  EXPECT_GT(black_box->counts().lost_images, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  black_box->write();
  black_box->finish();
  const ReplaySummary found = replay(file());
  EXPECT_EQ(found.different, 0) << found.first_difference;
  EXPECT_GT(found.lost_images, 0);
}

TEST_F(RecorderTest, LosesRequestsAboutFramesThatItWasNotGiven) {
  const auto black_box = recorder(settings());
  step(*black_box);
  observe();
  ask(*black_box, false);
  EXPECT_EQ(black_box->counts().lost_requests, 1);
  step(*black_box);
  black_box->write();
  black_box->finish();
  const ReplaySummary found = replay(file());
  EXPECT_EQ(found.requests, 2);
  EXPECT_EQ(found.different, 0) << found.first_difference;
  EXPECT_EQ(found.lost_requests, 1);
}

TEST_F(RecorderTest, BeginsWithTheFirstRequestWhoseFramesItWasGiven) {
  const auto black_box = recorder(settings());
  observe();
  for (int i = 0; i < 2; ++i) ask(*black_box, false);
  EXPECT_EQ(black_box->counts().requests, 0);
  for (int i = 0; i < 3; ++i) step(*black_box);
  black_box->write();
  black_box->finish();
  const ReplaySummary found = replay(file());
  EXPECT_EQ(found.requests, 3);
  EXPECT_EQ(found.different, 0) << found.first_difference;
  EXPECT_EQ(found.lost_requests, 0);
  EXPECT_EQ(black_box->counts().lost_requests, 0);
}

TEST_F(RecorderTest, HasTheImagesThatComeBetweenARequestThatBeginsASegmentAndTheNext) {
  const auto black_box = recorder(settings());
  for (int i = 0; i < 12; ++i) {
    observe();
    black_box->put(*frame_, depth_m_);
    // Without a monitor nobody says that the request is done.
    const std::vector<std::shared_ptr<const Frame>> frames{frame_};
    black_box->ask(query_, {.frames = frames, .now_s = now_s_});
  }
  black_box->write();
  black_box->finish();
  const ReplaySummary found = replay(file());
  EXPECT_GE(found.requests, 10);
  EXPECT_EQ(found.different, 0) << found.first_difference;
}

TEST_F(RecorderTest, TellsAFullDisk) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto black_box = recorder(settings());
  const rlimit little{50'000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  for (int i = 0; i < 40; ++i) step(*black_box);
  std::string message = error_message([&] { black_box->finish(); });
  setrlimit(RLIMIT_FSIZE, &before);
  expect_parts(message, {"stop.mcap.ring/00000", "cannot be written", "expected",
                         "what was recorded before it is in", "stop.mcap.ring"});
  const RecorderCounts counts = black_box->counts();
  EXPECT_EQ(counts.trouble, message);
  EXPECT_EQ(counts.images + counts.lost_images, 40);
  EXPECT_EQ(counts.requests + counts.lost_requests, 40);
  EXPECT_GT(counts.lost_images, 0);
  EXPECT_GT(counts.lost_requests, 0);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"stop.mcap.ring"});
}

TEST_F(RecorderTest, KeepsTheRingWhereARecordingCannotBeWritten) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto black_box = recorder(settings());
  for (int i = 0; i < 20; ++i) step(*black_box);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  // Each of the ring's files has a quarter of what a recording has.
  rlim_t most = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "stop.mcap.ring")) {
    most = std::max<rlim_t>(most, entry.file_size());
  }
  const rlimit little{most * 3 / 2, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  black_box->write();
  const std::string message = error_message([&] { black_box->finish(); });
  setrlimit(RLIMIT_FSIZE, &before);
  expect_parts(message,
               {"stop.mcap: cannot be written", "recorded before it is in", "stop.mcap.ring"});
  EXPECT_EQ(black_box->counts().lost_requests, 0);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"stop.mcap.ring"});
  EXPECT_EQ(replay(folder_ / "stop.mcap.ring/000004.mcap").different, 0);
}

TEST_F(RecorderTest, RefusesAPlaceThatIsNotThereAndSettingsOutsideOfTheirDomain) {
  RecorderSettings with = settings();
  with.file = folder_ / "nowhere" / "stop.mcap";
  expect_parts(error_message([&] { recorder(with); }), {"stop.mcap.ring", "cannot be made"});
  const auto refused = [this](auto set) {
    RecorderSettings one = settings();
    set(one);
    return error_message<std::invalid_argument>([&] { recorder(one); });
  };
  expect_parts(refused([](RecorderSettings& s) { s.seconds = 0; }), {"seconds: 0", "above 0"});
  expect_parts(refused([](RecorderSettings& s) { s.after_stop_s = -1; }), {"after_stop_s: -1"});
  expect_parts(refused([](RecorderSettings& s) { s.most_files = 0; }), {"most_files: 0"});
}

TEST_F(RecorderTest, RefusesAMonitorWhoseSettingsItWasNotGiven) {
  Recorder black_box(scene_.robot, cameras(), std::nullopt, settings());
  observe();
  black_box.put(*frame_, depth_m_);
  expect_parts(error_message<std::invalid_argument>([&] { ask(black_box, false); }),
               {"recorder", "without a monitor's settings", "expected"});
}

TEST_F(RecorderTest, RefusesFramesOfOtherCameras) {
  Recorder black_box(scene_.robot, {cameras()[1]}, scene_.separation, settings());
  observe();
  expect_parts(error_message<std::invalid_argument>([&] { black_box.put(*frame_, depth_m_); }),
               {"frame", "none of the recorder's"});
}

TEST_F(RecorderTest, TakesWhatManyThreadsGiveIt) {
  const auto black_box = recorder(settings());
  step(*black_box);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&black_box] {
      for (int i = 0; i < 100; ++i) {
        black_box->push_joints(i, std::vector<std::string>{"a"}, std::vector<double>{0.5});
        static_cast<void>(black_box->counts());
      }
    });
  }
  for (int i = 0; i < 10; ++i) step(*black_box);
  threads.clear();
  black_box->write();
  black_box->finish();
  EXPECT_EQ(replay(file()).different, 0);
}

}  // namespace
}  // namespace berth
