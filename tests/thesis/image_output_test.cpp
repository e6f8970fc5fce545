// What `berth evaluate` writes.
#include "thesis/image_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

LinkResult ok_link() {
  LinkResult link = link_without_distance(1, "link_1", LinkStatus::ok);
  link.distance_m = 0.1234F;
  link.camera = 0;
  link.obstacle_pixel = {340, 211};
  link.robot_point_C_m = {0.1F, -0.2F, 1.3F};
  link.obstacle_point_C_m = {0.25F, 0, 1.5F};
  link.robot_point_B_m = {1.2F, 2.1F, 4.3F};
  link.obstacle_point_B_m = {1, 2.25F, 4.5F};
  link.mean_direction_B = {0, 0, 0.9F};
  link.mean_count = 5121;
  return link;
}

/// Of three links, with one camera whose frame C is the base frame B turned
/// and moved.
ImageResult image_result() {
  ImageResult result;
  result.status = ResultStatus::ok;
  result.time.status = TimeStatus::ok;
  result.stamp_s = 0.25;
  result.range_m = 1.0;
  result.pairs = 123456;
  CameraResult& camera = result.cameras.emplace_back();
  static_cast<CameraState&>(camera) = {CameraStatus::ok, 0.25, 0, TimeStatus::ok, {}};
  camera.camera = "camera";
  camera.frame = 0;
  camera.X_BC = Pose(Eigen::Translation3d(1, 2, 3) *
                     Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()));
  result.links = {ok_link(), link_without_distance(2, "link_2", LinkStatus::none_in_range),
                  link_without_distance(3, "a \"b\"", LinkStatus::not_visible)};
  result.pairs_of = {{{312, 200}, 4012}, {{}, 12}, {{}, 0}};
  find_nearest(result);
  return result;
}

Json json_of(const ImageResult& result) { return Json::parse(image_result_json(result)); }

TEST(ImageJson, HasMethodPairsAndPixels) {
  const Json json = json_of(image_result());
  EXPECT_EQ(json["schema"], "berth/result/3");
  EXPECT_EQ(json["method"], "exact");
  EXPECT_EQ(json["pairs"], 123456);
  EXPECT_EQ(json["nearest"], "link_1");
  const Json link = json["links"][0];
  EXPECT_EQ(link["robot_pixel"], (Json{312, 200}));
  EXPECT_EQ(link["robot_pixels"], 4012);
  EXPECT_EQ(link["obstacle_pixel"], (Json{340, 211}));
  EXPECT_FLOAT_EQ(link["robot_point_camera_m"][2], 1.3F);
  EXPECT_FLOAT_EQ(link["robot_point_base_m"][2], 4.3F);
  EXPECT_FLOAT_EQ(link["mean_direction_base"][2], 0.9F);
  EXPECT_TRUE(json["links"][1]["robot_pixel"].is_null());
  EXPECT_EQ(json["links"][1]["robot_pixels"], 12);
}

TEST(ImageJson, TheRendererIsToldWhereThereIsOne) {
  ImageResult result = image_result();
  EXPECT_FALSE(json_of(result).contains("gl_renderer"));
  result.gl_renderer = "llvmpipe";
  EXPECT_EQ(json_of(result)["gl_renderer"], "llvmpipe");
}

TEST(ImageTable, HasAlignedColumnsAndDashesForWhatIsNotKnown) {
  EXPECT_EQ(image_result_table(image_result()),
            "link    status         distance [m]  robot pixel  obstacle pixel  robot pixels\n"
            "link_1  ok                   0.1234   (312, 200)      (340, 211)          4012\n"
            "link_2  none_in_range             -            -               -            12\n"
            "a \"b\"   not_visible               -            -               -             0\n");
}

TEST(ImageTable, TellsBoundsWhereASearchMayEndEarly) {
  ImageResult result = image_result();
  result.links[0].lower_bound_m = 0.12099F;
  result.links[1].status = LinkStatus::cut_short;
  result.links[1].lower_bound_m = 0.5F;
  result.has_bounds = true;
  EXPECT_EQ(image_result_table(result),
            "link    status           distance [m]  robot pixel  obstacle pixel  robot pixels\n"
            "link_1  ok           0.1209 to 0.1234   (312, 200)      (340, 211)          4012\n"
            "link_2  cut_short      0.5000 or more            -               -            12\n"
            "a \"b\"   not_visible                 -            -               -             0\n");
}

}  // namespace
}  // namespace berth
