#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "berth/scene/result_json.hpp"
#include "berth/scene/result_table.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

LinkDistance ok_link() {
  LinkDistance link;
  link.id = 1;
  link.status = LinkStatus::ok;
  link.distance_m = 0.1234F;
  link.robot_pixel = {312, 200};
  link.obstacle_pixel = {340, 211};
  link.robot_point_C_m = {0.1F, -0.2F, 1.3F};
  link.obstacle_point_C_m = {0.25F, 0, 1.5F};
  link.mean_direction_C = {0, 0, 0.9F};
  link.mean_count = 5121;
  link.robot_pixels = 4012;
  return link;
}

LinkDistance link_without_distance(LinkId id, LinkStatus status, int robot_pixels) {
  LinkDistance link;
  link.id = id;
  link.status = status;
  link.robot_pixels = robot_pixels;
  return link;
}

class ResultText : public testing::Test {
 protected:
  ResultText() {
    distances.links = {ok_link(), link_without_distance(2, LinkStatus::none_in_range, 12),
                       link_without_distance(3, LinkStatus::not_visible, 0)};
    distances.pairs = 123456;
    result.cameras.resize(1);
    result.cameras[0].name = "camera";
    result.cameras[0].frame = 0;
    result.cameras[0].state = {CameraStatus::ok, 0.25, 0, TimeStatus::ok};
    result.method = "exact";
    result.range_m = 1.0;
    result.stamp_s = 0.25;
    result.link_names = {"link_1", "link_2", "a \"b\""};
    result.distances = &distances;
  }

  LinkDistances distances;
  FrameResult result;
};

TEST_F(ResultText, JsonIsOneLineInTheOrderOfTheSchema) {
  distances.links.resize(2);
  result.link_names.resize(2);
  EXPECT_EQ(
      result_json(result),
      R"({"schema":"berth/result/2","frame":0,"stamp_s":0.25,"camera":"camera","method":"exact","range_m":1.0,)"
      R"("cameras":[{"camera":"camera","frame":0,"stamp_s":0.25,"age_s":0.0,"status":"ok"}],)"
      R"("links":[{"id":1,"link":"link_1","status":"ok","distance_m":0.1234,"robot_pixel":[312,200],)"
      R"("obstacle_pixel":[340,211],"robot_point_m":[0.1,-0.2,1.3],"obstacle_point_m":[0.25,0.0,1.5],)"
      R"("mean_direction":[0.0,0.0,0.9],"mean_count":5121,"robot_pixels":4012},)"
      R"({"id":2,"link":"link_2","status":"none_in_range","distance_m":null,"robot_pixel":null,)"
      R"("obstacle_pixel":null,"robot_point_m":null,"obstacle_point_m":null,)"
      R"("mean_direction":null,"mean_count":0,"robot_pixels":12}],"pairs":123456})");
}

TEST_F(ResultText, ALinkThatIsNotOkHasNullsEvenWhereOldValuesWereLeftBehind) {
  distances.links[0].status = LinkStatus::not_visible;
  result.cameras[0].X_BC = Pose::Identity();
  const Json link = Json::parse(result_json(result))["links"][0];
  EXPECT_EQ(link["status"], "not_visible");
  for (const char* key :
       {"distance_m", "robot_pixel", "obstacle_pixel", "robot_point_m", "obstacle_point_m",
        "robot_point_base_m", "obstacle_point_base_m", "mean_direction"}) {
    ASSERT_TRUE(link.contains(key)) << key;
    EXPECT_TRUE(link[key].is_null()) << key;
  }
}

TEST_F(ResultText, WithoutCountThereIsNoMeanDirection) {
  distances.links[0].mean_count = 0;
  EXPECT_TRUE(Json::parse(result_json(result))["links"][0]["mean_direction"].is_null());
}

TEST_F(ResultText, PointsInTheBaseAreThoseOfTheCameraMoved) {
  EXPECT_FALSE(Json::parse(result_json(result))["links"][0].contains("robot_point_base_m"));
  result.cameras[0].X_BC = Pose(Eigen::Translation3d(1, 2, 3) *
                     Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()));
  const Json link = Json::parse(result_json(result))["links"][0];
  const std::vector<double> robot_B = link["robot_point_base_m"];
  const std::vector<double> obstacle_B = link["obstacle_point_base_m"];
  const std::vector<double> expected_robot_B = {1.2, 2.1, 4.3};
  const std::vector<double> expected_obstacle_B = {1, 2.25, 4.5};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(robot_B[i], expected_robot_B[i], 1e-6);
    EXPECT_NEAR(obstacle_B[i], expected_obstacle_B[i], 1e-6);
  }
}

TEST_F(ResultText, TimingAndFilterCountsAreToldWhereTheyAreGiven) {
  EXPECT_FALSE(Json::parse(result_json(result)).contains("timing"));
  EXPECT_FALSE(Json::parse(result_json(result)).contains("self_filter"));
  result.timing = AnswerTiming{50, 1.5, 2, 3, 4.25};
  result.cameras[0].self_filter = {10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22};
  const std::string text = result_json(result);
  EXPECT_TRUE(text.ends_with(
      R"("timing":{"repeat":50,"evaluate_us":{"min":1.5,"p50":2.0,"p99":3.0,"max":4.25}},)"
      R"("self_filter":{"obstacle":10,"no_reading":11,"robot":12,"environment":13,"padding":14,)"
      R"("dilation":15,"edge":16,"island":17,"outside_region":18,"speckle":19,"averaged":20,)"
      R"("background":21,"hole":22}})"))
      << text;
}

TEST_F(ResultText, LowerBoundsAreToldWhereASearchMayEndEarly) {
  distances.links[0].lower_bound_m = 0.12099F;
  distances.links[1].status = LinkStatus::cut_short;
  distances.links[1].lower_bound_m = 0.5F;
  EXPECT_FALSE(Json::parse(result_json(result))["links"][0].contains("lower_bound_m"));
  result.has_bounds = true;
  const Json links = Json::parse(result_json(result))["links"];
  EXPECT_EQ(links[0]["lower_bound_m"], 0.12099);
  EXPECT_EQ(links[1]["status"], "cut_short");
  EXPECT_EQ(links[1]["lower_bound_m"], 0.5);
  EXPECT_TRUE(links[1]["distance_m"].is_null());
  EXPECT_TRUE(links[2]["lower_bound_m"].is_null());
  EXPECT_EQ(result_table(result),
            "link    status           distance [m]  robot pixel  obstacle pixel  robot pixels\n"
            "link_1  ok           0.1209 to 0.1234   (312, 200)      (340, 211)          4012\n"
            "link_2  cut_short      0.5000 or more            -               -            12\n"
            "a \"b\"   not_visible                 -            -               -             0\n");
}

TEST_F(ResultText, VisibilityIsToldWhereItIsGiven) {
  EXPECT_FALSE(Json::parse(result_json(result))["links"][0].contains("visibility"));
  std::vector<LinkVisibility> visibility(3);
  visibility[0].surface = {0.41F, 0.02F, 0.5525F, 0.0175F, 0};
  visibility[0].space = {0.5F, 0.1F, 0.2F, 0.15F, 0.05F};
  visibility[0].space_unknown = 0.4F;
  visibility[1].surface = {0, 0, 0, 0, 1};
  result.visibility = &visibility;
  const std::string text = result_json(result);
  EXPECT_NE(
      text.find(
          R"("robot_pixels":4012,"visibility":{"surface":{"seen":0.41,"hidden_by_obstacles":0.02,)"
          R"("hidden_by_robot":0.5525,"no_reading":0.0175,"outside_image":0.0},)"
          R"("space":{"seen":0.5,"hidden_by_obstacles":0.1,"hidden_by_robot":0.2,)"
          R"("no_reading":0.15,"outside_image":0.05},"space_unknown":0.4,)"
          R"("doubtful_distance_m":null,"doubtful_pixel":null}})"),
      std::string::npos)
      << text;
  const Json links = Json::parse(text)["links"];
  EXPECT_EQ(links[1]["visibility"]["surface"]["outside_image"], 1);
  EXPECT_TRUE(links[1]["visibility"]["space"].is_null());
  EXPECT_TRUE(links[1]["visibility"]["space_unknown"].is_null());
  EXPECT_TRUE(links[2]["visibility"]["surface"].is_null());
  EXPECT_EQ(
      result_table(result),
      "link    status         distance [m]  robot pixel  obstacle pixel  robot pixels  seen\n"
      "link_1  ok                   0.1234   (312, 200)      (340, 211)          4012  41 %\n"
      "link_2  none_in_range             -            -               -            12   0 %\n"
      "a \"b\"   not_visible               -            -               -             0     -\n");
  visibility[1].doubtful_distance_m = 0.0625F;
  visibility[1].doubtful_pixel = {7, 8};
  const Json doubtful = Json::parse(result_json(result))["links"][1]["visibility"];
  EXPECT_EQ(doubtful["doubtful_distance_m"], 0.0625);
  EXPECT_EQ(doubtful["doubtful_pixel"], Json({7, 8}));
  EXPECT_EQ(
      result_table(result),
      "link    status         distance [m]  robot pixel  obstacle pixel  robot pixels  seen  "
      "doubtful [m]\n"
      "link_1  ok                   0.1234   (312, 200)      (340, 211)          4012  41 %  "
      "           -\n"
      "link_2  none_in_range             -            -               -            12   0 %  "
      "      0.0625\n"
      "a \"b\"   not_visible               -            -               -             0     -  "
      "           -\n");
}

TEST_F(ResultText, FloatsCanBeReadBackExactlyAndHaveFewDigits) {
  std::mt19937 random(7);
  constexpr int kFloats = 20'000;
  int longer_than_nine_digits = 0;
  for (int i = 0; i < kFloats; ++i) {
    const float value =
        std::ldexp(std::uniform_real_distribution<float>(1, 2)(random), i % 40 - 30);
    distances.links[0].distance_m = value;
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

TEST_F(ResultText, NamesOfAnyLettersMakeValidJson) {
  EXPECT_EQ(Json::parse(result_json(result))["links"][2]["link"], "a \"b\"");
}

TEST_F(ResultText, TableHasAlignedColumnsAndDashesForWhatIsNotKnown) {
  EXPECT_EQ(result_table(result),
            "link    status         distance [m]  robot pixel  obstacle pixel  robot pixels\n"
            "link_1  ok                   0.1234   (312, 200)      (340, 211)          4012\n"
            "link_2  none_in_range             -            -               -            12\n"
            "a \"b\"   not_visible               -            -               -             0\n");
}

}  // namespace
}  // namespace berth
