#include "apps/view/scene_messages.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "apps/view/live_page.hpp"
#include "berth/scene/scene_run.hpp"
#include "tests/support/error_message.hpp"
#include "tests/view/page_client.hpp"

namespace berth::app {
namespace {

std::vector<PageCamera> cameras_of(int count, int width_px, int height_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  return std::vector<PageCamera>(count, {"camera", camera});
}

TEST(ShownPixels, AreBoundedOverAllCameras) {
  EXPECT_EQ(shown_stride(cameras_of(8, 640, 480)), 1);
  EXPECT_EQ(shown_stride(cameras_of(3, 1280, 720)), 1);
  EXPECT_EQ(shown_stride(cameras_of(8, 1920, 1080)), 2);
  EXPECT_EQ(shown_stride(cameras_of(8, 3840, 2160)), 4);
}

/// The depths behind the header of an image's message.
std::vector<float> depths_of(const PageMessage& message, int width, int height) {
  std::uint32_t length = 0;
  std::memcpy(&length, message.bytes.data(), sizeof length);
  const auto header = nlohmann::json::parse(message.bytes.substr(sizeof length, length));
  EXPECT_EQ(header["width_px"], width);
  EXPECT_EQ(header["height_px"], height);
  std::vector<float> depth_m(static_cast<std::size_t>(width) * height);
  std::memcpy(depth_m.data(), message.bytes.data() + sizeof length + length,
              depth_m.size() * sizeof(float));
  return depth_m;
}

TEST(ShownPixels, AreEveryNthOfTheImage) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  SceneRun run(scene);
  ASSERT_TRUE(run.next());
  const auto message = [&](int stride) {
    return image_message(0, 0, run.sensor_depth_m(0), *run.frame(0), stride);
  };
  const std::vector<float> all_m = depths_of(message(1), 640, 480);
  // Neither side is a multiple of it.
  const std::vector<float> some_m = depths_of(message(7), 92, 69);
  EXPECT_LT(message(7).bytes.size(), message(1).bytes.size() / 40);
  int readings = 0;
  for (int v = 0; v < 69; ++v) {
    for (int u = 0; u < 92; ++u) {
      const float shown_m = some_m[v * 92 + u], whole_m = all_m[7 * v * 640 + 7 * u];
      EXPECT_EQ(std::isnan(shown_m), std::isnan(whole_m));
      if (std::isnan(whole_m)) continue;
      EXPECT_EQ(shown_m, whole_m);
      ++readings;
    }
  }
  EXPECT_GT(readings, 5000);
}

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
