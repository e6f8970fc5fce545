// A sweep gives the same rows however often it was stopped, and on any number of threads.
#include "thesis/study/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "berth/files/file_bytes.hpp"
#include "tests/support/gl_test.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::lab {
namespace {

std::vector<StudyScene> small_scenes() {
  std::vector<StudyScene> scenes;
  for (const std::uint32_t seed : {3, 4}) {
    scenes.push_back({"scene " + std::to_string(seed), SceneKind::drawn,
                      [seed] { return sim::random_images(seed, 80, 60, 4); }});
  }
  return scenes;
}

std::vector<Task> small_tasks() {
  SweepExtent extent = quick_extent();
  extent.brute_force_lengths_m = {6.0};
  std::vector<Task> tasks;
  for (const Part part : {Part::brute_force, Part::surveillance_length, Part::exact}) {
    for (const ParameterSet& set : sets_of(part, extent)) {
      for (const std::size_t scene : {0, 1}) tasks.push_back({scene, set});
    }
  }
  return tasks;
}

class Sweep : public ::testing::Test {
 protected:
  void run(const TemporaryFolder& folder, const std::vector<Task>& tasks, int threads) const {
    Journal journal(folder.path(), {}, journal_header(), journal_key_columns());
    sweep(small_scenes(), tasks, threads, 1, journal);
  }

  /// Sorted lines without their times.
  static std::vector<std::string> rows(const TemporaryFolder& folder) {
    std::vector<std::string> rows;
    std::istringstream lines(read_file_bytes(folder / "measurements.csv"));
    for (std::string line; std::getline(lines, line);) {
      std::size_t begin = 0;
      for (int i = 0; i < journal_key_columns(); ++i) begin = line.find(',', begin) + 1;
      rows.push_back(line.erase(begin, line.find(',', begin) - begin));
    }
    std::sort(rows.begin(), rows.end());
    return rows;
  }
};

TEST_F(Sweep, ThatWasStoppedGivesTheSameRowsAsOneThatWasNot) {
  const TemporaryFolder whole;
  const TemporaryFolder stopped;
  const std::vector<Task> tasks = small_tasks();
  run(whole, tasks, 1);
  run(stopped, {tasks.begin(), tasks.begin() + 20}, 2);
  ASSERT_EQ(rows(stopped).size(), 21u);
  const std::string bytes = read_file_bytes(stopped / "measurements.csv");
  stopped.write("measurements.csv", bytes.substr(0, bytes.size() - 30));
  run(stopped, tasks, 2);
  EXPECT_EQ(rows(stopped), rows(whole));
  EXPECT_EQ(rows(whole).size(), tasks.size() + 1);
  EXPECT_NE(bytes.find("brute_force"), std::string::npos);
}

TEST_F(Sweep, FindsNoErrorOfTheMethodsThatMakeNone) {
  const TemporaryFolder folder;
  run(folder, small_tasks(), 2);
  std::istringstream lines(read_file_bytes(folder / "measurements.csv"));
  int compared = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(",exact,exact,") == std::string::npos &&
        line.find(",brute_force,brute_force,") == std::string::npos) {
      continue;
    }
    if (line.ends_with(",,")) continue;
    ++compared;
    // The pair may be another one that is as close: the points are not judged.
    std::vector<std::string> cells(1);
    for (const char c : line) c == ',' ? (void)cells.emplace_back() : cells.back().push_back(c);
    EXPECT_LT(std::stod(cells[journal_key_columns() + 6]), 0.02) << line;
    EXPECT_EQ(cells[journal_key_columns() + 3], "0") << line;
  }
  EXPECT_GT(compared, 4);
}

TEST_F(Sweep, CallsNoSceneThatHasNothingLeft) {
  const TemporaryFolder folder;
  std::vector<Task> tasks = small_tasks();
  std::erase_if(tasks, [](const Task& task) { return task.scene == 1; });
  std::vector<StudyScene> scenes = small_scenes();
  scenes[1].make = []() -> sim::ImagePair { throw std::logic_error("was made"); };
  Journal journal(folder.path(), {}, journal_header(), journal_key_columns());
  EXPECT_NO_THROW(sweep(scenes, tasks, 2, 1, journal));
  EXPECT_THROW(sweep(scenes, small_tasks(), 2, 1, journal), std::logic_error);
}

class GlSweep : public testing::GlTest {};

TEST_F(GlSweep, MeasuresWhatRunsOnOpenGlOnceAndExactWithoutError) {
  const TemporaryFolder folder;
  std::vector<Task> tasks;
  for (const Part part : {Part::gl_hybrid, Part::gl_lattice, Part::gl_exact, Part::exact}) {
    tasks.push_back({0, sets_of(part, quick_extent()).back()});
  }
  for (const bool is_new : {true, false}) {
    Journal journal(folder.path(), {}, journal_header(), journal_key_columns());
    EXPECT_EQ(journal.found_lines(), is_new ? 0u : tasks.size());
    sweep(small_scenes(), tasks, 2, 1, journal, &context());
  }
  const std::string bytes = read_file_bytes(folder / "measurements.csv");
  EXPECT_EQ(std::count(bytes.begin(), bytes.end(), '\n'), 5) << bytes;
  EXPECT_NE(bytes.find(",gl_hybrid,gl_hybrid,2,,,,64,64,100,2,,"), std::string::npos) << bytes;
  EXPECT_NE(bytes.find(",gl_lattice,gl_lattice,2,,,,64,64,,2,32,"), std::string::npos) << bytes;
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) {
    if (line.find(",gl_exact,") == std::string::npos) continue;
    std::vector<std::string> cells(1);
    for (const char c : line) c == ',' ? (void)cells.emplace_back() : cells.back().push_back(c);
    EXPECT_LT(std::stod(cells[journal_key_columns() + 6]), 0.05) << line;
    EXPECT_EQ(cells[journal_key_columns() + 3], "0") << line;
  }
}

TEST(Scenes, TheWorstCaseIsAllObstacleBeforeAllRobot) {
  const sim::ImagePair images = worst_case_scene().make();
  for (std::size_t i = 0; i < images.robot.link_id.pixels().size(); ++i) {
    ASSERT_NE(images.robot.link_id.pixels()[i], kNoLink);
    ASSERT_LT(images.obstacle_depth_m.pixels()[i], images.robot.depth_m.pixels()[i]);
  }
}

}  // namespace
}  // namespace berth::lab
