#include "berth/live/raw_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Camera kCamera{3, 2, 100, 100, 1, 0.5};

/// Rows of three numbers, with `gap` bytes after each.
template <class T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& numbers, std::size_t gap) {
  const std::size_t row_bytes = 3 * sizeof(T) + gap;
  std::vector<std::uint8_t> bytes(numbers.size() / 3 * row_bytes, 0xEE);
  for (std::size_t v = 0; v < numbers.size() / 3; ++v) {
    std::memcpy(bytes.data() + v * row_bytes, numbers.data() + 3 * v, 3 * sizeof(T));
  }
  return bytes;
}

class RawImage : public ::testing::Test {
 protected:
  template <class T>
  RawDepth raw(const std::vector<T>& numbers, std::size_t gap = 0) {
    bytes_ = bytes_of(numbers, gap);
    return {bytes_, 3, 2, 3 * sizeof(T) + gap, sizeof(T) == 2 ? "16UC1" : "32FC1"};
  }
  std::vector<float> read(const RawDepth& image, const DepthUnits& units = {}) {
    read_raw_depth(image, kCamera, units, depth_m_);
    return depth_m_.pixels();
  }
  static void expect_same(const std::vector<float>& got, const std::vector<float>& expected) {
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      if (std::isnan(expected[i])) {
        EXPECT_TRUE(std::isnan(got[i])) << i << ": " << got[i];
      } else {
        EXPECT_FLOAT_EQ(got[i], expected[i]) << i;
      }
    }
  }
  static std::string refusal(const RawDepth& image) {
    return error_message<std::invalid_argument>([&] { validate(image, kCamera); });
  }

  std::vector<std::uint8_t> bytes_;
  DepthImage depth_m_;
};

const std::vector<std::uint16_t> kMillimetres{0, 1, 1000, 2500, 65534, 400};

TEST_F(RawImage, WholeNumbersAreUnits) {
  expect_same(read(raw(kMillimetres)), {kNoDepth, 0.001F, 1, 2.5F, 65.534F, 0.4F});
  expect_same(read(raw(kMillimetres), {.scale_m = 0.0001}),
              {kNoDepth, 0.0001F, 0.1F, 0.25F, 6.5534F, 0.04F});
  RawDepth mono = raw(kMillimetres);
  mono.encoding = "mono16";
  EXPECT_FLOAT_EQ(read(mono)[2], 1);
}

TEST_F(RawImage, FloatsAreMetresWhateverTheScale) {
  const std::vector<float> metres{kNoDepth, kInfinity, 0, -1, 1.25F, 0.5F};
  expect_same(read(raw(metres), {.scale_m = 0.01}),
              {kNoDepth, kNoDepth, kNoDepth, kNoDepth, 1.25F, 0.5F});
}

TEST_F(RawImage, RowsMayBeLongerThanTheirPixelsAndBeginAnywhere) {
  for (const std::size_t gap : {1, 2, 7, 64}) {
    expect_same(read(raw(kMillimetres, gap)), {kNoDepth, 0.001F, 1, 2.5F, 65.534F, 0.4F});
  }
  // The last row needs no gap.
  RawDepth image = raw(kMillimetres, 10);
  image.bytes = image.bytes.first(image.bytes.size() - 10);
  EXPECT_FLOAT_EQ(read(image)[5], 0.4F);
}

TEST_F(RawImage, OffsetAndLimitsHoldForBothEncodings) {
  const DepthUnits units{.offset_m = -0.1, .near_m = 0.3, .far_m = 2};
  expect_same(read(raw(kMillimetres), units), {kNoDepth, kNoDepth, 0.9F, kNoDepth, kNoDepth, 0.3F});
  expect_same(read(raw(std::vector<float>{0, kNoDepth, 1, 2.5F, kInfinity, 0.05F}), units),
              {kNoDepth, kNoDepth, 0.9F, kNoDepth, kNoDepth, kNoDepth});
  EXPECT_TRUE(std::isnan(read(raw(std::vector<float>{0, 0, 0, 0, 0, 0}), {.offset_m = 1})[0]))
      << "an offset makes no reading";
}

TEST_F(RawImage, WhatIsWrongIsNamed) {
  const auto changed = [&](auto change) {
    RawDepth image = raw(kMillimetres);
    change(image);
    return refusal(image);
  };
  expect_parts(changed([](RawDepth& i) { i.encoding = "rgb8"; }), {"rgb8", "16UC1 or 32FC1"});
  expect_parts(changed([](RawDepth& i) { i.is_bigendian = true; }),
               {"big-endian", "little-endian"});
  expect_parts(changed([](RawDepth& i) { i.width_px = 2; }), {"2 x 2", "camera_info", "3 x 2"});
  expect_parts(changed([](RawDepth& i) { i.row_bytes = 5; }), {"5 bytes", "at least 6"});
  expect_parts(changed([](RawDepth& i) { i.bytes = i.bytes.first(11); }), {"11 bytes", "12"});
}

class FilteredImage : public RawImage {
 protected:
  template <class T>
  std::vector<T> written(const RawDepth& image, const DepthUnits& units) {
    std::vector<std::uint8_t> out(image.bytes.size(), 0x11);
    write_raw_obstacles(image, kCamera, obstacles_, units, out);
    std::vector<T> numbers;
    for (int v = 0; v < 2; ++v) {
      for (int u = 0; u < 3; ++u) {
        T number;
        std::memcpy(&number, out.data() + v * image.row_bytes + u * sizeof(T), sizeof number);
        numbers.push_back(number);
      }
    }
    return numbers;
  }
  void set(int u, int v, PixelFate fate, float depth_m) {
    obstacles_.fate(u, v) = fate;
    obstacles_.depth_m(u, v) = depth_m;
  }
  /// Kept, robot, no reading; background twice, kept.
  FilteredImage() {
    obstacles_.fate.resize(3, 2, PixelFate::obstacle);
    obstacles_.depth_m.resize(3, 2, 1.0F);
    set(1, 0, PixelFate::robot, kNoDepth);
    set(2, 0, PixelFate::no_reading, kNoDepth);
    set(0, 1, PixelFate::background, 3.0F);
    set(1, 1, PixelFate::background, 0.7F);
  }

  ObstacleImage obstacles_;
};

TEST_F(FilteredImage, WhatIsKeptKeepsItsBits) {
  const std::vector<std::uint16_t> numbers{1234, 2000, 0, 900, 701, 65535};
  EXPECT_EQ(written<std::uint16_t>(raw(numbers, 5), {}),
            (std::vector<std::uint16_t>{1234, 0, 0, 3000, 700, 65535}));
  const std::vector<float> metres{1.2345678F, 2, kNoDepth, 0.9F, 0.701F, 7};
  const std::vector<float> out = written<float>(raw(metres, 4), {});
  expect_same(out, {1.2345678F, kNoDepth, kNoDepth, 3, 0.7F, 7});
  EXPECT_EQ(out[0], 1.2345678F);
}

TEST_F(FilteredImage, ItsDepthsAreInTheImagesOwnUnits) {
  const std::vector<std::uint16_t> numbers{1, 2, 0, 4, 5, 6};
  const auto out = written<std::uint16_t>(raw(numbers), {.scale_m = 0.01, .offset_m = 0.5});
  EXPECT_EQ(out[3], 250);
  EXPECT_EQ(out[4], 20);
}

TEST_F(FilteredImage, OtherSizesAreRefused) {
  const RawDepth image = raw(kMillimetres);
  std::vector<std::uint8_t> out(3);
  const auto write = [&] { write_raw_obstacles(image, kCamera, obstacles_, {}, out); };
  expect_parts(error_message<std::invalid_argument>(write), {"3 bytes", "12"});
  obstacles_.fate.resize(4, 2, PixelFate::robot);
  expect_parts(error_message<std::invalid_argument>(write), {"4 x 2", "3 x 2"});
}

}  // namespace
}  // namespace berth
