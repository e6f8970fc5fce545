// A recording gives the same results once more, or says where not.
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "berth/pipeline/observer.hpp"
#include "berth/record/recorded_cell.hpp"
#include "berth/record/recorded_messages.hpp"
#include "tests/record/recorded_scene.hpp"

namespace berth {
namespace {

class ReplayTest : public RecordedScene {
 protected:
  std::filesystem::path changed(const Change& change) const {
    rewrite(file(), folder_ / "changed.mcap", change);
    return folder_ / "changed.mcap";
  }
  std::string error_of(const Change& change) const {
    const std::filesystem::path to = changed(change);
    return error_message([&] { replay(to); });
  }
};

TEST_F(ReplayTest, GivesTheSameResultsToTheLastBit) {
  record_scene(settings(), 30);
  const ReplaySummary found = replay(file());
  EXPECT_EQ(found.different, 0) << found.first_difference;
  EXPECT_GE(found.requests, 25);
  EXPECT_EQ(found.lost_images + found.lost_requests, 0);
}

TEST_F(ReplayTest, HasTheMonitorsPart) {
  record_scene(settings(), 4);
  Replay again(file());
  ASSERT_TRUE(again.next());
  ASSERT_TRUE(again.result().separation);
  const auto recorded = nlohmann::json::parse(again.recorded());
  EXPECT_EQ(recorded["schema"], "berth/result/3");
  EXPECT_EQ(recorded["separation"]["state"], name_of(again.result().separation->state));
}

/// Requests at 100 Hz about spaces that were prepared, as a running robot has them.
TEST_F(ReplayTest, GivesTheSameResultsOfPreparedSpaces) {
  const auto black_box = recorder(settings());
  std::vector<Observer> observers;
  std::vector<std::shared_ptr<const Frame>> frames(scene_.cameras.size());
  for (const auto& mounted : cameras()) observers.emplace_back(mounted);
  Query query(scene_.robot, {"front", "left", "right"});
  SeparationMonitor monitor(scene_.robot, *scene_.separation);
  JointBuffer buffer(scene_.robot->model(), 100);
  std::vector<std::string> names;
  for (const MovableJoint& joint : scene_.robot->model().joints) names.push_back(joint.name);
  std::vector<double> velocity;
  JointState joints;
  const auto push_until = [&](double now_s) {
    scene_.joints->at(now_s, kOnlyBetweenSamples, joints);
    buffer.push(now_s, names, joints.position);
    black_box->push_joints(now_s, names, joints.position);
  };
  std::shared_ptr<PreparedSpace> space;
  std::vector<std::string> live;
  for (int i = 0; i < 12; ++i) {
    for (std::size_t k = 0; k < frames.size(); ++k) {
      if (k == 2 && i < 3) continue;  // it has given none yet
      const OpenCamera& camera = scene_.cameras[k];
      const auto frame = std::make_shared<Frame>();
      const DepthImage depth_m = camera.read_depth(i);
      observers[k].observe(depth_m, camera.at_exposure[i], *frame, camera.exposure_time[i]);
      black_box->put(*frame, depth_m);
      frames[k] = frame;
    }
    const double exposed_s = frames[1]->stamp_s;
    push_until(exposed_s);
    space = std::make_shared<PreparedSpace>(scene_.robot, frames.size());
    space->prepare(frames, i % 2 == 0 ? nullptr : &joints);
    push_until(exposed_s + 0.005);
    space->search(joints);
    for (int request = 1; request < 6; ++request) {
      const double now_s = exposed_s + 0.005 + 0.01 * request;
      push_until(now_s);
      scene_.joints->velocity(now_s, velocity);
      JointState later = joints;
      later.stamp_s = 0.5;
      const std::vector<JointState> way{{0, joints.position}, later};
      // The last ones of each without what was prepared.
      const NewestFrames newest = request == 5 ? NewestFrames(frames) : NewestFrames(space);
      const Result& result = black_box->ask(query, {newest, buffer, now_s});
      const PlannedMotion motion =
          request % 2 == 0 ? PlannedMotion(velocity) : PlannedMotion(velocity, way);
      black_box->update(monitor, result, motion, now_s, i % 3 == 0 ? nullptr : &query.frames());
    }
  }
  black_box->write();
  black_box->finish();
  EXPECT_EQ(black_box->counts().requests, 60);
  EXPECT_EQ(black_box->counts().lost_requests, 0);
  const ReplaySummary found = replay(file());
  EXPECT_EQ(found.different, 0) << found.first_difference;
  EXPECT_GE(found.requests, 55);
}

TEST_F(ReplayTest, KnowsBackgrounds) {
  OpenScene scene = scene_;
  for (OpenCamera& camera : scene_.cameras) {
    CameraSettings settings = camera.mounted->settings();
    settings.sensor.background_frames = 2;
    camera.mounted =
        std::make_shared<const MountedCamera>(scene_.robot, camera.mounted->mount(), settings);
    camera.background_m = camera.read_depth(0);
  }
  record_scene(settings(), 24);
  const ReplaySummary found = replay(file());
  EXPECT_EQ(found.different, 0) << found.first_difference;
  EXPECT_GE(found.requests, 20);
}

TEST_F(ReplayTest, TellsTheFirstFieldWhereASettingWasChanged) {
  record_scene(settings(), 6);
  const Change change{.head = [](mcap::Head& head) {
    replace(attachment(head, "cell.json").data, "\"tolerance_m\": 0.05", "\"tolerance_m\": 0.01");
  }};
  const ReplaySummary found = replay(changed(change));
  EXPECT_GT(found.different, 0);
  expect_parts(found.first_difference,
               {R"(request 0, 0.013 s: nearest: recorded "arm_link_2", replayed "arm_link_1")"});
}

TEST_F(ReplayTest, TellsTheFirstFieldWhereAnImageWasChanged) {
  record_scene(settings(), 6);
  int images = 0;
  const Change change{.message = [&images](const mcap::Message& message, std::string& data) {
    if (message.channel == channel_of(0, kDepthOfCamera) && images++ == 1) {
      // Its last bytes are the numbers.
      const std::uint16_t near_mm = 700;
      for (std::size_t i = 20'000; i < 40'000; ++i) {
        std::memcpy(&data[data.size() - 2 * i], &near_mm, sizeof near_mm);
      }
    }
    return true;
  }};
  const ReplaySummary found = replay(changed(change));
  EXPECT_GT(found.different, 0);
  EXPECT_LT(found.different, found.requests);
  expect_parts(found.first_difference, {"recorded", "replayed"});
}

TEST_F(ReplayTest, TellsAResultThatWasChanged) {
  record_scene(settings(), 3);
  const Change change{.message = [](const mcap::Message& message, std::string& data) {
    if (message.channel == kResultChannel) {
      auto json = nlohmann::ordered_json::parse(data);
      json["links"][2]["distance_m"] = 0.125;
      data = json.dump();
    }
    return true;
  }};
  const ReplaySummary found = replay(changed(change));
  EXPECT_EQ(found.different, 3);
  expect_parts(found.first_difference,
               {"links[arm_link_", "].distance_m: recorded 0.125, replayed "});
}

TEST_F(ReplayTest, RefusesWhatIsMissingOrOutsideOfItsDomain) {
  record_scene(settings(), 3);
  const auto without = [](std::string_view name) {
    return Change{.head = [name](mcap::Head& head) {
      std::erase_if(head.attachments,
                    [name](const mcap::Attachment& a) { return a.name.starts_with(name); });
    }};
  };
  expect_parts(error_of(without("cell.json")), {"changed.mcap", "cell.json", "missing"});
  expect_parts(error_of(without("robot.json")), {"robot.json", "missing"});
  expect_parts(error_of(without("meshes/")), {"meshes/", ".ply", "missing"});
  const auto with = [](const char* before, const char* after) {
    return Change{.head = [before, after](mcap::Head& head) {
      replace(attachment(head, "cell.json").data, before, after);
    }};
  };
  expect_parts(error_of(with("\"range_m\": ", "\"range_m\": -")),
               {"changed.mcap", "range_m", "-1", "expected"});
  expect_parts(error_of(with("\"range_m\"", "\"rangem\"")), {"changed.mcap", "evaluation.range_m"});
  expect_parts(error_of(with("berth/recording/1", "berth/recording/9")),
               {"schema", "berth/recording/9", "berth/recording/1"});
  expect_parts(error_of(with("{", "[")), {"changed.mcap", "robot or settings"});
  const Change no_images{.message = [](const mcap::Message& message, std::string&) {
    return message.channel != channel_of(1, kDepthOfCamera);
  }};
  expect_parts(error_of(no_images), {"changed.mcap", " s: ", "exposure", "missing"});
  const auto without_number = [](std::uint16_t channel, std::string_view number) {
    // A request's result follows it.
    auto drops = std::make_shared<bool>(false);
    return Change{.message = [=](const mcap::Message& message, std::string& data) {
      if (message.channel == kRequestChannel) {
        *drops = data.find(fmt::format("\"number\":{},", number)) != std::string::npos;
      }
      const bool is_either =
          message.channel == kRequestChannel || message.channel == kResultChannel;
      return !(is_either && *drops && (channel == 0 || channel == message.channel));
    }};
  };
  expect_parts(error_of(without_number(0, "1")),
               {"changed.mcap", " s: request 2 follows request 0; expected request 1"});
  expect_parts(error_of(without_number(kRequestChannel, "1")),
               {"changed.mcap", " s: a result without its request"});
  expect_parts(error_of(without_number(kResultChannel, "1")),
               {"changed.mcap", " s: request 1 has no result"});
  expect_parts(error_of(without_number(kResultChannel, "2")),
               {"changed.mcap: request 2: has no result"});
  const Change no_request{.message = [](const mcap::Message& message, std::string&) {
    return message.channel != kRequestChannel && message.channel != kResultChannel;
  }};
  expect_parts(error_of(no_request), {"changed.mcap", "no request", "one at least"});
  const Change of_another_version{.head = [](mcap::Head& head) {
    replace(attachment(head, "cell.json").data, "\"berth\": \"", "\"berth\": \"99.");
    replace(attachment(head, "cell.json").data, "\"range_m\"", "\"rangem\"");
  }};
  expect_parts(error_of(of_another_version),
               {"changed.mcap", "by berth 99.", "read by berth", "evaluation.range_m"});
  const Change no_begin{.message = [](const mcap::Message& message, std::string&) {
    return message.channel != kBeginChannel;
  }};
  expect_parts(error_of(no_begin), {"changed.mcap"});
}

TEST_F(ReplayTest, SaysWhatADeadlineMayHaveDone) {
  const auto change = [](mcap::Head& head) {
    auto& cell = attachment(head, "cell.json").data;
    replace(cell, "\"deadline_us\": null", "\"deadline_us\": 100");
    replace(cell, "\"tolerance_m\": 0.05", "\"tolerance_m\": 0.01");
  };
  record_scene(settings(), 2);
  expect_parts(replay(changed({.head = change})).first_difference,
               {"deadline_us", "cut short", "not found again"});
}

TEST_F(ReplayTest, HasEveryBitOfRobotAndSettings) {
  RecordedCell cell{scene_.robot, cameras(), some_separation(), "1.2.3"};
  EvaluationSettings evaluation;
  evaluation.distance.range_m = 1.0 / 3;
  evaluation.time.max_frame_age_s = std::numeric_limits<double>::infinity();
  TriangleMesh tool;
  tool.vertices_m = {{0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0.1F}};
  tool.triangles = {{0, 1, 2}};
  const std::string hand = scene_.robot->model().evaluated_link_names().back();
  cell.robot = std::make_shared<const Robot>(
      scene_.robot->model(), evaluation,
      std::vector<Attachment>{{"knife", hand, tool, Pose::Identity(), true, true}});
  CameraSettings settings = settings_of_real_camera();
  settings.link_padding_m = {{hand, 0.1}};
  settings.self_filter.padding_m = 0.07;
  cell.cameras = {
      std::make_shared<const MountedCamera>(cell.robot, cameras()[0]->mount(), settings)};
  cell.separation->stopping = {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
  cell.separation->unknown = UnknownPolicy::stop;
  const mcap::Head head = head_of(cell);
  mcap::FileWriter(file(), head).finish();
  const mcap::Head again = head_of(read_cell(mcap::FileReader(file())));
  ASSERT_EQ(again.attachments.size(), head.attachments.size());
  for (std::size_t i = 0; i < head.attachments.size(); ++i) {
    EXPECT_EQ(again.attachments[i].name, head.attachments[i].name);
    EXPECT_EQ(again.attachments[i].data, head.attachments[i].data) << head.attachments[i].name;
  }
}

}  // namespace
}  // namespace berth
