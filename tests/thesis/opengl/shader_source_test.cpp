#include "thesis/opengl/shader_source.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

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

}  // namespace
}  // namespace berth
