#include "apps/berth/calibration_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "berth/files/file_bytes.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/small_calibration_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::app {
namespace {

/// A page as it lies in its folder: each tag closed, each picture there and nothing else.
class Page {
 public:
  explicit Page(const CalibrationReport& report, const std::string& title = "scene.yaml") {
    write_calibration_page(folder_ / "report", title, report);
    html_ = read_file_bytes(folder_ / "report/index.html");
    const pugi::xml_parse_result parsed =
        document_.load_string(html_.c_str(), pugi::parse_default | pugi::parse_doctype);
    EXPECT_TRUE(parsed) << parsed.description() << " at " << html_.substr(parsed.offset, 60);
    for (const pugi::xpath_node& node : document_.select_nodes("//img/@src")) {
      pictures_.push_back(node.attribute().value());
    }
    check_files();
  }

  const std::string& html() const { return html_; }
  const std::vector<std::string>& pictures() const { return pictures_; }
  std::vector<std::string> texts(const char* xpath) const {
    std::vector<std::string> texts;
    for (const pugi::xpath_node& node : document_.select_nodes(xpath)) {
      texts.push_back(node.node().text().get());
    }
    return texts;
  }
  bool has(const std::string& part) const { return html_.find(part) != std::string::npos; }

 private:
  void check_files() const {
    std::vector<std::string> expected = pictures_;
    expected.push_back("index.html");
    std::sort(expected.begin(), expected.end());
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "report")) {
      found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    for (const std::string& picture : pictures_) {
      EXPECT_TRUE(read_file_bytes(folder_ / ("report/" + picture)).starts_with("\x89PNG"));
    }
    EXPECT_TRUE(document_.select_nodes("//script | //link | //iframe").empty());
    EXPECT_FALSE(has("url(")) << "the page must not ask for anything";
  }

  TemporaryFolder folder_;
  std::string html_;
  pugi::xml_document document_;
  std::vector<std::string> pictures_;
};

using Texts = std::vector<std::string>;

TEST(CalibrationPage, HasAllItsPicturesAndSaysTheHeadline) {
  const testing::SmallCalibrationData small(3);
  const Page page(small.report());
  EXPECT_EQ(page.texts("//h1"), Texts{"Calibration of scene.yaml"});
  EXPECT_EQ(
      page.texts("//p[@class='lead']"),
      Texts{"This camera's view of the robot was off by 20.0 mm; now it is repeatable to ± 1.5 mm "
            "(3 frames)."});
  EXPECT_EQ(page.pictures(),
            (Texts{"camera_1_frame_000000_before.png", "camera_1_frame_000000_after.png",
                   "camera_1_frame_000001_before.png", "camera_1_frame_000001_after.png",
                   "camera_1_frame_000002_before.png", "camera_1_frame_000002_after.png"}));
  EXPECT_TRUE(page.has("All 3 that were used."));
  EXPECT_TRUE(page.has("go through at least 5 poses (3 used)"));
}

TEST(CalibrationPage, TablesHoldWhatWasFound) {
  const testing::SmallCalibrationData small;
  const Page page(small.report());
  EXPECT_TRUE(page.has("<tr><td>half of them within</td><td>20.0 mm</td><td>0.0 mm</td></tr>"));
  EXPECT_TRUE(page.has("<td>62 %</td><td>88 %</td>"));
  EXPECT_TRUE(
      page.has("<td><code>self_filter.tolerance_m</code></td><td class=\"value\">0.03 m</td>"
               "<td class=\"text\">Because of the tolerance.</td>"));
  EXPECT_TRUE(page.has("<td>1 m</td><td>4 mm</td><td>6 mm</td>"));
  EXPECT_TRUE(page.has("<tr><td>z</td><td>1.5200 m</td><td>1.5000 m</td><td>± 1.0 mm</td></tr>"));
  EXPECT_EQ(page.texts("//svg/path[@class='after']").size(), 1);
}

TEST(CalibrationPage, AtMostSixFramesAreShown) {
  const testing::SmallCalibrationData small(9, 0.1);
  const Page page(small.report());
  EXPECT_EQ(page.pictures().size(), 12);
  EXPECT_TRUE(page.has("6 of the 9 that were used"));
}

TEST(CalibrationPage, NamesAreShownAsTheyAreAndMakeNoFiles) {
  testing::SmallCalibrationData small;
  const std::string name = "../<b>left</b> & \"right\" 'up'";
  small.found().camera = name;
  small.proposal.self_filter[0].why = "a < b & c";
  CalibrationReport report = small.report();
  report.warnings = {"<script>warning</script>"};
  const Page page(report, "a&b <scene>.yaml");
  EXPECT_EQ(page.texts("//h2"), Texts{name});
  EXPECT_EQ(page.texts("//h1"), Texts{"Calibration of a&b <scene>.yaml"});
  EXPECT_EQ(page.texts("//p[@class='warning']"), Texts{"<script>warning</script>"});
  EXPECT_TRUE(page.has("a &lt; b &amp; c"));
}

TEST(CalibrationPage, ARefusedPoseProposesNothing) {
  testing::SmallCalibrationData small;
  small.found().refused = "the images agree by 0.20 of 2";
  small.found().X_PC = small.camera.X_PC;
  small.found().halves_m = std::nan("");
  small.proposal = {};
  const Page page(small.report());
  EXPECT_EQ(page.texts("//p[@class='lead refused']"),
            Texts{"The scene's pose stays: the images agree by 0.20 "
                  "of 2."});
  EXPECT_TRUE(page.has("None are proposed"));
  EXPECT_EQ(page.pictures().size(), 5);
  EXPECT_FALSE(page.has("not known at the clock"));
  EXPECT_FALSE(page.has("nan"));
}

TEST(CalibrationPage, FramesWithoutReadingsOrRobotAreShown) {
  testing::SmallCalibrationData small(3);
  small.camera.frames[0].depth_m = DepthImage(160, 120, kNoDepth);
  const Page no_readings(small.report());
  EXPECT_EQ(no_readings.pictures().size(), 6);
  EXPECT_TRUE(no_readings.has("In frame 0 only 0 % of the robot has readings"));

  for (CalibrationFrame& frame : small.camera.frames)
    frame.depth_m = DepthImage(160, 120, kNoDepth);
  small.found().X_PC.translation().x() = 50;
  small.found().before = small.found().after = {std::nan(""), std::nan(""), std::nan("")};
  const Page no_robot(small.report());
  EXPECT_EQ(no_robot.pictures().size(), 6);
  EXPECT_TRUE(no_robot.has("Frame 0 shows nothing of the robot"));
  EXPECT_FALSE(no_robot.has("nan"));
}

TEST(CalibrationPage, FramesWhoseJointsAreNotKnownSaySo) {
  testing::SmallCalibrationData small(3);
  small.found().clock_offset_s = -0.15;
  const Page page(small.report());
  EXPECT_EQ(page.pictures().size(), 4);
  EXPECT_TRUE(page.has("The joints are not known at the clock that was found."));
}

TEST(CalibrationPage, AllCamerasAndJointZerosAreTold) {
  testing::SmallCalibrationData small(2);
  small.calibration_data.cameras.push_back(&small.camera);
  small.result.cameras.push_back(small.found());
  small.result.cameras[1].camera = "second";
  small.result.joint_offsets = {{"joint_2", 0.0175}};
  small.result.joints_not_determined = {"joint_1"};
  CalibrationReport report = small.report();
  report.proposals.push_back({});
  const Page page(report);
  EXPECT_EQ(page.texts("//h2"), (Texts{"camera", "second", "Joint zeros"}));
  EXPECT_EQ(page.pictures().size(), 8);
  EXPECT_TRUE(page.has("<tr><td>joint_2</td><td>0.0175 rad (1.00°)</td></tr>"));
  EXPECT_TRUE(page.has("joint_1: these images do not tell"));
}

TEST(CalibrationPage, ShowsWhatTheCamerasDetect) {
  const testing::SmallCalibrationData small(2);
  EXPECT_FALSE(Page(small.report()).has("What the cameras detect"));
  CalibrationReport report = small.report();
  report.detection = testing::small_detection_map();
  const Page page(report);
  EXPECT_TRUE(page.has("What the cameras detect"));
  EXPECT_TRUE(
      page.has("Of what is in view, 60 mm is detected everywhere; the worst place is (0.20, "
               "0.00, 1.00)."));
  EXPECT_TRUE(page.has("z = 1.00 m"));
}

TEST(CalibrationPage, AFolderThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  folder.write("taken", "");
  const testing::SmallCalibrationData small(1);
  const std::string message =
      error_message([&] { write_calibration_page(folder / "taken", "scene", small.report()); });
  EXPECT_NE(message.find("taken"), std::string::npos) << message;
}

}  // namespace
}  // namespace berth::app
