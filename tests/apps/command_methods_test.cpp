// The options of `evaluate` that belong to some methods only.
#include <gtest/gtest.h>

#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

using Words = std::vector<std::string>;

Words evaluate_with(const Words& more) {
  Words arguments = {"evaluate", "scene.yaml"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::int64_t pairs(const std::vector<Json>& frames) {
  std::int64_t sum = 0;
  for (const Json& frame : frames) sum += frame["pairs"].get<std::int64_t>();
  return sum;
}

TEST(Methods, EachOptionOfLatticeChangesTheSearch) {
  const CommandScene scene;
  const auto pairs_with = [&](Words more) {
    more.insert(more.begin(), {"--method", "lattice"});
    return pairs(scene.json(evaluate_with(more)));
  };
  const std::int64_t without = pairs_with({});
  EXPECT_LT(pairs_with({"--step-x", "3"}), without);
  EXPECT_LT(pairs_with({"--step-y", "3"}), without);
  EXPECT_NE(pairs_with({"--initial-grid-radius-px", "4"}), without);
  EXPECT_GT(pairs_with({"--final-grid-radius-px", "8"}), without);
  EXPECT_NE(pairs_with({"--search-pattern", "spiral"}), without);
  EXPECT_GT(pairs_with({"--region", "image"}), without);
  EXPECT_NE(pairs_with({"--depth-interval", "cube"}), without);
  EXPECT_GT(pairs_with({"--shrinking", "none"}), without);
}

TEST(Methods, TheRobotShapedRegionIgnoresWhatIsNotSeenThroughIt) {
  const CommandScene scene;
  const auto ignored = [&](const Words& more) {
    return scene.json(evaluate_with(more)).at(0)["cameras"][0]["self_filter"]["outside_region"];
  };
  EXPECT_EQ(ignored({}), 0);
  const int near = ignored({"--robot-region-scale", "3"});
  const int nearer = ignored({"--robot-region-scale", "1.5"});
  EXPECT_GT(near, 0);
  EXPECT_GT(nearer, near);
  EXPECT_EQ(scene.berth(evaluate_with({"--robot-region-scale", "0.5"})).exit_status, 2);
  EXPECT_NE(scene.berth({"evaluate", "--robot-region-scale", "3"}).err.find("needs a scene"),
            std::string::npos);
}

TEST(Methods, OptionsAreRefusedForAMethodThatDoesNotHaveThem) {
  struct Wrong {
    std::string method;
    std::string option;
    std::string value;
  };
  std::vector<Wrong> table = {
      {"exact", "--region", "image"},          {"exact", "--depth-interval", "cube"},
      {"exact", "--search-pattern", "spiral"}, {"exact", "--shrinking", "none"},
      {"lattice", "--tolerance-m", "0.1"},     {"lattice", "--deadline-us", "5"}};
  for (const std::string option : {"--step-x", "--step-y", "--initial-grid-radius-px",
                                   "--final-grid-radius-px", "--tile-px"}) {
    table.push_back({"exact", option, "2"});
    table.push_back({"brute_force", option, "2"});
  }
  for (const std::string method : {"lattice", "gl_exact", "gl_hybrid"}) {
    table.push_back({method, "--tile-px", "8"});
  }
  for (const std::string method : {"gl_lattice", "gl_exact"}) {
    table.push_back({method, "--initial-grid-radius-px", "2"});
    table.push_back({method, "--region", "image"});
  }
  table.push_back({"gl_hybrid", "--region", "image"});
  const CommandScene scene;
  for (const Wrong& wrong : table) {
    const Outcome outcome =
        scene.berth(evaluate_with({"--method", wrong.method, wrong.option, wrong.value}));
    EXPECT_EQ(outcome.exit_status, 1) << wrong.method << wrong.option;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(
        outcome.err.find("method " + wrong.method + ": has no " + wrong.option + "; expected"),
        std::string::npos)
        << outcome.err;
  }
}

}  // namespace
}  // namespace berth
