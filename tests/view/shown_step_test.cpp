// What a run says of one step when it goes there at once is what it says on its way there.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "berth/pipeline/frame_set.hpp"
#include "berth/results/result_json.hpp"
#include "berth/scene/scene_run.hpp"

namespace berth::app {
namespace {

using Json = nlohmann::json;

OpenScene bundled(
    const char* file, const std::function<void(SceneFile&)>& change = [](auto&) {}) {
  SceneFile scene = read_scene(std::string(BERTH_SOURCE_DIR "/data/bundled/") + file);
  change(scene);
  return open_scene(scene);
}

/// The search begins with what it knew before, so that the last digits may differ.
void expect_near(const Json& shown, const Json& run, const std::string& where) {
  if (run.is_number_float() && shown.is_number()) {
    EXPECT_NEAR(shown.get<double>(), run.get<double>(), 2e-3) << where;
  } else if (run.is_object()) {
    for (const auto& [key, value] : run.items())
      expect_near(shown.at(key), value, where + "." + key);
  } else if (!run.is_array()) {
    EXPECT_EQ(shown, run) << where;
  }
}

void expect_same(const OpenScene& scene, std::size_t every) {
  SceneRun steps(scene, SceneRun::SingleSteps{});
  SceneRun run(scene);
  for (std::size_t step = 0; run.next(); ++step) {
    const Result expected = run.ask();
    if (step % every != 0) continue;
    steps.go_to(step);
    const auto shown = Json::parse(result_json(steps.ask()));
    const auto all = Json::parse(result_json(expected));
    EXPECT_EQ(shown["frame"], all["frame"]);
    for (std::size_t i = 0; i < all["links"].size(); ++i) {
      for (const char* key : {"link", "status", "distance_m"}) {
        expect_near(shown["links"][i][key], all["links"][i][key],
                    "step " + std::to_string(step) + " " + key);
      }
    }
    EXPECT_EQ(shown["cameras"].size(), all["cameras"].size());
    for (std::size_t c = 0; c < all["cameras"].size(); ++c) {
      for (const char* key : {"frame", "status"})
        EXPECT_EQ(shown["cameras"][c][key], all["cameras"][c][key]);
      EXPECT_EQ(shown["cameras"][c].value("self_filter", Json()),
                all["cameras"][c].value("self_filter", Json()));
    }
  }
}

TEST(ShownStep, IsWhatRunSays) { expect_same(bundled("scene.yaml"), 7); }

TEST(ShownStep, GoesBackAsForth) {
  const OpenScene scene = bundled("one_camera.yaml");
  SceneRun steps(scene, SceneRun::SingleSteps{});
  const auto pixels_of_step = [&](std::size_t step) {
    steps.go_to(step);
    return Json::parse(result_json(steps.ask()))["cameras"][0]["self_filter"];
  };
  const Json third = pixels_of_step(3);
  EXPECT_FALSE(third.is_null());
  pixels_of_step(9);
  EXPECT_EQ(pixels_of_step(3), third);
}

TEST(ShownStep, TakesTheWatchFromWhatWasFound) {
  const OpenScene scene = bundled("scene.yaml");
  SceneRun steps(scene, SceneRun::SingleSteps{});
  steps.go_to(20);
  Result found = steps.ask();
  EXPECT_EQ(found.status, ResultStatus::ok);
  found.cameras[1].watch.has_moved = true;
  steps.go_to(20, &found);
  const Result moved = steps.ask();
  EXPECT_EQ(moved.status, ResultStatus::degraded);
  EXPECT_EQ(moved.cameras[1].status, CameraStatus::moved);
  EXPECT_EQ(steps.frame_set().used(), (std::vector<int>{0, 2}));
  steps.go_to(20);
  EXPECT_EQ(steps.ask().status, ResultStatus::ok);
}

}  // namespace
}  // namespace berth::app
