#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "berth/results/result_json.hpp"
#include "berth/results/result_text.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

LinkResult link_without_distance(LinkId id, const std::string& name, LinkStatus status) {
  LinkResult link;
  link.id = id;
  link.link = name;
  link.status = status;
  link.lower_bound_m = link.occupied.lower_bound_m = kNaN;
  return link;
}

SpacePair pair_at(float distance_m, int camera) {
  SpacePair pair;
  pair.distance_m = distance_m;
  pair.lower_bound_m = distance_m - 0.0005F;
  pair.robot_point_B_m = {0.5F, 0, 1};
  pair.obstacle_point_B_m = {0.5F, distance_m, 1};
  pair.camera = camera;
  pair.obstacle_pixel = {340, 211};
  return pair;
}

/// Of two links and three cameras, the last of which has given no frame.
Result mesh_result() {
  Result result;
  result.status = ResultStatus::degraded;
  result.time = {};
  result.time.status = TimeStatus::ok;
  result.frame = 7;
  result.stamp_s = 0.25;
  result.joints_stamp_s = 0.5;
  result.range_m = 1.0;
  result.cameras.resize(3);
  for (int k = 0; k < 3; ++k) result.cameras[k].camera = k == 0 ? "left" : k == 1 ? "right" : "top";
  for (int k = 0; k < 2; ++k) {
    CameraResult& camera = result.cameras[k];
    static_cast<CameraState&>(camera) = {CameraStatus::ok, 0.25, 0, TimeStatus::ok, {}};
    camera.frame = 3 + k;
    camera.has_frame = true;
    camera.X_BC = Pose::Identity();
    camera.self_filter[0] = 10;
  }
  LinkResult link;
  link.id = 1;
  link.link = "link_1";
  link.status = LinkStatus::ok;
  static_cast<SpacePair&>(link) = pair_at(0.125F, 0);
  link.obstacle_is = ObstacleKind::unknown;
  link.occupied = pair_at(0.25F, 1);
  link.mean_direction_B = {0, 0, 0.5F};
  link.mean_count = 12;
  result.links = {link, link_without_distance(2, "link_2", LinkStatus::none_in_range)};
  result.links[1].lower_bound_m = result.links[1].occupied.lower_bound_m = 1;
  find_nearest(result);
  return result;
}

Json json_of(const Result& result) { return Json::parse(result_json(result)); }

std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST(ResultJson, IsOneLineInTheOrderOfTheSchema) {
  const std::string text = result_json(mesh_result());
  EXPECT_EQ(
      text,
      R"({"schema":"berth/result/3","frame":7,"stamp_s":0.25,"joints_stamp_s":0.5,"status":"degraded",)"
      R"("time":{"status":"ok","frame_age_s":null,"joints_age_s":null,"skew_s":null},)"
      R"("method":"mesh","range_m":1.0,"nearest":"link_1",)"
      R"("cameras":[{"camera":"left","frame":3,"stamp_s":0.25,"age_s":0.0,"status":"ok",)"
      R"("seen_through":null,"displacement_m":null,"at_robot":null,"unread_share":null,)"
      R"("self_filter":{"obstacle":10,"no_reading":0,"robot":0,"environment":0,"padding":0,)"
      R"("flying_patch":0,"outside_region":0,"soft":0,"speckle":0,)"
      R"("background":0,"hole":0}},)"
      R"({"camera":"right","frame":4,"stamp_s":0.25,"age_s":0.0,"status":"ok",)"
      R"("seen_through":null,"displacement_m":null,"at_robot":null,"unread_share":null,)"
      R"("self_filter":{"obstacle":10,"no_reading":0,"robot":0,"environment":0,"padding":0,)"
      R"("flying_patch":0,"outside_region":0,"soft":0,"speckle":0,)"
      R"("background":0,"hole":0}},)"
      R"({"camera":"top","frame":null,"stamp_s":null,"age_s":null,"status":"no_frame",)"
      R"("seen_through":null,"displacement_m":null,"at_robot":null,"unread_share":null,"self_filter":null}],)"
      R"("links":[{"id":1,"link":"link_1","is_moved":true,"status":"ok","distance_m":0.125,)"
      R"("lower_bound_m":0.1245,"robot_point_base_m":[0.5,0.0,1.0],)"
      R"("obstacle_point_base_m":[0.5,0.125,1.0],"camera":"left","obstacle_pixel":[340,211],)"
      R"("obstacle_is":"unknown","occupied":{"distance_m":0.25,"lower_bound_m":0.2495,)"
      R"("robot_point_base_m":[0.5,0.0,1.0],"obstacle_point_base_m":[0.5,0.25,1.0],)"
      R"("camera":"right","obstacle_pixel":[340,211]},)"
      R"("assumed_thinner_m":null,"mean_direction_base":[0.0,0.0,0.5],"mean_count":12},)"
      R"({"id":2,"link":"link_2","is_moved":true,"status":"none_in_range","distance_m":null,)"
      R"("lower_bound_m":1.0,"robot_point_base_m":null,"obstacle_point_base_m":null,)"
      R"("camera":null,"obstacle_pixel":null,"obstacle_is":null,)"
      R"("occupied":{"distance_m":null,"lower_bound_m":1.0,"robot_point_base_m":null,)"
      R"("obstacle_point_base_m":null,"camera":null,"obstacle_pixel":null},)"
      R"("assumed_thinner_m":null,"mean_direction_base":null,"mean_count":0}]})");
}

TEST(ResultJson, AWithheldResultHasNulls) {
  Result result = mesh_result();
  result.stamp_s = std::numeric_limits<double>::quiet_NaN();
  withhold(result);
  const Json json = json_of(result);
  EXPECT_EQ(json["status"], "stale");
  EXPECT_TRUE(json["stamp_s"].is_null());
  EXPECT_TRUE(json["nearest"].is_null());
  for (const Json& link : json["links"]) {
    EXPECT_EQ(link["status"], "stale");
    for (const char* key :
         {"distance_m", "lower_bound_m", "robot_point_base_m", "obstacle_point_base_m", "camera",
          "obstacle_pixel", "obstacle_is", "mean_direction_base"}) {
      ASSERT_TRUE(link.contains(key)) << key;
      EXPECT_TRUE(link[key].is_null()) << key;
    }
    for (const auto& [key, value] : link["occupied"].items()) EXPECT_TRUE(value.is_null()) << key;
  }
}

TEST(ResultJson, OneCameraHasItsPointsInItsOwnFrameToo) {
  Result result = mesh_result();
  EXPECT_FALSE(json_of(result)["links"][0].contains("robot_point_camera_m"));
  result.cameras.resize(1);
  result.links[0].occupied.camera = 0;
  result.links[0].robot_point_C_m = {0.5F, 0, 0.25F};
  const Json link = json_of(result)["links"][0];
  EXPECT_EQ(link["robot_point_camera_m"], (Json{0.5, 0, 0.25}));
  EXPECT_TRUE(link["obstacle_point_camera_m"].is_null());
}

TEST(ResultJson, ACameraSaysWhatIsWrongWithItsTime) {
  Result result = mesh_result();
  result.cameras[1].status = CameraStatus::stale;
  result.cameras[1].time = TimeStatus::skewed;
  result.cameras[0].status = CameraStatus::moved;
  result.cameras[0].watch.is_on = true;
  result.cameras[0].watch.seen_through = 0.125;
  result.cameras[0].watch.displacement_m = 0.0625;
  result.cameras[0].watch.at_robot = 0.5;
  const Json cameras = json_of(result)["cameras"];
  EXPECT_EQ(cameras[1]["status"], "skewed");
  EXPECT_EQ(cameras[0]["status"], "moved");
  EXPECT_EQ(cameras[0]["seen_through"], 0.125);
  EXPECT_EQ(cameras[0]["displacement_m"], 0.0625);
  EXPECT_EQ(cameras[0]["at_robot"], 0.5);
}

TEST(ResultJson, VisibilityIsToldWhereItWasAskedFor) {
  Result result = mesh_result();
  EXPECT_FALSE(json_of(result)["links"][0].contains("visibility"));
  result.has_visibility = true;
  LinkVisibility& visibility = result.links[0].visibility;
  visibility.surface = {0.41F, 0.02F, 0.5525F, 0.0175F, 0};
  visibility.space_unknown = 0.4F;
  visibility.rejected_distance_m = 0.0625F;
  visibility.rejected_pixel = {7, 8};
  const std::string text = result_json(result);
  EXPECT_NE(text.find(R"("mean_count":12,"visibility":{"surface":{"seen":0.41,)"
                      R"("hidden_by_obstacles":0.02,"hidden_by_robot":0.5525,"no_reading":0.0175,)"
                      R"("outside_image":0.0},"space":null,"space_unknown":0.4,)"
                      R"("rejected_distance_m":0.0625,"rejected_pixel":[7,8]}})"),
            std::string::npos)
      << text;
  const Json other = Json::parse(text)["links"][1]["visibility"];
  for (const auto& [key, value] : other.items()) EXPECT_TRUE(value.is_null()) << key;
}

TEST(ResultJson, AMonitorSaysHowFastTheRobotAndItsLinksMayGo) {
  Result result = mesh_result();
  EXPECT_FALSE(json_of(result).contains("separation"));
  EXPECT_FALSE(json_of(result)["links"][0].contains("separation"));
  result.links[1].is_moved = false;
  Separation& separation = result.separation.emplace();
  separation.state = SeparationState::reduced;
  separation.speed_scale = 0.5;
  separation.reason = SeparationReason::unknown;
  separation.link = 1;
  separation.reaction_time_s = 0.125;
  separation.links = {{1, true, 0.5, 0.25, 0.375, -0.125, 0.5, SeparationReason::unknown}, {}};
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(result_json(result));
  EXPECT_EQ(keys_of(json["separation"]),
            (std::vector<std::string>{"state", "speed_scale", "basis", "reason", "link", "camera",
                                      "reaction_time_s", "text"}));
  EXPECT_EQ(json["separation"]["reason"], "unknown");
  EXPECT_EQ(json["separation"]["link"], "link_1");
  EXPECT_TRUE(json["separation"]["camera"].is_null());
  EXPECT_EQ(json["links"][0]["separation"].dump(),
            R"({"speed_m_s":0.5,"distance_m":0.25,"required_m":0.375,"margin_m":-0.125,)"
            R"("speed_scale":0.5,"reason":"unknown"})");
  EXPECT_FALSE(json["links"][1].contains("separation")) << "no joint moves it";
  separation.reason = SeparationReason::camera;
  separation.camera = 2;
  separation.link = kNoLink;
  EXPECT_EQ(json_of(result)["separation"]["camera"], "top");
  EXPECT_TRUE(json_of(result)["separation"]["link"].is_null());
}

TEST(ResultJson, TimingComesLastUnderItsName) {
  Result result = mesh_result();
  EXPECT_FALSE(json_of(result).contains("timing"));
  result.timing = RequestTiming{50, 1.5, 2, 3, 4.25};
  const std::string timing =
      R"("timing":{"repeat":50,"ask_us":{"min":1.5,"p50":2.0,"p99":3.0,"max":4.25}}})";
  EXPECT_TRUE(result_json(result).ends_with(timing)) << result_json(result);
  result.timing_name = "evaluate_us";
  EXPECT_TRUE(json_of(result)["timing"].contains("evaluate_us"));
}

TEST(ResultJson, FloatsCanBeReadBackExactlyAndHaveFewDigits) {
  Result result = mesh_result();
  std::mt19937 random(7);
  constexpr int kFloats = 20'000;
  int longer_than_nine_digits = 0;
  for (int i = 0; i < kFloats; ++i) {
    const float value =
        std::ldexp(std::uniform_real_distribution<float>(1, 2)(random), i % 40 - 30);
    result.links[0].distance_m = value;
    const std::string text = result_json(result);
    const std::size_t begin = text.find("\"distance_m\":") + 13;
    std::string printed = text.substr(begin, text.find(',', begin) - begin);
    float again = 0;
    std::from_chars(printed.data(), printed.data() + printed.size(), again);
    ASSERT_EQ(again, value) << printed;
    printed = printed.substr(0, printed.find('e'));
    std::erase(printed, '.');
    printed.erase(0, printed.find_first_not_of('0'));
    longer_than_nine_digits += printed.size() > 9;
  }
  EXPECT_LT(longer_than_nine_digits, kFloats / 100);
}

TEST(ResultJson, NamesOfAnyLettersMakeValidJson) {
  Result result = mesh_result();
  result.links[1].link = "a \"b\"";
  EXPECT_EQ(json_of(result)["links"][1]["link"], "a \"b\"");
}

TEST(ResultTable, OfTheWholeRobotTellsWhatIsNearAndWhichCameraSaysSo) {
  EXPECT_EQ(result_table(mesh_result()),
            "link    status         distance [m]  nearest is  to occupied [m]  camera  obstacle "
            "pixel\n"
            "link_1  ok                   0.1250     unknown           0.2500    left      (340, "
            "211)\n"
            "link_2  none_in_range             -           -                -       -              "
            " -\n");
}

TEST(ResultTable, TellsWhatIsSeenAndWhatIsRejected) {
  Result result = mesh_result();
  result.has_visibility = true;
  result.links[0].visibility.surface = {0.41F, 0.02F, 0.5525F, 0.0175F, 0};
  EXPECT_EQ(result_table(result),
            "link    status         distance [m]  nearest is  to occupied [m]  camera  obstacle "
            "pixel  seen\n"
            "link_1  ok                   0.1250     unknown           0.2500    left      (340, "
            "211)  41 %\n"
            "link_2  none_in_range             -           -                -       -              "
            " -     -\n");
  result.links[1].visibility.rejected_distance_m = 0.0625F;
  EXPECT_EQ(result_table(result),
            "link    status         distance [m]  nearest is  to occupied [m]  camera  obstacle "
            "pixel  seen  rejected [m]\n"
            "link_1  ok                   0.1250     unknown           0.2500    left      (340, "
            "211)  41 %             -\n"
            "link_2  none_in_range             -           -                -       -              "
            " -     -        0.0625\n");
}

TEST(ResultTable, LinksThatNoJointMovesComeLast) {
  Result result = mesh_result();
  result.links[0].is_moved = false;
  const std::string table = result_table(result);
  EXPECT_LT(table.find("link_2"), table.find("link_1"));
}

}  // namespace
}  // namespace berth
