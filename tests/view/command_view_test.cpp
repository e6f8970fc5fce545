// `berth view` as its user starts and ends it.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/berth_program.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

TEST(ViewCommand, SaysWhatIsWrongAndEnds) {
  const TemporaryFolder folder;
  folder.write("bad.yaml", "robot: 7\n");
  const auto refused = [&](const std::vector<std::string>& words, int status) {
    const Outcome outcome = run_berth(folder / "", words);
    EXPECT_EQ(outcome.exit_status, status) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_NE(refused({"view"}, 2), "");
  EXPECT_NE(refused({"view", "bad.yaml", "--port", "-1"}, 2), "");
  EXPECT_NE(refused({"demo", "--port", "8080"}, 2), "");
  expect_parts(refused({"view", "bad.yaml", "--save-to", "nowhere"}, 1),
               {"--save-to nowhere", "expected"});
}

}  // namespace
}  // namespace berth
