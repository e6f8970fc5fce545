#include <gtest/gtest.h>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/berth_program.hpp"

namespace berth {
namespace {

TEST(Demo, RunsTheBundledSceneAndDrawsIt) {
  if (!std::filesystem::exists(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    GTEST_SKIP() << "data/bundled is missing";
  }
  const TemporaryFolder folder;
  const Outcome outcome = run_berth(folder / "", {"demo"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("distance [m]"), std::string::npos);
  EXPECT_NE(outcome.out.find(" ok "), std::string::npos);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"berth_demo"});
  EXPECT_NE(outcome.out.find((folder / "berth_demo").string()), std::string::npos);
  for (const char* camera : {"camera", "left", "right"}) {
    const auto picture = folder / "berth_demo" / camera / "frame_000000.png";
    EXPECT_TRUE(read_file_bytes(picture).starts_with("\x89PNG\r\n")) << camera;
  }
}

}  // namespace
}  // namespace berth
