#include "apps/berth/picture.hpp"

#include <cairo/cairo.h>
#include <gtest/gtest.h>

#include <cmath>

#include "apps/berth/picture_layout.hpp"
#include "apps/berth/picture_palette.hpp"
#include "berth/files/file_bytes.hpp"
#include "tests/apps/picture_scene.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::app {
namespace {

/// A picture as it lies in its file, asked at the sensor's pixels.
class Drawn {
 public:
  explicit Drawn(const PictureInput& input) : layout_(layout_picture(input)) {
    const TemporaryFolder folder;
    write_picture(folder / "frame.png", input);
    cairo_surface_t* surface = cairo_image_surface_create_from_png((folder / "frame.png").c_str());
    EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    pixels_.resize(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface),
                   {});
    const unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < pixels_.height(); ++y) {
      for (int x = 0; x < pixels_.width(); ++x) {
        const unsigned char* p = data + y * stride + 4 * x;
        pixels_(x, y) = {p[2], p[1], p[0]};
      }
    }
    cairo_surface_destroy(surface);
  }

  const PictureLayout& layout() const { return layout_; }
  const Image<Rgb>& pixels() const { return pixels_; }
  /// The colour in the middle of a sensor pixel.
  Rgb at(int u, int v) const {
    const PointPx p = layout_.centre({u, v});
    return pixels_(static_cast<int>(p.x), static_cast<int>(p.y));
  }

 private:
  PictureLayout layout_;
  Image<Rgb> pixels_;
};

/// The greatest difference of two colours' directions, 0 for the same hue and saturation.
double difference_of_hue(Rgb a, Rgb b) {
  const Eigen::Vector3d x(a.r, a.g, a.b), y(b.r, b.g, b.b);
  return (x.normalized() - y.normalized()).cwiseAbs().maxCoeff();
}

bool is_grey(Rgb c) { return c.r == c.g && c.g == c.b; }
bool is_dark(Rgb c) { return std::max({c.r, c.g, c.b}) < 64; }

bool all_neighbours(const Image<LinkId>& ids, int u, int v, LinkId id) {
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du)
      if (ids(u + du, v + dv) != id) return false;
  }
  return true;
}

/// One link before a wall; its closest pair is 20 pixels long.
struct OneLink {
  DepthImage sensor_depth_m{160, 120, 1.5F};
  std::vector<PictureLink> links;

  OneLink() {
    PictureLink& link = links.emplace_back();
    link.id = 1;
    link.link = "hand";
    link.status = LinkStatus::ok;
    link.distance_m = 0.25F;
    link.robot_pixel = {60, 60};
    link.obstacle_pixel = {80, 60};
  }
  PictureInput input() const { return {sensor_depth_m, nullptr, nullptr, &links, 1.0, ""}; }
  PictureInput without_distances() const {
    return {sensor_depth_m, nullptr, nullptr, nullptr, 1.0, ""};
  }
};

/// Sensor pixels that look different in the two pictures.
std::vector<Pixel> changed(const Drawn& a, const Drawn& b, const DepthView& sensor) {
  std::vector<Pixel> pixels;
  for (int v = 0; v < sensor.height; ++v) {
    for (int u = 0; u < sensor.width; ++u)
      if (a.at(u, v) != b.at(u, v)) pixels.push_back({u, v});
  }
  return pixels;
}

std::string message_of(const std::filesystem::path& path, const PictureInput& input) {
  return error_message([&] { write_picture(path, input); });
}

TEST(Picture, FileHasTheSizeOfItsLayout) {
  for (const auto& [width, height] : {std::pair{320, 240}, {640, 480}, {1280, 720}, {1920, 1080}}) {
    const DepthImage depth_m(width, height, 1.0F);
    const Drawn drawn({depth_m, nullptr, nullptr, nullptr, 1.0, "size"});
    EXPECT_EQ(drawn.pixels().width(), drawn.layout().width_px);
    EXPECT_EQ(drawn.pixels().height(), drawn.layout().height_px);
    EXPECT_EQ(drawn.layout().image.width, width * drawn.layout().factor);
  }
}

TEST(Picture, EveryPixelOfALinkHasThatLinksHue) {
  const PictureScene scene = make_picture_scene(320, 240, 7);
  PictureInput input = scene.input();
  input.links = nullptr;
  const Drawn drawn(input);
  std::vector<int> seen(8);
  for (int v = 1; v < 239; ++v) {
    for (int u = 1; u < 319; ++u) {
      const LinkId id = scene.robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink || !all_neighbours(scene.robot.link_id, u, v, id))
        continue;
      EXPECT_LT(difference_of_hue(drawn.at(u, v), link_color(id)), 0.02) << u << ", " << v;
      ++seen[id];
    }
  }
  for (int id = 1; id <= 6; ++id) EXPECT_GT(seen[id], 100) << id;
}

TEST(Picture, EachFateHasItsTintAndWhatIsKeptStaysGrey) {
  constexpr int kSide = 40;
  const DepthImage depth_m(kSide * kPixelFateCount, 60, 1.0F);
  ObstacleImage obstacles{depth_m, Image<PixelFate>(depth_m.width(), depth_m.height()), {}, {}};
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u)
      obstacles.fate(u, v) = static_cast<PixelFate>(u / kSide);
  }
  const Drawn drawn({depth_m, nullptr, &obstacles, nullptr, 1.0, ""});
  const auto color = [&](PixelFate fate) {
    return drawn.at(static_cast<int>(fate) * kSide + kSide / 2, 30);
  };
  EXPECT_TRUE(is_grey(color(PixelFate::obstacle)));
  EXPECT_TRUE(is_dark(color(PixelFate::no_reading)));
  for (int a = 0; a < kPixelFateCount; ++a) {
    const Rgb one = color(static_cast<PixelFate>(a));
    EXPECT_EQ(is_grey(one), static_cast<PixelFate>(a) == PixelFate::obstacle) << a;
    for (int b = 0; b < a; ++b)
      EXPECT_GT(difference_of_hue(one, color(static_cast<PixelFate>(b))), 0.03) << a << ", " << b;
  }
}

TEST(Picture, AnObstacleBeforeTheRobotCoversIt) {
  const DepthImage depth_m(80, 60, 1.0F);
  const RobotImage robot{DepthImage(80, 60, 2.0F), Image<LinkId>(80, 60, 1)};
  const ObstacleImage kept{depth_m, Image<PixelFate>(80, 60, PixelFate::obstacle), {}, {}};
  const ObstacleImage removed{depth_m, Image<PixelFate>(80, 60, PixelFate::robot), {}, {}};
  const Rgb before = Drawn({depth_m, &robot, &kept, nullptr, 1.0, ""}).at(40, 30);
  const Rgb robot_color = Drawn({depth_m, &robot, &removed, nullptr, 1.0, ""}).at(40, 30);
  EXPECT_EQ(robot_color, link_color(1));
  EXPECT_GT(before.b, robot_color.b + 80);
}

TEST(Picture, WithoutRobotAndObstaclesIsGreyDepth) {
  const PictureScene scene = make_picture_scene(320, 240, 7);
  const Drawn drawn({scene.sensor_depth_m, nullptr, nullptr, nullptr, 1.0, "depth only"});
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      const bool reading = !std::isnan(scene.sensor_depth_m(u, v));
      ASSERT_TRUE(reading ? is_grey(drawn.at(u, v)) : is_dark(drawn.at(u, v))) << u << ", " << v;
    }
  }
}

TEST(Picture, LineRunsFromTheRobotPixelToTheObstaclePixel) {
  const OneLink one;
  const Drawn drawn(one.input()), bare(one.without_distances());
  for (int u = 64; u <= 76; ++u) EXPECT_EQ(drawn.at(u, 60), link_color(1)) << u;
  for (const Pixel end : {Pixel{60, 60}, Pixel{80, 60}})
    EXPECT_NE(drawn.at(end.u, end.v + 1), bare.at(end.u, end.v + 1));
  EXPECT_EQ(drawn.at(54, 60), bare.at(54, 60));
  EXPECT_EQ(drawn.at(20, 100), bare.at(20, 100));
}

TEST(Picture, LinksWithoutDistanceDrawNothingOnTheImage) {
  for (const LinkStatus status : {LinkStatus::none_in_range, LinkStatus::not_visible}) {
    OneLink one;
    one.links[0].status = status;
    EXPECT_TRUE(
        changed(Drawn(one.input()), Drawn(one.without_distances()), one.sensor_depth_m).empty());
  }
}

TEST(Picture, ContactStandsOut) {
  OneLink one;
  one.links[0].distance_m = 0;
  one.links[0].obstacle_pixel = one.links[0].robot_pixel;
  const Drawn drawn(one.input()), bare(one.without_distances());
  // A ring around the place, beside the two ends.
  const PointPx centre = drawn.layout().centre({60, 60});
  const double radius_px = 0.95 * drawn.layout().em_px;
  for (const double angle : {2.0, 3.0, 4.0}) {
    const int x = static_cast<int>(centre.x + radius_px * std::cos(angle));
    const int y = static_cast<int>(centre.y + radius_px * std::sin(angle));
    EXPECT_EQ(drawn.pixels()(x, y), kWhite);
    EXPECT_NE(bare.pixels()(x, y), kWhite);
  }
}

TEST(Picture, ImagesWithoutReadingsOrWithoutDepthOfFieldCanBeDrawn) {
  for (const float depth_m : {kNoDepth, 1.0F}) {
    const DepthImage image(64, 48, depth_m);
    const Drawn drawn({image, nullptr, nullptr, nullptr, 1.0, ""});
    EXPECT_EQ(is_dark(drawn.at(32, 24)), std::isnan(depth_m));
  }
}

TEST(Picture, RowsMayHaveGapsBetweenThem) {
  const PictureScene scene = make_picture_scene(320, 240, 7);
  DepthImage wide(400, 240, kNoDepth);
  for (int v = 0; v < 240; ++v) std::copy_n(scene.sensor_depth_m.row(v), 320, wide.row(v));
  PictureInput input = scene.input();
  const Drawn plain(input);
  input.sensor_depth_m = {wide.row(0), 320, 240, 400};
  EXPECT_EQ(Drawn(input).pixels().pixels(), plain.pixels().pixels());
}

TEST(Picture, EightyTwoLinksCanBeDrawn) {
  const PictureScene scene = make_picture_scene(320, 240, 82);
  EXPECT_GT(Drawn(scene.input()).pixels().width(), 960);
}

TEST(PictureErrors, FileThatCannotBeWrittenIsNamedAndLeavesNothing) {
  const TemporaryFolder folder;
  const OneLink one;
  EXPECT_NE(message_of(folder / "missing/frame.png", one.input()).find("missing/frame.png"),
            std::string::npos);
  std::filesystem::create_directory(folder / "taken.png");
  EXPECT_NE(message_of(folder / "taken.png", one.input()).find("taken.png"), std::string::npos);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"taken.png"});
}

TEST(PictureErrors, TextThatIsNotUtf8LeavesTheFileBefore) {
  const TemporaryFolder folder;
  const OneLink one;
  PictureInput input = one.input();
  input.title = "\xC3(";
  const auto file = folder.write("frame.png", "before");
  EXPECT_NE(message_of(file, input).find("UTF-8"), std::string::npos);
  EXPECT_EQ(read_file_bytes(file), "before");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"frame.png"});
}

TEST(PictureErrors, InputsThatDoNotFitTogetherAreRefused) {
  const TemporaryFolder folder;
  const auto refuses = [&](const PictureInput& input, const std::string& reason) {
    EXPECT_NE(message_of(folder / "frame.png", input).find(reason), std::string::npos) << reason;
  };
  OneLink one;
  refuses({}, "no pixels");
  const RobotImage robot{DepthImage(160, 120), Image<LinkId>(80, 60)};
  PictureInput input = one.input();
  input.robot = &robot;
  refuses(input, "80x60, expected the sensor's 160x120");
  input = one.input();
  input.range_m = 0;
  refuses(input, "range");
  one.links[0].obstacle_pixel = {160, 0};
  refuses(one.input(), "(160, 0)");
  one.links[0].id = 3;
  refuses(one.input(), "id 3");
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace berth::app
