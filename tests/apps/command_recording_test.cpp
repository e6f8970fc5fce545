// `berth run` on a recording whose camera reads few of its pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/apps/berth_program.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

/// 31 % of its pixels have a reading.
TEST(Recording, ACameraThatReadsAThirdOfItsPixelsIsOk) {
  const auto folder = data_folder() / "recordings/lbr_med7_zed2i_small";
  if (!std::filesystem::exists(folder / "scene.yaml"))
    GTEST_SKIP() << "needs the recordings; BERTH_DATA names their folder";
  const Outcome outcome = run_berth(folder, {"run", "scene.yaml", "--format", "json"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  // It names the method of an older berth, and nothing else is said.
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("evaluation.method is no setting any more"), std::string::npos)
      << outcome.err;
  std::istringstream lines(outcome.out);
  int frames = 0;
  for (std::string line; std::getline(lines, line); ++frames) {
    EXPECT_EQ(Json::parse(line)["cameras"][0]["status"], "ok") << line;
  }
  EXPECT_EQ(frames, 9);
}

}  // namespace
}  // namespace berth
