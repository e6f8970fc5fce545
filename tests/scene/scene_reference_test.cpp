// docs/scene.md against the lists of settings and the reader of scene files.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "berth/scene/scene_file.hpp"
#include "berth/scene/settings_text.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

std::string reference() {
  std::ostringstream text;
  text << std::ifstream(BERTH_SCENE_REFERENCE).rdbuf();
  return text.str();
}

/// What stands between these two; empty where they do not.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t first = text.find(begin);
  if (first == std::string::npos) return "";
  const std::size_t last = text.find(end, first + begin.size());
  return last == std::string::npos ? ""
                                   : text.substr(first + begin.size(), last - first - begin.size());
}

std::string example(const std::string& name) {
  return between(reference(), "<!-- example: " + name + " -->\n```yaml\n", "```\n");
}

SceneFile read_example(const std::string& name) {
  const TemporaryFolder folder;
  folder.write("depth/000000.png", "");
  return read_scene(folder.write("scene.yaml", example(name)));
}

TEST(SceneReference, HasTheTablesOfAllSettings) {
  const std::string text = reference();
  for (const std::string_view group : kSettingGroups) {
    const std::string begin = "<!-- settings: " + std::string(group) + " -->\n";
    const std::string expected = settings_table(group);
    EXPECT_EQ(between(text, begin, "<!-- end -->"), expected)
        << "docs/scene.md should have:\n"
        << begin << expected << "<!-- end -->\n";
  }
}

TEST(SceneReference, TableNeedsAGroupThatThereIs) {
  expect_parts(error_message<std::invalid_argument>([] { settings_table("filter"); }),
               {"filter", "self_filter, sensor, space, watch, evaluation, time, separation"});
}

TEST(SceneReference, ItsExamplesAreScenes) {
  for (const char* name : {"least", "arm on a table", "two cameras"}) {
    ASSERT_NE(example(name), "") << "docs/scene.md has no example: " << name;
    EXPECT_NO_THROW(read_example(name)) << name;
  }
  EXPECT_EQ(read_example("two cameras").cameras.size(), 2U);
  EXPECT_FALSE(read_example("arm on a table").robot.environment_links.empty());
}

/// Every key of the reader is named: an unknown key's message lists them all.
TEST(SceneReference, NamesEveryKey) {
  const std::string text = reference();
  for (const std::string& scene :
       {std::string("no_key: 1"), std::string("robot: {no_key: 1}\ncameras: []\njoints: j.csv"),
        std::string("robot: {urdf: r}\ncameras: [{no_key: 1}]\njoints: j.csv")}) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("scene.yaml", scene + "\n");
    const std::string message = error_message([&] { read_scene(file); });
    const std::size_t list = message.find("or another of ");
    ASSERT_NE(list, std::string::npos) << message;
    std::string keys = message.substr(list + std::string("or another of ").size());
    std::replace(keys.begin(), keys.end(), ',', ' ');
    std::istringstream words(keys);
    for (std::string key; words >> key;) {
      EXPECT_NE(text.find("`" + key + "`"), std::string::npos) << "docs/scene.md lacks " << key;
    }
  }
}

}  // namespace
}  // namespace berth
