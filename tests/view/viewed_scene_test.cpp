#include "apps/view/viewed_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>

#include "apps/view/space_grid.hpp"
#include "berth/files/file_bytes.hpp"
#include "tests/support/carrying_cell.hpp"
#include "tests/support/coarse_arm.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using std::chrono::steady_clock;

/// The JSON of a message, of either kind.
Json json_of_message(const PageMessage& message) {
  if (!message.is_binary) return Json::parse(message.bytes);
  std::uint32_t length = 0;
  std::memcpy(&length, message.bytes.data(), sizeof length);
  return Json::parse(message.bytes.substr(sizeof length, length));
}

/// What pages would have: the newest message of each kind.
class Messages {
 public:
  void take(const std::string& kind, PageMessage message) {
    const std::scoped_lock lock(mutex_);
    newest_[kind] = std::move(message);
    ++count_[kind];
    changed_.notify_all();
  }
  PageMessage newest(const std::string& kind) {
    const std::scoped_lock lock(mutex_);
    return newest_.at(kind);
  }
  Json json(const std::string& kind) { return json_of_message(newest(kind)); }
  int count(const std::string& kind) {
    const std::scoped_lock lock(mutex_);
    return count_[kind];
  }
  /// Waits until there are more of this kind than before.
  Json after(const std::string& kind, int before) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::minutes(4), [&] { return count_[kind] > before; })) {
      throw std::runtime_error("no " + kind);
    }
    return json_of_message(newest_[kind]);
  }
  /// Waits until what is shown is what the run in the background says, of this step or of any.
  Json shown_for_good(std::optional<std::size_t> step = {}) {
    while (true) {
      const int before = count("shown");
      Json shown = json("shown");
      if (!shown["is_provisional"] && (!step || shown["step"] == *step)) return shown;
      after("shown", before);
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, PageMessage> newest_;
  std::map<std::string, int> count_;
};

class ViewedSceneTest : public ::testing::Test {
 protected:
  /// Does it, and waits for the next message of this kind.
  Json ask(const Json& request, const std::string& kind) {
    const int before = messages_.count(kind);
    viewed_.receive(request.dump());
    return messages_.after(kind, before);
  }
  /// The next notice, whichever place it has.
  Json refused(const std::string& request) {
    const std::string kind = "notice " + std::to_string(number_++ % 8);
    const int before = messages_.count(kind);
    viewed_.receive(request);
    return messages_.after(kind, before);
  }
  /// Of a run that began after `before` messages.
  Json finished_timeline(int before) {
    Json timeline = messages_.after("timeline", before);
    while (timeline["done"] != timeline["total"] && timeline["error"] == "") {
      timeline = messages_.after("timeline", messages_.count("timeline"));
    }
    return timeline;
  }

  Messages messages_;
  TemporaryFolder folder_;
  int number_ = 0;
  ViewedScene viewed_{BERTH_SOURCE_DIR "/data/bundled/scene.yaml", folder_.path(),
                      [this](const std::string& kind, PageMessage message) {
                        messages_.take(kind, std::move(message));
                      }};
};

Json set_request(const char* group, const char* key, const Json& value) {
  return {{"do", "set"}, {"group", group}, {"key", key}, {"value", value}};
}

TEST_F(ViewedSceneTest, TellsAllThatAPageShows) {
  const Json scene = messages_.json("scene");
  EXPECT_EQ(scene["steps"].size(), 101u);
  EXPECT_EQ(scene["cameras"][2]["name"], "right");
  EXPECT_EQ(scene["fates"].size(), static_cast<std::size_t>(kPixelFateCount));
  const Json mesh = messages_.json("mesh");
  EXPECT_EQ(mesh["corners"].size(), scene["links"].size());
  const Json shown = messages_.json("shown");
  EXPECT_EQ(shown["links"].size(), scene["links"].size());
  // The first at which every camera has an image.
  EXPECT_EQ(shown["step"], 2);
  for (int c = 0; c < 3; ++c) {
    const PageMessage image = messages_.newest("image " + std::to_string(c));
    const Json header = json_of_message(image);
    EXPECT_EQ(header["camera"], c);
    EXPECT_GT(image.bytes.size(),
              header["width_px"].get<std::size_t>() * header["height_px"].get<std::size_t>() * 9);
  }
}

TEST_F(ViewedSceneTest, SettingsComeFromTheListsAndTellWhatChanged) {
  const auto padding = [&](const Json& settings) {
    const Json& group = settings["groups"][0];
    EXPECT_EQ(group["name"], "self_filter");
    for (std::size_t i = 0; i < group["settings"].size(); ++i) {
      if (group["settings"][i]["name"] != "padding_m") continue;
      EXPECT_EQ(group["settings"][i]["unit"], "m");
      EXPECT_NE(group["settings"][i]["sentence"], "");
      return std::pair(group["now"][1][i].get<double>(), group["file"][1][i].get<double>());
    }
    return std::pair(0.0, 0.0);
  };
  EXPECT_EQ(padding(messages_.json("settings")), std::pair(0.02, 0.02));
  Json request = set_request("self_filter", "padding_m", 0.04);
  request["camera"] = 1;
  EXPECT_EQ(padding(ask(request, "settings")), std::pair(0.04, 0.02));
  EXPECT_EQ(padding(ask({{"do", "reset"}}, "settings")), std::pair(0.02, 0.02));
}

TEST_F(ViewedSceneTest, AKnobShowsOnTheFrameBeforeTheRestFollows) {
  finished_timeline(0);
  const int before = messages_.count("timeline");
  const Json shown = ask(set_request("evaluation", "range_m", 0.25), "shown");
  EXPECT_EQ(shown["result"]["range_m"], 0.25);
  const Json timeline = finished_timeline(before);
  EXPECT_EQ(timeline["links"]["status"][0].size(), 101u);
  EXPECT_TRUE(timeline["speed"].is_null()) << "nothing monitors it";
}

TEST_F(ViewedSceneTest, FrameAndCurvesSayTheSame) {
  const Json timeline = finished_timeline(0);
  for (const std::size_t step : {0, 2, 31, 49, 100}) {
    viewed_.receive(Json({{"do", "show"}, {"step", step}}).dump());
    const Json shown = messages_.shown_for_good(step);
    const Json& links = shown["result"]["links"];
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Json& curve_m = timeline["links"]["distance_m"][i][step];
      EXPECT_EQ(links[i]["status"], timeline["links"]["status"][i][step]);
      ASSERT_EQ(links[i]["distance_m"].is_null(), curve_m.is_null());
      if (curve_m.is_null()) continue;
      EXPECT_NEAR(links[i]["distance_m"].get<double>(), curve_m.get<double>(), 0.51e-4);
    }
    const Json& nearest = timeline["nearest"][step];
    const Json name = nearest.is_null() ? Json() : links[nearest.get<std::size_t>()]["link"];
    EXPECT_EQ(shown["result"]["nearest"], name);
  }
}

TEST_F(ViewedSceneTest, TheFrameIsToldAnewOnceTheRunHasComeThere) {
  finished_timeline(0);
  // The last one: the run comes there last.
  viewed_.receive(R"({"do": "show", "step": 100})");
  messages_.shown_for_good(100);
  EXPECT_TRUE(ask(set_request("evaluation", "range_m", 0.5), "shown")["is_provisional"]);
  const Json shown = messages_.shown_for_good();
  EXPECT_EQ(shown["step"], 100);
  EXPECT_EQ(shown["result"]["range_m"], 0.5);
}

TEST_F(ViewedSceneTest, AChangeShowsWithinATenthOfASecond) {
  finished_timeline(0);
  std::vector<double> times_ms;
  for (int i = 0; i < 11; ++i) {
    const int before = messages_.count("image 2");
    const auto start = steady_clock::now();
    viewed_.receive(set_request("self_filter", "tolerance_m", 0.03 + 0.001 * i).dump());
    messages_.after("image 2", before);
    times_ms.push_back(
        std::chrono::duration<double, std::milli>(steady_clock::now() - start).count());
    // A user's next turn of a knob, while the other frames are computed.
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::ranges::nth_element(times_ms, times_ms.begin() + 5);
  RecordProperty("median_ms", std::to_string(times_ms[5]));
  // Ten times what is promised: machines that test are busy.
  EXPECT_LT(times_ms[5], 1000) << "ms in the median";
}

TEST_F(ViewedSceneTest, ShowsTheStepThatIsAskedForLast) {
  EXPECT_EQ(ask({{"do", "show"}, {"step", 49}}, "shown")["step"], 49);
  EXPECT_EQ(ask({{"do", "show"}, {"step", 100000}}, "shown")["step"], 100);
}

TEST_F(ViewedSceneTest, ACameraIsMoved) {
  const Json shown = ask(
      {{"do", "pose"}, {"camera", 0}, {"xyz_m", {0, 0, 3}}, {"rpy_rad", {3.14, 0, 0}}}, "settings");
  EXPECT_EQ(shown["poses"][0]["now"]["xyz_m"], Json({0.0, 0.0, 3.0}));
  EXPECT_NE(shown["poses"][0]["file"]["xyz_m"], Json({0.0, 0.0, 3.0}));
  const Json back = ask({{"do", "pose"}, {"camera", 0}, {"xyz_m", nullptr}}, "settings");
  EXPECT_EQ(back["poses"][0]["now"], back["poses"][0]["file"]);
}

TEST_F(ViewedSceneTest, UnknownSpaceIsFoundOnRequest) {
  const PageMessage message = [&] {
    ask({{"do", "space"}, {"on", true}}, "space");
    return messages_.newest("space");
  }();
  const Json header = json_of_message(message);
  const std::size_t cells = header["cells"][0].get<std::size_t>() *
                            header["cells"][1].get<std::size_t>() *
                            header["cells"][2].get<std::size_t>();
  EXPECT_LE(cells, kMostCells);
  const std::string sight = message.bytes.substr(message.bytes.size() - (cells + 3) / 4 * 4, cells);
  for (const char kind : {'\0', '\1', '\2'}) {
    EXPECT_GT(std::ranges::count(sight, kind), static_cast<std::ptrdiff_t>(cells / 400))
        << int{kind};
  }
  EXPECT_EQ(ask({{"do", "space"}, {"on", false}}, "space")["cells"], Json({0, 0, 0}));
}

TEST_F(ViewedSceneTest, RefusesWhatNoPageAsks) {
  for (const char* request :
       {"",
        "no json",
        "[]",
        "7",
        "{}",
        R"({"do": 7})",
        R"({"do": "fly"})",
        R"({"do": "show"})",
        R"({"do": "show", "step": "x"})",
        R"({"do": "set"})",
        R"({"do": "set", "group": "robot", "key": "urdf", "value": "x"})",
        R"({"do": "set", "group": "self_filter", "key": "padding_m", "value": [1]})",
        R"({"do": "set", "group": "space", "key": "no_reading", "value": "free\nrobot: x"})",
        R"({"do": "set", "group": "space", "key": "no_reading", "value": "free", "camera": 9})",
        R"({"do": "set", "group": 7, "key": {}, "value": 1})",
        R"({"do": "set", "group": "evaluation", "key": "method", "value": "exact"})",
        R"({"do": "set", "group": "evaluation", "key": "tile_px", "value": 8})",
        R"({"do": "set", "group": "evaluation", "key": "no_such_key", "value": 8})",
        R"({"do": "pose", "camera": 0, "xyz_m": [1e9, 0, 0], "rpy_rad": [0, 0, 0]})",
        R"({"do": "pose", "camera": -1, "xyz_m": [0, 0, 0], "rpy_rad": [0, 0, 0]})",
        R"({"do": "save", "name": "../x.yaml"})",
        R"({"do": "save", "name": 7})"}) {
    EXPECT_TRUE(refused(request)["is_refused"]) << request;
  }
  EXPECT_TRUE(folder_.names().empty());
  EXPECT_EQ(ask({{"do", "show"}, {"step", 1}}, "shown")["step"], 1);
}

TEST_F(ViewedSceneTest, ARefusalIsTakenBackByTheNextChange) {
  const Json refusal = refused(set_request("evaluation", "range_m", 1000).dump());
  EXPECT_TRUE(refusal["is_refused"]);
  const auto text = refusal["text"].get<std::string>();
  EXPECT_TRUE(text.starts_with("evaluation.range_m: 1000; expected")) << text;
  const Json next = refused(set_request("evaluation", "range_m", 50).dump());
  EXPECT_FALSE(next["is_refused"]);
  EXPECT_EQ(next["text"], "");
}

TEST_F(ViewedSceneTest, SavesIntoItsFolder) {
  const Json notice = refused(R"({"do": "save", "name": "new.yaml"})");
  EXPECT_FALSE(notice["is_refused"]) << notice;
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"new.yaml"});
}

/// The bundled scene's first camera, with the coarse arm.
class CalibrationOfViewedScene : public ::testing::Test {
 protected:
  CalibrationOfViewedScene() {
    fs::copy(BERTH_SOURCE_DIR "/data/bundled", scene_.path(), fs::copy_options::recursive);
    fs::copy(testing::coarse_arm_folder(BERTH_SOURCE_DIR "/data/bundled/arm"), scene_ / "arm",
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    viewed_.emplace(scene_ / "one_camera.yaml", folder_.path(),
                    [this](const std::string& kind, PageMessage message) {
                      messages_.take(kind, std::move(message));
                    });
  }
  Json ask(const Json& request, const std::string& kind) {
    const int before = messages_.count(kind);
    viewed_->receive(request.dump());
    return messages_.after(kind, before);
  }

  const TemporaryFolder scene_, folder_;
  Messages messages_;
  std::optional<ViewedScene> viewed_;
};

TEST_F(CalibrationOfViewedScene, IsStartedAndStopped) {
  EXPECT_EQ(ask({{"do", "calibration_data"}}, "calibration_data")["state"], "runs");
  // It answers meanwhile.
  EXPECT_EQ(ask({{"do", "show"}, {"step", 7}}, "shown")["step"], 7);
  EXPECT_EQ(ask({{"do", "drop_calibration_data"}}, "calibration_data")["state"], "none");
  // Nothing was found that could be taken.
  const Json before = messages_.json("settings");
  viewed_->receive(R"({"do": "take_calibration_data"})");
  EXPECT_EQ(ask({{"do", "show"}, {"step", 8}}, "shown")["step"], 8);
  EXPECT_EQ(messages_.json("settings"), before);
}

TEST_F(CalibrationOfViewedScene, IsFoundAndTaken) {
  const auto from_truth_m = [&](const Json& pose) {
    double square_m2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double difference_m =
          pose["now"]["xyz_m"][axis].get<double>() - pose["file"]["xyz_m"][axis].get<double>();
      square_m2 += difference_m * difference_m;
    }
    return std::sqrt(square_m2);
  };
  Json file = messages_.json("settings")["poses"][0]["file"];
  file["xyz_m"][0] = file["xyz_m"][0].get<double>() + 0.03;
  const Json moved =
      ask({{"do", "pose"}, {"camera", 0}, {"xyz_m", file["xyz_m"]}, {"rpy_rad", file["rpy_rad"]}},
          "settings");
  EXPECT_NEAR(from_truth_m(moved["poses"][0]), 0.03, 1e-6);
  EXPECT_EQ(ask({{"do", "calibration_data"}}, "calibration_data")["state"], "runs");
  const Json found = messages_.after("calibration_data", messages_.count("calibration_data"));
  ASSERT_EQ(found["state"], "found") << found;
  EXPECT_LT(found["cameras"][0]["after"]["median_m"], found["cameras"][0]["before"]["median_m"]);
  const int before = messages_.count("settings");
  EXPECT_EQ(ask({{"do", "take_calibration_data"}}, "calibration_data")["state"], "taken");
  EXPECT_LT(from_truth_m(messages_.after("settings", before)["poses"][0]), 0.01);
}

class CarryingViewedScene : public ::testing::Test {
 protected:
  /// The state after the next message of it.
  Json ask(const Json& request) {
    const int before = messages_.count("calibration_data");
    viewed_.receive(request.dump());
    return messages_.after("calibration_data", before);
  }
  Json next() { return messages_.after("calibration_data", messages_.count("calibration_data")); }
  /// Calibrates until it asks.
  Json question() {
    EXPECT_EQ(ask({{"do", "calibration_data"}})["state"], "runs");
    return next();
  }
  static Json answer(const Json& part, bool is_taken) {
    return {{"do", "answer_calibration_data"}, {"part", part}, {"is_taken", is_taken}};
  }
  /// Until it is done: requests are carried out one after another.
  void save() {
    viewed_.receive(R"({"do": "save", "name": "new.yaml"})");
    viewed_.receive(R"({"do": "show", "step": 5})");
    messages_.shown_for_good(5);
  }
  std::set<std::string> links() {
    std::set<std::string> names;
    const Json scene = messages_.json("scene");
    for (const Json& link : scene["links"]) names.insert(link["name"]);
    return names;
  }

  testing::CarryingCell cell_{testing::coarse_arm_folder(BERTH_SOURCE_DIR "/data/bundled/arm")};
  const TemporaryFolder folder_;
  Messages messages_;
  ViewedScene viewed_{cell_ / "cell/scene.yaml", folder_.path(),
                      [this](const std::string& kind, PageMessage message) {
                        messages_.take(kind, std::move(message));
                      }};
};

TEST_F(CarryingViewedScene, AsksWhetherWhatItCarriesIsAPart) {
  const Json asked = question();
  ASSERT_EQ(asked["state"], "asks") << asked;
  EXPECT_EQ(asked["part"], "arm_link_7_attached");
  EXPECT_TRUE(asked["question"].get<std::string>().starts_with(
      "arm_link_7 carries something that its URDF does not have"));
  ASSERT_EQ(asked["pictures"].size(), 1U);
  EXPECT_EQ(asked["pictures"][0]["camera"], "camera");
  EXPECT_GT(asked["pictures"][0]["bytes"], 1000);
  EXPECT_NE(messages_.newest("calibration_data").bytes.find("\x89PNG"), std::string::npos);
  EXPECT_FALSE(links().contains("arm_link_7_attached"));

  EXPECT_EQ(ask(answer("arm_link_7_attached", true))["state"], "runs");
  ASSERT_EQ(next()["state"], "found");
  EXPECT_EQ(ask({{"do", "take_calibration_data"}})["state"], "taken");
  save();
  EXPECT_TRUE(links().contains("arm_link_7_attached"));
  EXPECT_EQ(folder_.names(),
            (std::vector<std::string>{"new.attached.arm_link_7_attached.stl", "new.yaml"}));
  EXPECT_TRUE(open_scene(folder_ / "new.yaml").robot->model().find_link("arm_link_7_attached"));
}

TEST_F(CarryingViewedScene, WhatIsNoPartStaysAnObstacle) {
  ASSERT_EQ(question()["state"], "asks");
  // An answer to another question counts for nothing.
  viewed_.receive(answer("arm_link_6_attached", true).dump());
  EXPECT_EQ(ask(answer("arm_link_7_attached", false))["state"], "runs");
  EXPECT_EQ(next()["state"], "found");
  EXPECT_EQ(ask({{"do", "take_calibration_data"}})["state"], "taken");
  save();
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"new.yaml"});
  EXPECT_FALSE(links().contains("arm_link_7_attached"));
}

TEST_F(CarryingViewedScene, EndsWhileItAsks) {
  ASSERT_EQ(question()["state"], "asks");
  EXPECT_EQ(ask({{"do", "drop_calibration_data"}})["state"], "none");
  // It can begin anew, and the program can end.
  ASSERT_EQ(question()["state"], "asks");
}

TEST(MonitoredScene, TellsHowFastTheRobotMayGoAtEachStep) {
  const TemporaryFolder folder;
  fs::copy(BERTH_SOURCE_DIR "/data/bundled", folder.path(), fs::copy_options::recursive);
  // Slow people and a robot that brakes at once: it may go, but for a few frames.
  folder.write("scene.yaml", read_file_bytes(folder / "scene.yaml") +
                                 "separation: {human_speed_m_s: 0.1, reaction_time_s: 0.02, "
                                 "deceleration_m_s2: 20, intrusion_m: 0, camera_uncertainty_m: 0, "
                                 "not_seen: ignore, unknown: ignore, no_reading: ignore}\n");
  Messages messages;
  ViewedScene viewed(folder / "scene.yaml", folder.path(),
                     [&](const std::string& kind, PageMessage message) {
                       messages.take(kind, std::move(message));
                     });
  Json timeline = messages.after("timeline", 0);
  while (timeline["done"] != timeline["total"]) {
    timeline = messages.after("timeline", messages.count("timeline"));
  }
  const Json& scale = timeline["speed"]["scale"];
  const Json& state = timeline["speed"]["state"];
  ASSERT_EQ(scale.size(), timeline["stamps_s"].size());
  int clear = 0, reduced = 0, stop = 0;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    viewed.receive(Json({{"do", "show"}, {"step", i}}).dump());
    const Json separation = messages.shown_for_good(i)["result"]["separation"];
    EXPECT_EQ(separation["state"], state[i]);
    const auto said = separation["text"].get<std::string>();
    EXPECT_EQ(said.starts_with("clear"), scale[i] == 1) << said;
    EXPECT_EQ(said.starts_with("stop"), scale[i] == 0) << said;
    ++(scale[i] == 1 ? clear : scale[i] == 0 ? stop : reduced);
  }
  EXPECT_GT(clear, 0);
  EXPECT_GT(reduced, 0);
  EXPECT_GT(stop, 0);
  const Json groups = messages.json("settings")["groups"];
  EXPECT_EQ(groups.back()["name"], "separation");
}

TEST(ImplausibleScene, HasNoDistanceOnceThatIsKnown) {
  const TemporaryFolder folder;
  fs::copy(BERTH_SOURCE_DIR "/data/bundled", folder.path(), fs::copy_options::recursive);
  std::string text = read_file_bytes(folder / "one_camera.yaml");
  text.replace(text.find("depth_scale: 0.001"), 18, "depth_scale: 0.01");
  folder.write("one_camera.yaml", text);
  Messages messages;
  ViewedScene viewed(folder / "one_camera.yaml", folder.path(),
                     [&](const std::string& kind, PageMessage message) {
                       messages.take(kind, std::move(message));
                     });
  const Json shown = messages.shown_for_good();
  EXPECT_EQ(shown["result"]["status"], "stale");
  for (const Json& link : shown["result"]["links"]) EXPECT_TRUE(link["distance_m"].is_null());
  EXPECT_NE(messages.json("timeline")["error"], "");
  // The robot is to be seen all the same.
  EXPECT_FALSE(shown["links"].empty());
}

}  // namespace
}  // namespace berth::app
