#include "thesis/opengl/gl_context.hpp"

#include "tests/support/error_message.hpp"
#include "tests/support/gl_test.hpp"
#include "thesis/opengl/gl_buffer.hpp"

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

}  // namespace
}  // namespace berth
