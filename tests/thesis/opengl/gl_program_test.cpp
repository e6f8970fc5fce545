#include "thesis/opengl/gl_program.hpp"

#include "tests/support/error_message.hpp"
#include "tests/support/gl_test.hpp"

namespace berth {
namespace {

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

}  // namespace
}  // namespace berth
