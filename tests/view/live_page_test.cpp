#include "apps/view/live_page.hpp"

#include <gtest/gtest.h>

#include "berth/scene/scene_run.hpp"
#include "tests/support/error_message.hpp"
#include "tests/view/page_client.hpp"

namespace berth::app {
namespace {

TEST(LivePage, ShowsAnswersAsTheyCome) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  SceneRun run(scene);
  LivePage page(scene.robot, {{"camera", scene.cameras[0].mounted->camera()}}, {.port = 0},
                {{"/", {"text/html", "the page"}}});
  const std::string url = page.url();
  PageClient client(std::atoi(url.c_str() + url.rfind(':') + 1));
  const auto next = [&] {
    const std::string text = client.next();
    return nlohmann::json::parse(text.substr(text.find('{'), text.rfind('}') + 1 - text.find('{')));
  };
  const auto scene_json = next();
  EXPECT_EQ(scene_json["type"], "scene");
  EXPECT_TRUE(scene_json["steps"].empty());
  EXPECT_EQ(scene_json["cameras"][0]["name"], "camera");
  // The mesh's numbers hold any bytes.
  client.next();
  ASSERT_TRUE(run.next());
  const Result result = run.ask();
  expect_parts(error_message<std::invalid_argument>([&] { page.show(result, {}); }),
               {"0 frames; expected 1"});
  page.show(result, {run.frame()});
  const auto shown = next();
  EXPECT_EQ(shown["result"]["links"].size(), 8u);
  EXPECT_EQ(shown["cameras"][0].size(), 16u);
  EXPECT_GT(client.next().size(), 640u * 480 * 9);
  const auto timeline = next();
  EXPECT_EQ(timeline["stamps_s"], nlohmann::json({result.stamp_s}));
  // The camera has given nothing since.
  page.show(result, {nullptr});
  EXPECT_TRUE(next()["cameras"][0].is_null());
}

}  // namespace
}  // namespace berth::app
