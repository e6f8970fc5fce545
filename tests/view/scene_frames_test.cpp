// What is shown of one step is what `berth run` says of it.
#include "apps/view/scene_frames.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "berth/scene/result_json.hpp"
#include "berth/scene/scene_run.hpp"
#include "tests/support/error_message.hpp"

namespace berth::app {
namespace {

using FramesJson = nlohmann::json;

std::shared_ptr<const OpenScene> bundled(
    const char* file, const std::function<void(SceneFile&)>& change = [](auto&) {}) {
  SceneFile scene = read_scene(std::string(BERTH_SOURCE_DIR "/data/bundled/") + file);
  change(scene);
  return std::make_shared<const OpenScene>(open_scene(scene));
}

/// The search begins with what it knew before, so that the last digits may differ.
void expect_near(const FramesJson& shown, const FramesJson& run, const std::string& where) {
  if (run.is_number_float() && shown.is_number()) {
    EXPECT_NEAR(shown.get<double>(), run.get<double>(), 2e-3) << where;
  } else if (run.is_object()) {
    for (const auto& [key, value] : run.items())
      expect_near(shown.at(key), value, where + "." + key);
  } else if (!run.is_array()) {
    EXPECT_EQ(shown, run) << where;
  }
}

void expect_same(const std::shared_ptr<const OpenScene>& scene, std::size_t every) {
  SceneFrames frames(scene);
  SceneRun run(*scene);
  for (std::size_t step = 0; run.next(); ++step) {
    const FrameResult expected = run.ask();
    if (step % every != 0) continue;
    frames.show(step);
    const auto shown = FramesJson::parse(result_json(frames.ask()));
    const auto all = FramesJson::parse(result_json(expected));
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
      EXPECT_EQ(shown["cameras"][c].value("self_filter", FramesJson()),
                all["cameras"][c].value("self_filter", FramesJson()));
    }
  }
}

TEST(SceneFrames, ShowsWhatRunSays) { expect_same(bundled("scene.yaml"), 7); }

TEST(SceneFrames, ShowsWhatRunSaysOfImagesAlone) {
  expect_same(
      bundled("scene.yaml", [](SceneFile& scene) { scene.evaluation.method = Method::exact; }), 17);
}

TEST(SceneFrames, TakesMeansOverTheImagesBefore) {
  expect_same(
      bundled("one_camera.yaml",
              [](SceneFile& scene) { scene.cameras[0].settings.sensor.average_frames = 4; }),
      5);
}

TEST(SceneFrames, GoesBackAsForth) {
  SceneFrames frames(bundled("one_camera.yaml"));
  const auto text_of_step = [&](std::size_t step) {
    frames.show(step);
    return FramesJson::parse(result_json(frames.ask()))["self_filter"];
  };
  const FramesJson third = text_of_step(3);
  text_of_step(9);
  EXPECT_EQ(text_of_step(3), third);
}

TEST(SceneFrames, RefusesWhatRunsOnOpengl) {
  const auto scene =
      bundled("one_camera.yaml", [](SceneFile& one) { one.evaluation.method = Method::gl_exact; });
  expect_parts(error_message([&] { SceneFrames frames(scene); }),
               {"gl_exact", "expected one that runs on the processor"});
}

}  // namespace
}  // namespace berth::app
