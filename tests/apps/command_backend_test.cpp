// --backend opengl and the methods that run there; what the program says where there is no OpenGL.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/apps/command_scene.hpp"
#include "tests/support/gl_test.hpp"

namespace berth {
namespace {

using Words = std::vector<std::string>;

class Backend : public testing::GlTest {
 protected:
  // Two renderers may differ by a pixel at an outline.
  Backend() { scene_.lines.self_filter = "{padding_m: 0.06, flying_patch_radius_m: 0}"; }

  static std::vector<Json> lines_of(const std::string& text) {
    std::vector<Json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
    return lines;
  }

  std::vector<Json> evaluate(std::vector<std::string> more) {
    scene_.write_scene();
    std::vector<std::string> arguments = {"evaluate", "scene.yaml", "--format", "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_berth(scene_.folder(), arguments);
    EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
    return lines_of(outcome.out);
  }

  CommandScene scene_;
};

void expect_near(const std::vector<Json>& expected, const std::vector<Json>& found) {
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < found[i]["links"].size(); ++k) {
      const Json& a = expected[i]["links"][k];
      const Json& b = found[i]["links"][k];
      EXPECT_EQ(a["status"], b["status"]);
      if (a["status"] != "ok") continue;
      // A pixel of this small image is 3.3 cm wide at the arm.
      EXPECT_NEAR(a["distance_m"].get<double>(), b["distance_m"].get<double>(), 0.034);
    }
  }
}

TEST_F(Backend, BothGiveTheSameDistancesByMethodsOfBoth) {
  const std::vector<Json> expected = evaluate({});
  EXPECT_FALSE(expected.at(0).contains("gl_renderer"));
  for (const std::string backend : {"cpu", "opengl"}) {
    for (const std::string method : {"exact", "gl_exact"}) {
      SCOPED_TRACE(backend + ", " + method);
      const std::vector<Json> found = evaluate({"--backend", backend, "--method", method});
      expect_near(expected, found);
      EXPECT_EQ(found.at(0)["method"], method);
      const bool uses_gl = backend == "opengl" || method == "gl_exact";
      EXPECT_EQ(found.at(0).contains("gl_renderer"), uses_gl);
      if (uses_gl) {
        EXPECT_EQ(found.at(0)["gl_renderer"], context().renderer());
      }
    }
  }
}

TEST_F(Backend, ThreeImagesAreEvaluatedOnOpenGl) {
  scene_.write_scene();
  const Outcome filter = run_berth(scene_.folder(), {"filter", "scene.yaml", "--out", "images"});
  EXPECT_EQ(filter.exit_status, 0) << filter.err;
  const auto evaluate = [&](const std::string& method) {
    const Outcome outcome =
        run_berth(scene_.folder(),
                  {"evaluate", "--camera", "camera_info.yaml", "--robot-depth",
                   "images/robot_depth_000000.png", "--link-ids", "images/link_ids_000000.png",
                   "--obstacle-depth", "images/obstacle_depth_000000.png", "--range", "2",
                   "--format", "json", "--method", method, "--repeat", "2"});
    EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
    return lines_of(outcome.out);
  };
  expect_near(evaluate("exact"), evaluate("gl_exact"));
  EXPECT_EQ(evaluate("gl_lattice").at(0)["gl_renderer"], context().renderer());
}

TEST_F(Backend, AnUnknownDeviceIsRefusedBeforeAnythingIsWritten) {
  scene_.write_scene();
  const auto before = scene_.all_names();
  const Outcome outcome = run_berth(
      scene_.folder(),
      {"evaluate", "scene.yaml", "--backend", "opengl", "--gl-device", "none such", "--out", "p"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("no device \"none such\""), std::string::npos) << outcome.err;
  EXPECT_EQ(scene_.all_names(), before);
}

TEST_F(Backend, ASensorRuleIsRefusedWithTheScenesName) {
  scene_.lines.more = "sensor: {speckle_px: 20}";
  scene_.write_scene();
  const Outcome outcome =
      run_berth(scene_.folder(), {"evaluate", "scene.yaml", "--backend", "opengl"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_NE(outcome.err.find("scene.yaml: sensor.speckle_px: runs on the CPU alone"),
            std::string::npos)
      << outcome.err;
}

/// The loader of EGL finds no vendor then.
class WithoutOpenGl : public ::testing::Test {
 protected:
  WithoutOpenGl() { setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1); }
  ~WithoutOpenGl() override { unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES"); }
};

TEST_F(WithoutOpenGl, WhatNeedsItSaysWhatIsMissingAndTheRestRuns) {
  CommandScene scene;
  scene.write_scene();
  for (const std::vector<std::string>& needing :
       {std::vector<std::string>{"evaluate", "scene.yaml", "--backend", "opengl"},
        {"evaluate", "scene.yaml", "--method", "gl_exact"}}) {
    const Outcome outcome = run_berth(scene.folder(), needing);
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("berth: OpenGL: ")) << outcome.err;
    EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run_berth(scene.folder(), {"evaluate", "scene.yaml"}).exit_status, 0);
}

// The options of `evaluate` that belong to some methods only.

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
