#include "thesis/opengl/gl_images.hpp"

#include <random>

#include "tests/support/gl_test.hpp"

namespace berth {
namespace {

class GlImagesTest : public testing::GlTest {};

RobotImage noise(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  RobotImage image;
  image.depth_m.resize(width, height, kNoDepth);
  image.link_id.resize(width, height, kNoLink);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (random() % 3 == 0) continue;
      image.depth_m(u, v) = std::uniform_real_distribution<float>(0.01f, 30)(random);
      image.link_id(u, v) = random() % 5 == 0 ? kEnvironmentLink : 1 + random() % 64;
    }
  }
  return image;
}

void expect_same(const DepthImage& a, const DepthImage& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const bool both_none = std::isnan(a.pixels()[i]) && std::isnan(b.pixels()[i]);
    ASSERT_TRUE(both_none || a.pixels()[i] == b.pixels()[i]) << "pixel " << i;
  }
}

TEST_F(GlImagesTest, WhatIsSentComesBackUnchanged) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {101, 63}, {640, 480}}) {
    const RobotImage sent = noise(width, height, 3);
    const GlRobotImage on_gpu(width, height);
    GlUpload(width, height).send(sent, on_gpu);
    RobotImage got;
    read_back(on_gpu, got);
    expect_same(sent.depth_m, got.depth_m);
    EXPECT_EQ(sent.link_id.pixels(), got.link_id.pixels());
  }
}

TEST_F(GlImagesTest, OneUploadCarriesManyImages) {
  GlUpload upload(33, 20);
  const GlTexture first(GlPixel::depth_m, 33, 20);
  const GlTexture second(GlPixel::depth_m, 33, 20);
  const DepthImage a = noise(33, 20, 1).depth_m;
  const DepthImage b = noise(33, 20, 2).depth_m;
  upload.send(a, first);
  upload.send(b, second);
  DepthImage got;
  read_back(first, got);
  expect_same(a, got);
  read_back(second, got);
  expect_same(b, got);
}

TEST_F(GlImagesTest, APartOfALargerImageIsSentByItsStride) {
  const DepthImage whole = noise(40, 30, 5).depth_m;
  const DepthView part{whole.row(4) + 7, 20, 10, 40};
  const GlTexture texture(GlPixel::depth_m, 20, 10);
  GlUpload(20, 10).send(part, texture);
  DepthImage got;
  read_back(texture, got);
  for (int v = 0; v < 10; ++v) {
    for (int u = 0; u < 20; ++u) {
      const float expected_m = whole(u + 7, v + 4);
      EXPECT_TRUE(std::isnan(expected_m) ? std::isnan(got(u, v)) : got(u, v) == expected_m);
    }
  }
}

}  // namespace
}  // namespace berth
