#include "thesis/opengl/gl_context.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

#include "tests/support/error_message.hpp"
#include "tests/support/gl_test.hpp"
#include "tests/support/temporary_folder.hpp"
#include "thesis/opengl/gl_buffer.hpp"
#include "thesis/opengl/gl_images.hpp"
#include "thesis/opengl/gl_program.hpp"
#include "thesis/opengl/shader_source.hpp"

namespace berth {
namespace {

class GlContextTest : public testing::GlTest {};

std::string message_of(std::string_view device) {
  return error_message<GlUnavailable>([&] { GlContext context(device); });
}

TEST_F(GlContextTest, DevicesAreFoundByNumberAndByPartOfTheirName) {
  const std::vector<std::string> devices = gl_devices();
  ASSERT_FALSE(devices.empty());
  EXPECT_EQ(GlContext("0").renderer(), devices[0]);
  EXPECT_EQ(GlContext(devices[0].substr(1, 5)).renderer(), devices[0]);
  context().make_current();
}

TEST_F(GlContextTest, MesasRendererIsSoftwareAndAGpuIsNot) {
  const bool is_mesas = context().renderer().find("llvmpipe") != std::string::npos;
  EXPECT_EQ(context().is_software(), is_mesas) << context().renderer();
}

TEST_F(GlContextTest, AnUnknownDeviceIsRefusedWithTheNamesThatThereAre) {
  const std::string message = message_of("no such GPU");
  EXPECT_NE(message.find("\"no such GPU\""), std::string::npos) << message;
  EXPECT_NE(message.find("0 (" + gl_devices()[0]), std::string::npos) << message;
  EXPECT_NE(message_of("77").find("\"77\""), std::string::npos);
  context().make_current();
}

TEST_F(GlContextTest, AFailedCallIsReportedOnceWithItsPlace) {
  GlBuffer buffer(16, GlMemory::device);
  buffer.copy_to(buffer, 1000);
  expect_parts(error_message([&] { context().check("copying"); }), {"copying", "GL_INVALID_VALUE"});
  context().check("afterwards");
}

class GlProgramTest : public testing::GlTest {};

TEST_F(GlProgramTest, AnInputThatIsNotSetIsNamedWhenTheProgramRuns) {
  GlProgram program("obstacle_tiles.comp.glsl");
  const GlBuffer tiles(1024, GlMemory::device);
  program.bind("ObstacleTiles", tiles);
  EXPECT_EQ(error_message<std::logic_error>([&] { program.dispatch(1); }),
            "shader obstacle_tiles.comp.glsl: input \"obstacle_depth_m\" is not set");
}

TEST_F(GlProgramTest, AnInputThatTheShaderDoesNotDeclareIsRefused) {
  GlProgram program("obstacle_tiles.comp.glsl");
  EXPECT_EQ(error_message<std::logic_error>([&] { program.set("no_such_uniform", 1.0f); }),
            "shader obstacle_tiles.comp.glsl has no input \"no_such_uniform\" of this type");
}

TEST_F(GlProgramTest, AnInputOfAnotherTypeIsRefused) {
  GlProgram program("exact_first.comp.glsl");
  EXPECT_EQ(error_message<std::logic_error>([&] { program.set("tiles", 1.0f); }),
            "shader exact_first.comp.glsl has no input \"tiles\" of this type");
  const GlTexture ids(GlPixel::link_id, 8, 8);
  GlProgram tiles("obstacle_tiles.comp.glsl");
  EXPECT_EQ(error_message<std::logic_error>([&] { tiles.read("obstacle_depth_m", ids); }),
            "shader obstacle_tiles.comp.glsl has no input \"obstacle_depth_m\" of this type");
}

TEST_F(GlProgramTest, AShaderThatDoesNotCompileIsNamedWithTheCompilersMessage) {
  const std::string message = error_message([] {
    GlProgram("obstacle_tiles.comp.glsl", {{"kNoPixel", "("}});
  });
  EXPECT_NE(message.find("OpenGL: shader obstacle_tiles.comp.glsl: "), std::string::npos)
      << message;
  EXPECT_NE(message.find("error"), std::string::npos) << message;
  error_message([] { context().check("the driver's own message"); });
}

TEST(ShaderSourceTest, IncludedFilesAndConstantsStandInTheText) {
  const std::string source = shader_source("obstacle_tiles.comp.glsl", {{"TILE_PX", "8"}});
  EXPECT_TRUE(source.starts_with("#version 450 core\n#define TILE_PX 8\n")) << source;
  EXPECT_EQ(source.find("#include"), std::string::npos) << source;
}

TEST(ShaderSourceTest, GlslangValidatorAcceptsEveryShader) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "glslangValidator is not installed (package glslang-tools)";
  }
  const TemporaryFolder folder;
  for (const std::string_view file : shader_files()) {
    // glslangValidator reports the stage from name.stage.
    const std::string stage(file.substr(file.size() - 9, 4));
    const auto path = folder.path() / ("shader." + stage);
    std::ofstream(path) << shader_source(file);
    EXPECT_EQ(std::system(("glslangValidator " + path.string()).c_str()), 0) << file;
  }
}

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
