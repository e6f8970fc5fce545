#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "tests/scene/scene_text.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t begin = 0, end = 0;
  for (; (end = text.find(by, begin)) != std::string::npos; begin = end + by.size()) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

TEST(SceneErrors, RefusesABadValueAndSaysWhere) {
  // A line of the scene, what stands in its place, and the parts of what is told.
  std::istringstream table(R"(robot | {} | scene.yaml:1: robot: the key urdf is missing; expected
robot | r.urdf | scene.yaml:1: robot: r.urdf; expected a map
robot | {urdf: } | robot.urdf: nothing; expected a text
robot | {urdf: ''} | robot.urdf: an empty text; expected a text
robot | {urdf: [a]} | robot.urdf: a list of 1; expected a text
robot | {urdff: r} | scene.yaml:1: robot.urdff: unknown key; expected urdf (the nearest)
robot | {urdf: r, urdf: s} | robot.urdf: the key stands here a second time; expected each key once
robot | {urdf: r, geometry: mesh} | robot.geometry: mesh; expected one of visual, collision
robot | {urdf: r, ignore_links: table} | robot.ignore_links: table; expected a list
robot | {urdf: r, allowed_contacts: [[a, b, c]]} | robot.allowed_contacts[0]: 3 links; expected two links
robot | {urdf: r, others: [{urdf: s}]} | robot.others[0] ... pose
robot | {urdf: r, environment_links: [[a]]} | robot.environment_links[0]: a list of 1; expected a text
robot | {urdf: r, package_paths: [a]} | robot.package_paths: a list of 1; expected a map
robot | {urdf: r, package_paths: {a: b, a: c}} | robot.package_paths.a: the key stands here a second time
robot | {urdf: r | scene.yaml: ... expected valid YAML
name | name: a/b | scene.yaml:3: cameras[0].name: a/b; expected a name that can be a folder's
name | name: . | cameras[0].name: .; expected a name
name | name: .. | cameras[0].name: ..; expected a name
name | nam: front | scene.yaml:3: cameras[0].nam: unknown key; expected name (the nearest)
info |  | scene.yaml:3: cameras[0]: the key info is missing
pose |  | cameras[0]: the key pose is missing
pose | pose: identity | scene.yaml:5: cameras[0].pose: identity; expected a map
pose | pose: {xyz: [1, 2, 3], rpy: [0, 0, 0]} | cameras[0].pose: the key parent is missing
pose | pose: {parent: b, rpy: [0, 0, 0]} | cameras[0].pose: the key xyz is missing
pose | pose: {parent: b, xyz: [1, 2], rpy: [0, 0, 0]} | cameras[0].pose.xyz: a list of 2; expected a list of 3 numbers
pose | pose: {parent: b, xyz: [1, .nan, 2], rpy: [0, 0, 0]} | cameras[0].pose.xyz[1]: .nan; expected a finite number
pose | pose: {parent: b, xyz: [1, 1e300, 2], rpy: [0, 0, 0]} | cameras[0].pose.xyz[1]: 1e300; expected metres, 100 km at
pose | pose: {parent: b, xyz: [1, 1, 2]} | cameras[0].pose: has no rotation; expected either quaternion_xyzw or rpy
pose | pose: {parent: base, xyz: [1, 2, 3], rpy: [0, 0, 0], quaternion_xyzw: [0, 0, 0, 1]} | cameras[0].pose: has both rotations; expected either
pose | pose: {parent: base, xyz: [1, 2, 3], rpy: [0, 0]} | cameras[0].pose.rpy: a list of 2; expected a list of 3
pose | pose: {parent: base, xyz: [1, 2, 3], quaternion_xyzw: [0, 0, 1]} | cameras[0].pose.quaternion_xyzw: a list of 3; expected a list of 4
pose | pose: {parent: base, xyz: [1, 2, 3], quaternion_xyzw: [0, 0, 0, 0]} | quaternion_xyzw: [0, 0, 0, 0] has length 0; expected a quaternion x, y, z, w of length 1
pose | pose: {parent: base, xyz: [1, 2, 3], quaternion_xyzw: [0, 0, 0, 1.0011]} | has length 1.0011; expected
pose | pose: {parent: base, xyz: [1, 2, 3], quaternion: [0, 0, 0, 1]} | scene.yaml:5: cameras[0].pose.quaternion: unknown key; expected quaternion_xyzw
depth | depth: [] | scene.yaml:6: cameras[0].depth: a list of 0; expected one image at least
depth | depth: none/*.png | scene.yaml:6: cameras[0].depth: none/*.png; expected a pattern that some file matches
depth | depth: {a: b} | cameras[0].depth: a map; expected a text
more_camera | stamps: [0] | scene.yaml:7: cameras[0].stamps: 1 stamps; expected one for each of the 2 images
more_camera | stamps: [1, 1] | cameras[0].stamps[1]: 1; expected more than 1, the stamp before
more_camera | stamps: [1, 0.5] | cameras[0].stamps[1]: 0.5; expected more than 1
more_camera | stamps: [1, later] | cameras[0].stamps[1]: later; expected a finite number
more_camera | depth_scale: 0 | scene.yaml:7: cameras[0].depth_scale: 0; expected a number above 0
more_camera | depth_scale: -0.001 | cameras[0].depth_scale: -0.001; expected a number above 0
more_camera | depth_scale: 1000 | cameras[0].depth_scale: 1000; expected metres per unit from 1e-6
more_camera | depth_scale: 1mm | cameras[0].depth_scale: 1mm; expected a finite number
more_camera | depth_offset_m: -4 | scene.yaml:7: cameras[0].depth_offset_m: -4; expected metres, -1 to 1
more_camera | depth_is: z | cameras[0].depth_is: z; expected one of axis, ray
more_camera | rectified: 2 | cameras[0].rectified: 2; expected true or false
more_camera | stamps: [0, 1700000000000] | cameras[0].stamps[1]: 1700000000000; expected seconds; this looks like milliseconds
more_camera | near_m: -1 | cameras[0].near_m: -1; expected a number, 0 or more
more_camera | far_m: 0 | cameras[0].far_m: 0; expected a number above 0
more_camera | near_m: 2\n    far_m: 2 | scene.yaml:8: cameras[0].far_m: 2; expected more than near_m, 2
more_camera | far_m: .inf | cameras[0].far_m: .inf; expected a finite number
end |  | scene.yaml:1: the key joints is missing
end | joints: j\njoins: k | scene.yaml:9: joins: unknown key; expected joints (the nearest), or another of robot, cameras
end | joints: j\nself_filter: {tolerance: 1} | scene.yaml:9: self_filter.tolerance: unknown key; expected tolerance_m
end | joints: j\nself_filter: | scene.yaml:9: self_filter: nothing; expected a map
end | joints: j\nevaluation: {range: 1} | scene.yaml:9: evaluation.range: unknown key; expected range_m
end | joints: j\nevaluation: {range_m: 1,5} | scene.yaml:9: evaluation.range_m: 1,5; expected a finite number, with a point in place of the comma
end | joints: j\nevaluation: {5} | scene.yaml:9: evaluation.5: unknown key
end | joints: j\nevaluation:\n  range_m: 1,5 | range_m: 1,5; expected a finite number, with a point in place of the comma
end | joints: j\nevaluation: {range_m: 0} | evaluation.range_m: 0; expected a number above 0
end | joints: j\nevaluation: {range_m: -1} | evaluation.range_m: -1; expected a number above 0
end | joints: j\nevaluation: {range_m: 50.5} | evaluation.range_m: 50.5; expected a finite number above 0 up to 50
end | joints: j\nevaluation: {range_m: .nan} | evaluation.range_m: .nan; expected a finite number
end | joints: j\nevaluation: {mean_direction: 1} | evaluation.mean_direction: 1; expected true or false
end | joints: j\nevaluation: {visibility: some} | evaluation.visibility: some; expected true or false
end | joints: j\nself_filter: {link_padding_m: {a: -1}} | self_filter.link_padding_m.a: -1; expected a number, 0 or more
end | joints: j\nsensor: {speckle_px: -1} | sensor.speckle_px: -1; expected a whole number, 0 or more
end | joints: j\nsensor: {speckle_px: 1.5} | sensor.speckle_px: 1.5; expected a whole number
end | joints: j\ntime: {max_skew_s: -1} | scene.yaml:9: time.max_skew_s: -1; expected a number, 0 or more
end | joints: j\ntime: {max_skew: 1} | scene.yaml:9: time.max_skew: unknown key; expected max_skew_s
end | joints: j\nsensor: {speckle: 1} | scene.yaml:9: sensor.speckle: unknown key; expected speckle_px (the nearest)
end | joints: j\nsensor: {holes: obstacle} | scene.yaml:9: sensor.holes: obstacle; expected space.no_reading: hides in its place, or a background of the camera (berth calibrate writes it)
end | joints: j\nspace: {no_reading: full} | scene.yaml:9: space.no_reading: full; expected one of unknown, free, hides
end | joints: j\nsensor: 3 | scene.yaml:9: sensor: 3; expected a map
end | joints: j\n? [a, b]\n: c | scene.yaml:9: a list of 2; expected a text
end | joints: j\n---\njoints: k | scene.yaml: several YAML documents; expected one
end | joints: j\n  wrong: k | scene.yaml:9 ... expected valid YAML
)");
  const std::map<std::string, std::string SceneText::*> lines = {
      {"robot", &SceneText::robot}, {"name", &SceneText::name},
      {"info", &SceneText::info},   {"pose", &SceneText::pose},
      {"depth", &SceneText::depth}, {"more_camera", &SceneText::more_camera},
      {"end", &SceneText::end}};
  int cases = 0;
  for (std::string row; std::getline(table, row); ++cases) {
    for (std::size_t at = 0; (at = row.find("\\n")) != std::string::npos;) row.replace(at, 2, "\n");
    const std::vector<std::string> cells = split(row, " | ");
    ASSERT_EQ(cells.size(), 3U) << row;
    const SceneText scene = with(lines.at(cells[0]), cells[1]);
    SCOPED_TRACE(scene.text());
    expect_parts(error_message([&] { read_text(scene); }), split(cells[2], " ... "));
  }
  EXPECT_EQ(cases, 79);
}

TEST(SceneErrors, RefusesANinthCamera) {
  SceneText scene;
  const std::string front = scene.text();
  const std::size_t first = front.find("  - "), last = front.find("joints:");
  std::string nine = front.substr(0, first);
  for (int c = 0; c < 9; ++c) {
    std::string camera = front.substr(first, last - first);
    nine += camera.replace(camera.find("front"), 5, "camera_" + std::to_string(c));
  }
  const TemporaryFolder folder;
  const auto file = folder.write("scene.yaml", nine + front.substr(last));
  expect_parts(error_message([&] { read_scene(file); }),
               {"scene.yaml:2: cameras: 9 cameras; expected 1 to 8 cameras"});
}

TEST(SceneErrors, TellsTheBeginningOfALongTextAlone) {
  const std::string urdf = "<robot name='r'>" + std::string(5000, ' ') + "</robot>";
  const TemporaryFolder folder;
  const std::string message = error_message([&] { read_scene(folder.write("robot.urdf", urdf)); });
  expect_parts(message, {"robot.urdf:1", "begins with <robot", "expected a map"});
  EXPECT_LT(message.size(), 300U);
}

TEST(SceneErrors, RefusesEveryNegativeNumberOfTheSelfFilter) {
  for (const std::string key : {"tolerance_m", "tolerance_per_m2", "padding_m",
                                "surface_tolerance_m", "flying_patch_radius_m"}) {
    for (const std::string value : {"-0.01", ".nan", "wide"}) {
      const SceneText scene =
          with(&SceneText::end, "joints: j\nself_filter: {" + key + ": " + value + "}");
      expect_parts(error_message([&] { read_text(scene); }),
                   {"scene.yaml:9: self_filter." + key + ": " + value + "; expected"});
    }
  }
}

TEST(SceneErrors, RefusesEveryLengthAndCountOfTheSensorThatIsNone) {
  const auto expect_refused = [](const std::string& key, const std::string& value) {
    const SceneText scene =
        with(&SceneText::end, "joints: j\nsensor: {" + key + ": " + value + "}");
    expect_parts(error_message([&] { read_text(scene); }),
                 {"scene.yaml:9: sensor." + key + ": " + value + "; expected"});
  };
  for (const std::string value : {"-0.01", ".nan", "wide"}) {
    expect_refused("phantom_radius_m", value);
  }
  for (const std::string key : {"speckle_px", "background_frames"}) {
    for (const std::string value : {"-1", "1.5", "many"}) expect_refused(key, value);
  }
}

TEST(SceneErrors, RefusesMissingOrSharedCameras) {
  const TemporaryFolder folder;
  const std::string camera =
      "  - {name: a, info: i, depth: [0.png], pose: {parent: b, xyz: [0, 0, 0], rpy: [0, 0, 0]}}\n";
  const std::vector<BadText> table = {
      {"robot: {urdf: r}\njoints: j\n", {"scene.yaml:1: the key cameras is missing"}},
      {"robot: {urdf: r}\njoints: j\ncameras: []\n",
       {"scene.yaml:3: cameras: 0 cameras; expected 1 to 8 cameras"}},
      {"robot: {urdf: r}\njoints: j\ncameras: {name: a}\n",
       {"scene.yaml:3: cameras: a map; expected a list"}},
      {"robot: {urdf: r}\njoints: j\ncameras:\n" + camera + camera,
       {"scene.yaml:5: cameras[1]: a second camera is named a; expected names that differ"}},
      {"joints: j\ncameras:\n" + camera, {"scene.yaml:1: the key robot is missing"}},
      {"", {"scene.yaml: no YAML document; expected one"}},
      {"~", {"scene.yaml:1: nothing; expected a map"}},
  };
  for (const BadText& bad : table) {
    SCOPED_TRACE(bad.text);
    const std::filesystem::path file = folder.write("scene.yaml", bad.text);
    expect_parts(error_message([&] { read_scene(file); }), bad.message_parts);
  }
  expect_parts(error_message([&] { read_scene(folder / "none.yaml"); }),
               {"none.yaml: No such file"});
}

}  // namespace
}  // namespace berth
