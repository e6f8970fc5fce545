// What needs no running node: settings as parameters, camera_info, stamps, messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "berth/control/velocity_filter.hpp"
#include "camera_input.hpp"
#include "markers.hpp"
#include "result_messages.hpp"
#include "row_messages.hpp"
#include "setting_parameters.hpp"
#include "sliding_robot.hpp"
#include "speed_monitor.hpp"
#include "transforms.hpp"

namespace berth_ros {
namespace {

using berth_msgs::msg::LinkDistance;
using berth_msgs::msg::LinkDistances;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(StampClock, StampsComeBackToTheNanosecond) {
  StampClock clock;
  const rclcpp::Time first(1'700'000'000, 123'456'789);
  EXPECT_EQ(clock.seconds(first), 0);
  for (const std::int64_t ns : {1LL, -5LL, 987'654'321LL, 3'600'000'000'001LL}) {
    const rclcpp::Time stamp(first.nanoseconds() + ns);
    EXPECT_EQ(rclcpp::Time(clock.stamp(clock.seconds(stamp))).nanoseconds(), stamp.nanoseconds());
  }
  EXPECT_EQ(rclcpp::Time(clock.stamp(std::nan(""))).nanoseconds(), 0);
}

TEST(Parameters, EachSettingComesBack) {
  const auto there_and_back = [](const auto& settings) {
    for (const berth::SettingRef& setting : setting_refs(settings)) {
      const std::string name(setting.name);
      EXPECT_EQ(value_from(name, parameter_of(setting), setting), setting.value) << name;
      EXPECT_FALSE(descriptor_of(setting).description.empty()) << name;
    }
  };
  there_and_back(berth::SelfFilterSettings{});
  there_and_back(berth::SensorSettings{});
  there_and_back(berth::SpaceSettings{});
  there_and_back(berth::WatchSettings{});
  there_and_back(berth::DistanceSettings{});
  there_and_back(berth::TimeSettings{});
  there_and_back(berth::SeparationSettings{});
  there_and_back(berth::VelocityFilterSettings{});
}

TEST(Parameters, AnUnknownNameIsRefusedWithThoseThatThereAre) {
  const berth::SeparationSettings settings;
  const std::vector<berth::SettingRef> refs = setting_refs(settings);
  const auto camera = std::find_if(refs.begin(), refs.end(),
                                   [](const auto& setting) { return setting.name == "camera"; });
  const std::string why =
      error_of([&] { value_from("separation.camera", rclcpp::ParameterValue("stopp"), *camera); });
  EXPECT_NE(why.find("stopp"), std::string::npos);
  EXPECT_NE(why.find("one of stop, assume_range, ignore"), std::string::npos);
}

sensor_msgs::msg::CameraInfo info() {
  sensor_msgs::msg::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.k = {500.123456789, 0, 320, 0, 510, 240, 0, 0, 1};
  info.p = {400, 0, 300, 0, 0, 410, 220, 0, 0, 0, 1, 0};
  return info;
}

TEST(CameraInfo, PCountsAndWithoutItK) {
  for (const std::optional<bool> is_rectified : {std::optional<bool>(), std::optional(true)}) {
    EXPECT_EQ(camera_info_of(info(), is_rectified).camera.fx_px, 400);
    EXPECT_EQ(camera_info_of(info(), is_rectified).camera.cy_px, 220);
    auto without_p = info();
    without_p.p.fill(0);
    EXPECT_EQ(camera_info_of(without_p, is_rectified).camera.fx_px, 500.123456789);
    EXPECT_EQ(camera_info_of(without_p, is_rectified).camera.cy_px, 240);
  }
}

TEST(CameraInfo, OfImagesAsTheLensMadeThemKAndTheLensCount) {
  auto bent = info();
  bent.d = {0.1, -0.05, 0.001, 0.002, 0.03};
  const berth::CameraInfo camera = camera_info_of(bent, false);
  EXPECT_EQ(camera.camera.fx_px, 500.123456789);
  ASSERT_TRUE(camera.lens);
  EXPECT_EQ(camera.lens->coefficients[4], 0.03);
}

TEST(CameraInfo, APartOfTheSensorsPixelsHasItsOwnIntrinsics) {
  auto part = info();
  part.binning_x = part.binning_y = 2;
  part.roi.x_offset = 100;
  part.roi.width = 320;
  const berth::Camera camera = camera_info_of(part, {}).camera;
  EXPECT_EQ(camera.width_px, 160);
  EXPECT_EQ(camera.height_px, 240);
  EXPECT_EQ(camera.fx_px, 200);
  EXPECT_EQ(camera.cx_px, 100);
}

TEST(CameraInfo, WhatIsRefusedIsNamed) {
  const auto why = [](auto change, std::optional<bool> is_rectified = {}) {
    auto changed = info();
    change(changed);
    return error_of([&] { camera_info_of(changed, is_rectified); });
  };
  const auto distort = [](auto& i) { i.d = {0.1, 0, 0, 0, 0}; };
  EXPECT_NE(why(distort).find("camera_info:1: d[0]: 0.1"), std::string::npos) << why(distort);
  EXPECT_NE(why(distort).find("rectified: false"), std::string::npos);
  EXPECT_EQ(why(distort, true), "");
  EXPECT_EQ(why([](auto& i) { i.d = {0, 0, 0, 0, 0}; }), "");
  EXPECT_NE(why([](auto& i) { i.roi.x_offset = 600, i.roi.width = 100; }).find("roi"),
            std::string::npos);
  EXPECT_NE(why([](auto& i) { i.k[0] = i.p[0] = 0; }).find("p[0]"), std::string::npos);
  EXPECT_NE(why([](auto& i) { i.width = 0; }).find("width"), std::string::npos);
  EXPECT_NE(why([](auto& i) { i.p[0] = std::nan(""); }).find("p[0]"), std::string::npos);
}

TEST(Places, ATenthOfAMillimetreIsTheSame) {
  const berth::Pose a = berth::Pose::Identity();
  berth::Pose b = a;
  b.translation().x() += 0.00009;
  EXPECT_TRUE(is_same_place(a, b));
  b.translation().x() += 0.0001;
  EXPECT_FALSE(is_same_place(a, b));
  b = a;
  b.rotate(Eigen::AngleAxisd(0.001, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(is_same_place(a, b));
}

TEST(ImageRate, TellsHowManyOfThoseThatWereSentArrive) {
  ImageRate all, half, few, young;
  for (int i = 0; i < 400; ++i) {
    const double stamp_s = 1.7e9 + i / 30.0;
    all.add(stamp_s);
    if (i % 4 < 2) half.add(stamp_s);
    if (i % 10 < 2) few.add(stamp_s);
    if (i < 50) young.add(stamp_s);
  }
  EXPECT_NEAR(all.sent_hz(), 30, 0.1);
  EXPECT_EQ(all.trouble(), "");
  EXPECT_NEAR(half.sent_hz(), 30, 0.1);
  EXPECT_NEAR(half.arrived_hz(), 15, 0.5);
  EXPECT_NE(half.trouble().find("15 of 30 images a second arrive"), std::string::npos);
  EXPECT_NEAR(few.sent_hz(), 30, 0.1);
  EXPECT_NEAR(few.arrived_hz(), 6, 0.5);
  EXPECT_FALSE(young.is_known());
  EXPECT_EQ(young.trouble(), "");
}

TEST(ImageRate, TellsThatImagesAreDroppedForNewerOnes) {
  const berth::LiveCameraCounts before{.images = 100, .dropped = 5};
  EXPECT_EQ(overload_trouble(before, {.images = 130, .dropped = 5}), "");
  EXPECT_EQ(overload_trouble(before, {.images = 106, .dropped = 7}), "") << "a hiccup";
  EXPECT_EQ(overload_trouble(before, {.images = 190, .dropped = 14}), "") << "below a tenth";
  const std::string trouble = overload_trouble(before, {.images = 110, .dropped = 25});
  EXPECT_TRUE(trouble.starts_with("20 of 30 images were dropped")) << trouble;
}

TEST(ImageRate, AClockThatJumpsLosesNoImage) {
  ImageRate rate;
  double stamp_s = 1.7e9;
  for (int i = 0; i < 400; ++i) {
    // Forth alone: after a jump back it counts anew.
    stamp_s += i % 50 == 30 ? 0.45 : 0.05;
    rate.add(stamp_s);
    EXPECT_EQ(rate.trouble(), "") << i;
  }
  EXPECT_TRUE(rate.is_known());
}

berth::Result result() {
  berth::Result result;
  result.status = berth::ResultStatus::degraded;
  result.time.frame_age_s = 0.04;
  result.stamp_s = 2;
  result.joints_stamp_s = 2.5;
  result.range_m = 1;
  result.cameras.resize(2);
  result.cameras[0].camera = "left";
  result.cameras[1].camera = "right";
  result.cameras[1].status = berth::CameraStatus::ok;
  result.cameras[1].stamp_s = 2;
  berth::LinkResult& link = result.links.emplace_back();
  link.id = 1;
  link.link = "arm";
  link.status = berth::LinkStatus::ok;
  link.distance_m = 0.3F;
  link.lower_bound_m = 0.29F;
  link.robot_point_B_m = {1, 2, 3};
  link.obstacle_point_B_m = {1, 2, 3.3F};
  link.obstacle_is = berth::ObstacleKind::unknown;
  link.camera = 1;
  link.obstacle_pixel = {7, 8};
  link.occupied = link;
  link.occupied.distance_m = 0.5F;
  link.occupied.camera = 0;
  link.mean_direction_B = {0, 0, 0.9F};
  link.mean_count = 12;
  link.visibility.surface.seen = 0.6F;
  link.visibility.rejected_pixel = {3, 4};
  result.links.emplace_back().link = "hand";
  find_nearest(result);
  return result;
}

TEST(Result, EachFieldIsCopied) {
  StampClock clock;
  const rclcpp::Time first(100, 0);
  clock.seconds(first);
  LinkDistances out;
  to_message(result(), "table", rclcpp::Time(103, 0), clock, out);
  EXPECT_EQ(out.header.frame_id, "table");
  EXPECT_EQ(out.header.stamp.sec, 102);
  EXPECT_EQ(out.question_stamp.sec, 103);
  EXPECT_EQ(rclcpp::Time(out.joints_stamp).nanoseconds(), 102'500'000'000);
  EXPECT_EQ(out.status, LinkDistances::DEGRADED);
  EXPECT_EQ(out.time_status, LinkDistances::TIME_OK);
  EXPECT_EQ(out.frame_age_s, 0.04);
  EXPECT_EQ(out.nearest, "arm");
  ASSERT_EQ(out.cameras.size(), 2U);
  EXPECT_EQ(out.cameras[0].status, berth_msgs::msg::CameraState::NO_FRAME);
  EXPECT_EQ(out.cameras[0].stamp.sec, 0);
  EXPECT_EQ(out.cameras[1].stamp.sec, 102);
  ASSERT_EQ(out.links.size(), 2U);
  const LinkDistance& link = out.links[0];
  EXPECT_EQ(link.status, LinkDistance::OK);
  EXPECT_EQ(link.distance_m, 0.3F);
  EXPECT_EQ(link.lower_bound_m, 0.29F);
  EXPECT_EQ(link.robot_point_base_m.z, 3);
  EXPECT_EQ(link.obstacle_point_base_m.z, 3.3F);
  EXPECT_EQ(link.camera, "right");
  EXPECT_EQ(link.obstacle_pixel[1], 8);
  EXPECT_EQ(link.obstacle_is, LinkDistance::UNKNOWN);
  EXPECT_EQ(link.occupied.distance_m, 0.5F);
  EXPECT_EQ(link.occupied.camera, "left");
  EXPECT_EQ(link.mean_direction_base.z, 0.9F);
  EXPECT_EQ(link.mean_count, 12);
  EXPECT_EQ(link.visibility.surface.seen, 0.6F);
  EXPECT_EQ(link.visibility.rejected_pixel[0], 3);
  EXPECT_EQ(out.links[1].status, LinkDistance::STALE);
  EXPECT_EQ(out.links[1].camera, "");
  EXPECT_TRUE(std::isnan(out.links[1].distance_m));
  EXPECT_TRUE(std::isnan(out.links[1].robot_point_base_m.x));
}

TEST(Result, OfNoImageHasTheStampOfItsQuestion) {
  berth::Result none = result();
  none.stamp_s = none.joints_stamp_s = std::nan("");
  none.nearest = -1;
  LinkDistances out;
  to_message(none, "table", rclcpp::Time(103, 0), StampClock(), out);
  EXPECT_EQ(out.header.stamp.sec, 103);
  EXPECT_EQ(out.joints_stamp.sec, 0);
  EXPECT_EQ(out.nearest, "");
}

TEST(Result, OfNoRobotIsStale) {
  LinkDistances out;
  say_no_robot({"left", "right"}, rclcpp::Time(103, 0), out);
  EXPECT_EQ(out.status, LinkDistances::STALE);
  EXPECT_EQ(out.time_status, LinkDistances::TIME_NO_ROBOT);
  ASSERT_EQ(out.cameras.size(), 2U);
  EXPECT_EQ(out.cameras[1].camera, "right");
  EXPECT_EQ(out.header.stamp.sec, 103);
}

TEST(Rows, AreThoseOfTheLibraryRowByRow) {
  SlidingRobot sliding;
  sliding.put_near_hand(0.25F);
  berth::DistanceRows rows(sliding.robot);
  rows.update(sliding.result);
  LinkDistances distances;
  to_message(sliding.result, "base", rclcpp::Time(103, 0), StampClock(), distances);
  berth_msgs::msg::DistanceRows out;
  for (int again = 0; again < 2; ++again) {
    to_message(rows, sliding.robot->model().joints, distances, out);
    EXPECT_EQ(out.header.frame_id, "base");
    EXPECT_EQ(out.question_stamp.sec, 103);
    EXPECT_EQ(out.status, LinkDistances::OK);
    EXPECT_EQ(out.joints, (std::vector<std::string>{"slide", "turn"}));
    EXPECT_EQ(out.links, (std::vector<std::string>{"base", "arm", "hand"}));
    for (const auto* kind : {&out.nearest, &out.occupied, &out.known}) {
      ASSERT_EQ(kind->lower_bound_m.size(), 3U);
      ASSERT_EQ(kind->gradient.size(), 6U);
      ASSERT_EQ(kind->normal_base.size(), 9U);
      ASSERT_EQ(kind->reach_m.size(), 6U);
    }
    EXPECT_EQ(out.nearest.lower_bound_m[2], 0.25F);
    EXPECT_NEAR(out.nearest.gradient[4], -1, 1e-6) << "it slides towards what is near";
    EXPECT_NEAR(out.nearest.gradient[5], 0, 1e-6) << "its middle stays where it turns";
    EXPECT_NEAR(out.occupied.normal_base[7], -1, 1e-6);
    EXPECT_EQ(out.nearest.reach_m[2], 1) << "a slide moves the arm by as much";
    EXPECT_EQ(out.nearest.reach_m[3], 0) << "the arm does not turn";
    EXPECT_TRUE(std::isnan(out.nearest.gradient[2])) << "nothing is near the arm";
    EXPECT_TRUE(std::isnan(out.known.gradient[4]));
  }
}

LinkDistance link(const std::string& name, std::uint8_t status, float distance_m,
                  bool is_moved = true) {
  LinkDistance link;
  link.link = name;
  link.status = status;
  link.is_moved = is_moved;
  link.distance_m = status == LinkDistance::OK ? distance_m : kNaN;
  link.lower_bound_m = distance_m;
  return link;
}

berth_msgs::msg::Separation separation_of(const std::vector<LinkDistance>& links,
                                          const std::string& nearest = "",
                                          std::uint8_t status = LinkDistances::OK,
                                          bool may_be_degraded = false) {
  LinkDistances distances;
  distances.status = status;
  distances.links = links;
  distances.nearest = nearest;
  berth_msgs::msg::Separation out;
  to_message(distances, may_be_degraded, out);
  return out;
}

TEST(Separation, IsTheLeastBoundOfTheLinksThatMove) {
  const auto out = separation_of(
      {link("base", LinkDistance::OK, 0.0F, false), link("arm", LinkDistance::OK, 0.4F),
       link("hand", LinkDistance::OK, 0.3F), link("tool", LinkDistance::NONE_IN_RANGE, 1.0F)},
      "hand");
  EXPECT_TRUE(out.has_distance);
  EXPECT_FLOAT_EQ(out.distance_m, 0.3F);
  EXPECT_EQ(out.link, "hand");
}

TEST(Separation, HasTheRangeWhereNoLinkIsNearAnything) {
  const auto out = separation_of({link("base", LinkDistance::OK, 0.0F, false),
                                  link("arm", LinkDistance::NONE_IN_RANGE, 1.0F)});
  EXPECT_TRUE(out.has_distance);
  EXPECT_EQ(out.distance_m, 1.0F);
  EXPECT_EQ(out.link, "");
  EXPECT_EQ(out.link_status, LinkDistance::NONE_IN_RANGE);
}

TEST(Separation, WhatIsNotKnownIsNeverFar) {
  for (const std::uint8_t status : {LinkDistance::NOT_VISIBLE, LinkDistance::CUT_SHORT,
                                    LinkDistance::STALE, LinkDistance::NOT_SEEN}) {
    const auto out =
        separation_of({link("arm", LinkDistance::OK, 0.4F), link("hand", status, 0.5F)});
    EXPECT_FALSE(out.has_distance) << int{status};
    EXPECT_TRUE(std::isnan(out.distance_m));
    EXPECT_EQ(out.link, "hand");
    EXPECT_EQ(out.link_status, status);
  }
  EXPECT_FALSE(separation_of({}).has_distance);
  EXPECT_FALSE(separation_of({link("base", LinkDistance::OK, 1, false)}).has_distance);
  EXPECT_FALSE(separation_of({link("arm", LinkDistance::OK, kNaN)}).has_distance) << "no bound";
}

TEST(Separation, OfADegradedResultThereIsADistanceOnlyWhereThatIsWanted) {
  const std::vector<LinkDistance> links = {link("arm", LinkDistance::OK, 0.4F)};
  EXPECT_TRUE(separation_of(links, "arm", LinkDistances::OK).has_distance);
  const auto lost = separation_of(links, "arm", LinkDistances::DEGRADED);
  EXPECT_FALSE(lost.has_distance) << "it may be larger than with the camera that is lost";
  EXPECT_TRUE(std::isnan(lost.distance_m));
  EXPECT_TRUE(separation_of(links, "arm", LinkDistances::DEGRADED, true).has_distance);
}

TEST(PlannedVelocity, IsInTheRobotsOrderAndNotOld) {
  berth::RobotModel model;
  model.joints.resize(2);
  model.joints[0].name = "turn";
  model.joints[1].name = "lift";
  PlannedVelocity planned;
  EXPECT_FALSE(planned.is_there());
  sensor_msgs::msg::JointState message;
  message.name = {"lift", "other", "turn"};
  message.velocity = {0.5, 9, -0.2};
  planned.take(message, model, 3);
  EXPECT_TRUE(planned.is_there());
  EXPECT_EQ(planned.at(3.1, 0.15), (std::vector<double>{-0.2, 0.5}));
  EXPECT_TRUE(std::isnan(planned.at(3.2, 0.15)[0])) << "too old";
  message.name = {"lift"};
  planned.take(message, model, 4);
  EXPECT_TRUE(std::isnan(planned.at(4, 0.15)[0])) << "one is missing";
  EXPECT_EQ(planned.at(4, 0.15)[1], 0.5);
  message.velocity.clear();
  planned.take(message, model, 4);
  EXPECT_TRUE(std::isnan(planned.at(4, 0.15)[1])) << "a name without a velocity";
}

TEST(Separation, IsSaidToBeUnmonitoredOrAStop) {
  berth_msgs::msg::Separation out;
  out.speed_scale = 0.5;
  say_unmonitored(out);
  EXPECT_EQ(out.state, berth_msgs::msg::Separation::UNMONITORED);
  EXPECT_TRUE(std::isnan(out.speed_scale));
  say_stop("there is no robot model", out);
  EXPECT_EQ(out.state, berth_msgs::msg::Separation::STOP);
  EXPECT_EQ(out.speed_scale, 0);
  EXPECT_EQ(out.reason, "stale");
  EXPECT_EQ(out.text, "stop: there is no robot model");
}

TEST(Markers, EachDistanceHasALineItsEndsAndItsLength) {
  LinkDistances distances;
  distances.range_m = 1;
  distances.links = {link("near", LinkDistance::OK, 0.0F), link("none", LinkDistance::STALE, 0),
                     link("far", LinkDistance::OK, 1.0F)};
  const auto markers = markers_of(distances).markers;
  ASSERT_EQ(markers.size(), 1U + 2 * 3);
  EXPECT_EQ(markers[0].action, visualization_msgs::msg::Marker::DELETEALL);
  EXPECT_EQ(markers[1].color.r, 1);
  EXPECT_EQ(markers[1].color.g, 0);
  EXPECT_EQ(markers[4].color.r, 0);
  EXPECT_EQ(markers[4].color.g, 1);
  EXPECT_EQ(markers[6].text, "1.000 m");
}

}  // namespace
}  // namespace berth_ros
