#include "berth/files/png.hpp"

#include <gtest/gtest.h>
#include <spng.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>

#include "berth/files/depth_units.hpp"
#include "berth/files/file_bytes.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Camera camera_of(int width_px, int height_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  return camera;
}

/// A PNG of any pixel format, all its samples 0, by the library itself.
std::string png_bytes(int width, int height, int bit_depth, int color_type) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(SPNG_CTX_ENCODER),
                                                                    &spng_ctx_free);
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = static_cast<std::uint8_t>(bit_depth);
  header.color_type = static_cast<std::uint8_t>(color_type);
  spng_set_ihdr(context.get(), &header);
  spng_plte palette{};
  palette.n_entries = 1;
  if (color_type == SPNG_COLOR_TYPE_INDEXED) spng_set_plte(context.get(), &palette);
  std::size_t size = 0;
  int code = 0;
  const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * height * 8);
  for (size = pixels.size(); size > 0; --size) {
    code =
        spng_encode_image(context.get(), pixels.data(), size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
    if (code != SPNG_EBUFSIZ) break;
  }
  EXPECT_EQ(code, 0);
  const std::unique_ptr<void, decltype(&std::free)> buffer(
      spng_get_png_buffer(context.get(), &size, &code), &std::free);
  return {static_cast<const char*>(buffer.get()), size};
}

TEST(DepthPng, EveryUnitComesBackAsItself) {
  const TemporaryFolder folder;
  const Camera camera = camera_of(256, 256);
  for (const double scale_m : {0.001, 0.0001, 1.0 / 5000, 0.01}) {
    DepthImage depth_m(256, 256, kNoDepth);
    for (int i = 1; i < 65536; ++i) depth_m.pixels()[i] = static_cast<float>(i * scale_m);
    write_depth_png(folder / "depth.png", depth_m, scale_m);
    const DepthImage again_m = read_depth_png(folder / "depth.png", camera, scale_m);
    EXPECT_TRUE(std::isnan(again_m.pixels()[0]));
    for (int i = 1; i < 65535; ++i) {
      const float z_m = depth_m.pixels()[i];
      const float expected_m = z_m < kMostReading_m ? z_m : kNoDepth;
      ASSERT_EQ(std::isnan(again_m.pixels()[i]), std::isnan(expected_m)) << i;
      ASSERT_FALSE(again_m.pixels()[i] != expected_m && !std::isnan(expected_m)) << i;
    }
  }
}

TEST(DepthPng, DepthsAreRoundedToTheNearestUnit) {
  const TemporaryFolder folder;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> depths_m(0.001F, 65.5F);
  DepthImage depth_m(40, 30);
  for (float& z_m : depth_m.pixels()) z_m = depths_m(random);
  write_depth_png(folder / "depth.png", depth_m, 0.001);
  const DepthImage again_m = read_depth_png(folder / "depth.png", camera_of(40, 30), 0.001);
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    EXPECT_NEAR(again_m.pixels()[i], depth_m.pixels()[i], 0.000505);
  }
}

TEST(DepthPng, AnObstacleIsNeverWrittenAsNoReadingAndNeverFartherThanTheFormatReaches) {
  const TemporaryFolder folder;
  DepthImage depth_m(5, 1, kNoDepth);
  depth_m(0, 0) = 0.0001F;
  depth_m(1, 0) = 65.5351F;
  depth_m(2, 0) = 1000;
  depth_m(3, 0) = kInfinity;
  write_depth_png(folder / "depth.png", depth_m, 0.001);
  const DepthImage again_m = read_depth_png(folder / "depth.png", camera_of(5, 1), 0.001);
  EXPECT_EQ(again_m(0, 0), 0.001F);
  for (const int u : {1, 2, 3}) EXPECT_EQ(again_m(u, 0), 65.534F);
  EXPECT_TRUE(std::isnan(again_m(4, 0)));
}

TEST(DepthPng, TheGreatestNumberIsNoReadingWhateverItsUnit) {
  const TemporaryFolder folder;
  write_gray_png(folder / "depth.png", Image<std::uint16_t>(2, 1, 65535), 16);
  for (const double scale_m : {0.001, 0.0001, 0.1}) {
    const DepthImage read_m = read_depth_png(folder / "depth.png", camera_of(2, 1), scale_m);
    EXPECT_TRUE(std::isnan(read_m(0, 0))) << scale_m;
  }
}

TEST(DepthPng, WhatIsNoPngIsNamed) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> table = {
      {"\x93NUMPY\x01", "is a NumPy array; expected a 16-bit PNG file; Python's berth.io"},
      {"\xFF\xD8\xFF", "is a JPEG image"},
      {std::string("II*\0", 4), "is a TIFF image"},
      {"something", "is no PNG file"},
      {"version https://git-lfs.github.com/spec/v1\noid", "is a pointer of Git LFS"}};
  for (const auto& [bytes, what] : table) {
    const auto file = folder.write("depth.png", bytes);
    expect_parts(error_message([&, &file = file] { read_depth_png(file, camera_of(2, 1), 0.001); }),
                 {"depth.png: ", what});
  }
}

TEST(DepthPng, DepthsOutsideNearAndFarAreNoReading) {
  const TemporaryFolder folder;
  DepthImage depth_m(4, 1);
  for (int u = 0; u < 4; ++u) depth_m(u, 0) = 0.3F + 0.1F * static_cast<float>(u);
  write_depth_png(folder / "depth.png", depth_m, 0.001);
  const DepthImage kept_m = read_depth_png(folder / "depth.png", camera_of(4, 1), 0.001, 0.4, 0.5);
  EXPECT_TRUE(std::isnan(kept_m(0, 0)));
  EXPECT_EQ(kept_m(1, 0), 0.4F);
  EXPECT_EQ(kept_m(2, 0), 0.5F);
  EXPECT_TRUE(std::isnan(kept_m(3, 0)));
}

/// Near and far hold for what the offset gives; a reading that it takes to 0 or below is none.
TEST(DepthPng, AnOffsetIsAddedToReadingsBeforeNearAndFar) {
  const TemporaryFolder folder;
  DepthImage depth_m(6, 1, kNoDepth);
  for (int u = 0; u < 5; ++u) depth_m(u, 0) = 0.1F * static_cast<float>(u + 1);
  write_depth_png(folder / "depth.png", depth_m, 0.001);
  const auto read_with = [&](double near_m, double far_m, double offset_m) {
    return read_depth_png(folder / "depth.png", camera_of(6, 1), 0.001, near_m, far_m, offset_m);
  };
  const DepthImage nearer_m = read_with(0, kInfinity, -0.2);
  EXPECT_TRUE(std::isnan(nearer_m(0, 0)));
  EXPECT_TRUE(std::isnan(nearer_m(1, 0)));
  EXPECT_FLOAT_EQ(nearer_m(2, 0), 0.1F);
  EXPECT_TRUE(std::isnan(nearer_m(5, 0)));
  const DepthImage kept_m = read_with(0.25, 0.45, 0.1);
  EXPECT_TRUE(std::isnan(kept_m(0, 0)));
  EXPECT_FLOAT_EQ(kept_m(1, 0), 0.3F);
  EXPECT_FLOAT_EQ(kept_m(2, 0), 0.4F);
  EXPECT_TRUE(std::isnan(kept_m(3, 0)));
  EXPECT_TRUE(std::isnan(kept_m(5, 0)));
}

TEST(DepthPng, AViewWithGapsBetweenItsRowsIsWrittenWithoutThem) {
  const TemporaryFolder folder;
  DepthImage depth_m(4, 3, 9.0F);
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 2; ++u) depth_m(u, v) = static_cast<float>(1 + u + 2 * v);
  }
  write_depth_png(folder / "depth.png", DepthView{depth_m.row(0), 2, 3, 4}, 0.001);
  const DepthImage again_m = read_depth_png(folder / "depth.png", camera_of(2, 3), 0.001);
  EXPECT_EQ(again_m.pixels(), (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

TEST(LinkIdsPng, IdsComeBackAndTakeEightBitsWhereTheyCan) {
  const TemporaryFolder folder;
  for (const LinkId largest : {LinkId{255}, LinkId{256}, kEnvironmentLink}) {
    Image<LinkId> ids(3, 2, kNoLink);
    ids(1, 0) = 7;
    ids(2, 1) = largest;
    write_link_ids_png(folder / "ids.png", ids);
    EXPECT_EQ(read_link_ids_png(folder / "ids.png", camera_of(3, 2)).pixels(), ids.pixels());
    EXPECT_EQ(read_file_bytes(folder / "ids.png")[24], largest <= 255 ? 8 : 16);
  }
}

TEST(Png, AnotherPixelFormatIsRefusedByName) {
  const TemporaryFolder folder;
  const Camera camera = camera_of(3, 2);
  struct Case {
    int bit_depth;
    int color_type;
    std::string found;
    bool fits_ids;
  };
  for (const Case& c :
       {Case{8, SPNG_COLOR_TYPE_GRAYSCALE, "8-bit grayscale;", true},
        {1, SPNG_COLOR_TYPE_GRAYSCALE, "1-bit grayscale;", false},
        {8, SPNG_COLOR_TYPE_TRUECOLOR, "8-bit RGB;", false},
        {16, SPNG_COLOR_TYPE_TRUECOLOR, "16-bit RGB;", false},
        {8, SPNG_COLOR_TYPE_INDEXED, "8-bit palette;", false},
        {16, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, "16-bit grayscale with alpha;", false},
        {16, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, "16-bit RGB with alpha;", false}}) {
    const auto file = folder.write("x.png", png_bytes(3, 2, c.bit_depth, c.color_type));
    expect_parts(error_message([&] { read_depth_png(file, camera, 0.001); }),
                 {"x.png: " + c.found + " expected 16-bit grayscale"});
    const std::string message = error_message([&] { read_link_ids_png(file, camera); });
    if (c.fits_ids) {
      EXPECT_EQ(message, "");
    } else {
      expect_parts(message, {"x.png: " + c.found + " expected 8- or 16-bit grayscale"});
    }
  }
}

TEST(Png, AnotherSizeThanTheCamerasIsRefused) {
  const TemporaryFolder folder;
  write_depth_png(folder / "x.png", DepthImage(3, 2, 1.0F), 0.001);
  for (const Camera& camera : {camera_of(3, 3), camera_of(2, 2), camera_of(2, 3)}) {
    expect_parts(error_message([&] { read_depth_png(folder / "x.png", camera, 0.001); }),
                 {"x.png: 3 x 2 pixels; expected "});
  }
}

TEST(Png, MissingEmptyAndForeignFilesAreRefused) {
  const TemporaryFolder folder;
  const Camera camera = camera_of(3, 2);
  folder.write("empty.png", "");
  folder.write("text.png", "this is no image, only a text of some length");
  for (const std::string name : {"none.png", "empty.png", "text.png"}) {
    expect_parts(error_message([&] { read_depth_png(folder / name, camera, 0.001); }),
                 {name + ": ", "; expected a "});
    expect_parts(error_message([&] { read_link_ids_png(folder / name, camera); }),
                 {name + ": ", "; expected a "});
  }
}

TEST(Png, AFileCutAnywhereIsRefused) {
  const TemporaryFolder folder;
  DepthImage depth_m(16, 8);
  for (int i = 0; i < 128; ++i)
    depth_m.pixels()[i] = 1.0F + 0.037F * static_cast<float>(i * i % 97);
  write_depth_png(folder / "whole.png", depth_m, 0.001);
  const std::string whole = read_file_bytes(folder / "whole.png");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto file = folder.write("cut.png", whole.substr(0, size));
    const std::string message =
        error_message([&] { read_depth_png(file, camera_of(16, 8), 0.001); });
    ASSERT_NE(message.find("cut.png: "), std::string::npos) << size << " of " << whole.size();
  }
}

TEST(Png, AChangedByteAnywhereIsFound) {
  const TemporaryFolder folder;
  DepthImage depth_m(16, 8, 1.5F);
  depth_m(3, 3) = 2;
  write_depth_png(folder / "whole.png", depth_m, 0.001);
  const std::string whole = read_file_bytes(folder / "whole.png");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x10);
    const auto file = folder.write("changed.png", bytes);
    const std::string message =
        error_message([&] { read_depth_png(file, camera_of(16, 8), 0.001); });
    ASSERT_NE(message.find("changed.png: "), std::string::npos) << i << " of " << whole.size();
  }
}

TEST(Png, ABadScaleIsRefused) {
  const TemporaryFolder folder;
  const DepthImage depth_m(3, 2, 1.0F);
  write_depth_png(folder / "x.png", depth_m, 0.001);
  for (const double scale_m :
       {0.0, -0.001, 9e-7, 0.2, 1000.0, static_cast<double>(kInfinity), std::nan("")}) {
    expect_parts(error_message([&] { read_depth_png(folder / "x.png", camera_of(3, 2), scale_m); }),
                 {"x.png: depth scale: ", "expected metres per unit from 1e-6 to 0.1"});
    expect_parts(error_message([&] { write_depth_png(folder / "y.png", depth_m, scale_m); }),
                 {"y.png: depth scale: "});
  }
}

TEST(Png, AFailedWriteLeavesNoFile) {
  const TemporaryFolder folder;
  expect_parts(error_message([&] { write_depth_png(folder / "x.png", DepthImage(), 0.001); }),
               {"x.png: "});
  expect_parts(error_message([&] { write_link_ids_png(folder / "no/x.png", Image<LinkId>(2, 2)); }),
               {"no/x.png: cannot be written"});
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace berth
