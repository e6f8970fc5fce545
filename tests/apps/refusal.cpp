#include "tests/apps/refusal.hpp"

#include <gtest/gtest.h>

namespace berth {

void expect_refused(const CommandScene& scene, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& told) {
  scene.write_scene();
  const std::vector<std::string> before = scene.all_names();
  const Outcome outcome = scene.berth(arguments);
  SCOPED_TRACE(arguments[0] + ": " + outcome.err);
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.out, "");
  for (const std::string& part : told) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  EXPECT_EQ(scene.all_names(), before);
}

}  // namespace berth
