// The layout, the labels' places and the words of the picture.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "apps/berth/picture_layout.hpp"
#include "apps/berth/picture_legend.hpp"
#include "apps/berth/picture_pairs.hpp"
#include "apps/berth/picture_palette.hpp"
#include "apps/berth/picture_pixels.hpp"
#include "apps/berth/picture_text.hpp"

namespace berth::app {
namespace {

bool overlap(const BoxPx& a, const BoxPx& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

bool inside(const BoxPx& a, const BoxPx& b) {
  return a.x >= b.x && a.y >= b.y && a.x + a.width <= b.x + b.width &&
         a.y + a.height <= b.y + b.height;
}

PictureLayout layout_of(int width_px, int height_px, int links) {
  const DepthImage depth_m(width_px, height_px, 1.0F);
  const ObstacleImage obstacles{depth_m, Image<PixelFate>(width_px, height_px), {}, {}};
  PictureLink link;
  link.link = "a_name_of_usual_length";
  const std::vector<PictureLink> all(links, link);
  return layout_picture({depth_m, nullptr, &obstacles, &all, 1.0, ""});
}

TEST(PictureLayout, SmallImagesGrowByAWholeFactor) {
  EXPECT_EQ(layout_of(320, 240, 7).factor, 3);
  EXPECT_EQ(layout_of(640, 480, 7).factor, 2);
  EXPECT_EQ(layout_of(1280, 720, 7).factor, 1);
  EXPECT_EQ(layout_of(1920, 1080, 7).factor, 1);
}

TEST(PictureLayout, PartsStayWithinThePictureAndApart) {
  for (const auto& [width, height] : {std::pair{320, 240},
                                      {640, 480},
                                      {1280, 720},
                                      {1920, 1080},
                                      {16, 12},
                                      {2000, 50},
                                      {50, 2000}}) {
    for (const int links : {0, 1, 7, 12, 40, 82}) {
      const PictureLayout layout = layout_of(width, height, links);
      const BoxPx sheet{0, 0, double(layout.width_px), double(layout.height_px)};
      EXPECT_TRUE(inside(layout.image, sheet) && inside(layout.legend, sheet));
      EXPECT_FALSE(overlap(layout.image, layout.legend));
      EXPECT_LE(layout.table.shown, layout.table.rows * layout.table.columns);
      EXPECT_GE(layout.table.row_em * layout.em_px, 11);
    }
  }
}

TEST(PictureLayout, EveryLinkHasARowUpToForty) {
  for (const auto& [width, height] : {std::pair{320, 240}, {640, 480}, {1280, 720}, {1920, 1080}}) {
    for (const int links : {1, 7, 12, 25, 40})
      EXPECT_EQ(layout_of(width, height, links).table.shown, links) << width;
    EXPECT_LT(layout_of(width, height, 82).table.shown, 82);
    EXPECT_GE(layout_of(width, height, 82).table.shown, 30);
  }
}

TEST(PictureLayout, TheRegionsFateIsListedOnlyWhereAPixelHasIt) {
  ObstacleImage obstacles;
  const std::size_t without = shown_fates(obstacles).size();
  obstacles.count[static_cast<std::size_t>(PixelFate::outside_region)] = 1;
  ASSERT_EQ(shown_fates(obstacles).size(), without + 1);
  EXPECT_EQ(shown_fates(obstacles).back(), PixelFate::outside_region);
}

TEST(PictureLabels, NeverOverlapAndStayInBounds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> somewhere(0, 700);
  const BoxPx bounds{10, 20, 700, 500};
  std::vector<LabelRequest> requests(40);
  for (LabelRequest& request : requests)
    request = {{10 + somewhere(random), 20 + 0.7 * somewhere(random)}, 70, 22};
  const auto boxes = place_labels(requests, bounds, {});
  ASSERT_EQ(boxes.size(), requests.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ASSERT_TRUE(boxes[i]) << i;
    EXPECT_TRUE(inside(*boxes[i], bounds)) << i;
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(overlap(*boxes[i], *boxes[k])) << i << ", " << k;
  }
}

TEST(PictureLabels, OneWithoutRoomIsLeftOutAndTheFirstIsServed) {
  const std::vector<LabelRequest> requests(30, {{50, 50}, 60, 20});
  const auto boxes = place_labels(requests, {0, 0, 130, 100}, {});
  EXPECT_TRUE(boxes.front());
  EXPECT_FALSE(boxes.back());
}

TEST(PictureLabels, GoBesideWhatTheyShouldNotHide) {
  // A wall of points at the right: without it the first direction, to the right, is as good as any.
  std::vector<PointPx> wall;
  for (int y = 0; y < 400; y += 4) wall.push_back({240, double(y)});
  const LabelRequest label{{200, 200}, 80, 20};
  const BoxPx bounds{0, 0, 400, 400};
  const auto free = place_labels({label}, bounds, {}).front();
  const auto beside = place_labels({label}, bounds, wall).front();
  ASSERT_TRUE(free && beside);
  EXPECT_TRUE(overlap(*free, {240, 0, 0.1, 400}));
  EXPECT_FALSE(overlap(*beside, {240, 0, 0.1, 400}));
}

TEST(PictureText, DistanceOrReason) {
  LinkResult link;
  link.status = LinkStatus::ok;
  link.distance_m = 0.1374F;
  EXPECT_EQ(distance_text(link, 1), "0.137 m");
  link.distance_m = 0;
  EXPECT_EQ(distance_text(link, 1), "contact");
  EXPECT_TRUE(is_contact(link));
  link.obstacle_is = ObstacleKind::unknown;
  link.occupied.distance_m = 0.52F;
  EXPECT_EQ(distance_text(link, 1), "unknown 0 m, seen 0.520 m");
  EXPECT_FALSE(is_contact(link));
  link.occupied.distance_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(distance_text(link, 1), "unknown 0 m, nothing seen within 1.00 m");
  link.status = LinkStatus::none_in_range;
  EXPECT_EQ(distance_text(link, 1), "none within 1.00 m");
  EXPECT_EQ(distance_text(link, 0.125), "none within 0.125 m");
  link.status = LinkStatus::not_visible;
  EXPECT_EQ(distance_text(link, 1), "not visible");
}

/// A link that only unknown space touches: its distance is many words.
LinkResult touched_by_unknown(const std::string& name) {
  LinkResult link;
  link.link = name;
  link.status = LinkStatus::ok;
  link.distance_m = 0;
  link.obstacle_is = ObstacleKind::unknown;
  link.occupied.distance_m = 0.045F;
  return link;
}

TEST(PictureLegend, NameAndDistanceOfARowStandSideBySide) {
  const PictureCanvas canvas(1, 1, kBlack);
  const Font font{20};
  LinkResult near = touched_by_unknown("link_base");
  near.distance_m = 0.137F;
  const LinkResult none = [&] {
    LinkResult link = touched_by_unknown("link_base");
    link.occupied.distance_m = std::numeric_limits<float>::quiet_NaN();
    return link;
  }();
  for (const double name_em : {4.0, 5.0, 11.0}) {
    TablePlan plan;
    plan.name_em = name_em;
    plan.column_em = std::max(name_em + 10.4, 17.0);
    for (const LinkResult& link :
         {near, none, touched_by_unknown("a"), touched_by_unknown("a_name_that_is_long_indeed")}) {
      const LinkRow row = link_row(canvas, link, 1, plan, font, 20);
      EXPECT_LE(canvas.text_width_px(row.name, font) + canvas.text_width_px(row.distance, font),
                20 * (plan.column_em - 2))
          << row.name << " " << row.distance;
      EXPECT_EQ(row.has_bar, link.distance_m > 0);
    }
  }
  TablePlan plan;
  plan.name_em = 5;
  plan.column_em = 17;
  const LinkRow row = link_row(canvas, touched_by_unknown("link_base"), 1, plan, font, 20);
  EXPECT_EQ(row.name, "link_base");
  EXPECT_EQ(row.distance, "unknown 0 m");
}

TEST(PictureText, CountsAreGroupedByThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(PictureText, LongNamesKeepBothEnds) {
  const PictureCanvas canvas(1, 1, kBlack);
  const Font font{20, false};
  const std::string name = "r_gripper_motor_accelerometer_link";
  const std::string shorter = fit_text(canvas, name, font, 150);
  EXPECT_LE(canvas.text_width_px(shorter, font), 150);
  EXPECT_GE(canvas.text_width_px(shorter, font), 110);
  EXPECT_EQ(shorter.substr(0, 4), "r_gr");
  EXPECT_EQ(shorter.substr(shorter.size() - 4), "link");
  EXPECT_EQ(fit_text(canvas, name, font, 2000), name);
}

TEST(PictureText, NamesAreCutBetweenCodePoints) {
  PictureCanvas canvas(10, 10, kBlack);
  canvas.text({0, 5}, fit_text(canvas, "ääääääääääööööööööööüüüüüüüüüü", {10, false}, 60),
              {10, false}, kWhite);
  EXPECT_NO_THROW(canvas.png());
}

TEST(PictureTone, NearIsBrighterThanFarWhateverTheOutliers) {
  DepthImage depth_m(100, 100, 2.0F);
  for (int u = 0; u < 100; ++u) {
    for (int v = 0; v < 40; ++v) depth_m(u, v) = 1.0F;
  }
  depth_m(0, 0) = 60.0F;
  depth_m(1, 0) = 0.001F;
  depth_m(2, 0) = kNoDepth;
  const DepthTone tone = depth_tone(depth_m);
  EXPECT_FLOAT_EQ(tone.near_m, 1);
  EXPECT_FLOAT_EQ(tone.far_m, 2);
  EXPECT_GT(tone(1.0).r, tone(1.5).r + 20);
  EXPECT_GT(tone(1.5).r, tone(2.0).r + 20);
  EXPECT_EQ(tone(60.0), tone(2.0));
}

double linear(std::uint8_t value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// CIE L*a*b* of what an eye with the given response to linear RGB sees.
Eigen::Vector3d lab(Rgb color, const Eigen::Matrix3d& eye) {
  const Eigen::Vector3d rgb =
      (eye * Eigen::Vector3d(linear(color.r), linear(color.g), linear(color.b)))
          .cwiseMax(0)
          .cwiseMin(1);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f(Eigen::Vector3d(0.4124, 0.3576, 0.1805).dot(rgb) / 0.95047);
  const double y = f(Eigen::Vector3d(0.2126, 0.7152, 0.0722).dot(rgb));
  const double z = f(Eigen::Vector3d(0.0193, 0.1192, 0.9505).dot(rgb) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Machado, Oliveira and Fernandes (2009), severity 1.
std::vector<Eigen::Matrix3d> eyes() {
  std::vector<Eigen::Matrix3d> eyes(4);
  eyes[0].setIdentity();
  eyes[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;
  eyes[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;
  eyes[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
      0.303900;
  return eyes;
}

TEST(PicturePalette, TwelveLinksStayApartForEveryKindOfColourBlindness) {
  for (const Eigen::Matrix3d& eye : eyes()) {
    for (LinkId a = 1; a <= 12; ++a) {
      for (LinkId b = 1; b < a; ++b) {
        EXPECT_GT((lab(link_color(a), eye) - lab(link_color(b), eye)).norm(), 15) << a << ", " << b;
      }
    }
  }
}

TEST(PicturePalette, ThirtySixLinksHaveColoursOfTheirOwn) {
  std::set<std::tuple<int, int, int>> colors;
  for (LinkId id = 1; id <= 36; ++id) {
    const Rgb c = link_color(id);
    colors.insert({c.r, c.g, c.b});
  }
  EXPECT_EQ(colors.size(), 36U);
  EXPECT_EQ(link_color(37), link_color(1));
}

TEST(PicturePalette, NeighboursOfALongChainStayApart) {
  const Eigen::Matrix3d eye = eyes().front();
  for (LinkId id = 1; id < 82; ++id)
    EXPECT_GT((lab(link_color(id), eye) - lab(link_color(id + 1), eye)).norm(), 25) << id;
}

}  // namespace
}  // namespace berth::app
