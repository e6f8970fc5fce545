// OBJ and DAE files.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "berth/robot/mesh_file/mesh_file.hpp"
#include "tests/robot/error_text.hpp"
#include "tests/robot/mesh_writing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

TriangleMesh read(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return read_mesh_file(folder.write(name, text));
}

void expect_box(const TriangleMesh& mesh, const Eigen::Vector3f& min, const Eigen::Vector3f& max) {
  const Eigen::AlignedBox3f box = mesh.bounding_box_m();
  EXPECT_TRUE(box.min().isApprox(min, 1e-6F)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(max, 1e-6F)) << box.max().transpose();
}

double area_m2(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f p = mesh.vertices_m[a];
    area += (mesh.vertices_m[b] - p).cross(mesh.vertices_m[c] - p).norm() / 2;
  }
  return area;
}

TEST(ObjFile, PolygonsBecomeTriangles) {
  const auto mesh = read("part.obj",
                         "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv -1 1 0\n"
                         "f 1 2 3 4\nf 1 4 5\n");
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_NEAR(area_m2(mesh), 6 + 1.5, 1e-6);
  expect_box(mesh, {-1, 0, 0}, {2, 3, 0});
}

TEST(ObjFile, NegativeIndicesCountFromTheEnd) {
  const auto mesh = read("part.obj",
                         "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 2 3\nf -3 -2 -1\n"
                         "v 0 0 -4\nf -4 -3 -1\n");
  EXPECT_EQ(mesh.triangles.size(), 2U);
  expect_box(mesh, {0, 0, -4}, {1, 2, 3});
}

TEST(ObjFile, CornersWithTextureAndNormalAreRead) {
  const auto mesh = read("part.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 2 3\nvt 0 0\nvn 0 0 1\n"
                         "f 1/1/1 2/1/1 3/1/1\n");
  EXPECT_EQ(mesh.triangles.size(), 1U);
  expect_box(mesh, {0, 0, 0}, {1, 2, 3});
}

TEST(ObjFile, SeveralObjectsAllCount) {
  const auto mesh = read("part.obj",
                         "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
                         "o two\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 4 5 6\n");
  EXPECT_EQ(mesh.triangles.size(), 2U);
  expect_box(mesh, {0, 0, 0}, {1, 1, 5});
}

TEST(ObjFile, WithoutAFaceIsAnError) {
  const TemporaryFolder folder;
  for (const char* text :
       {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "v 0 0 0\nv 1 0 0\nl 1 2\n", "v 0 0 0\nv 1 0 0\np 1 2\n"}) {
    const auto file = folder.write("part.obj", text);
    expect_error([&] { read_mesh_file(file); }, {file.string(), "expected"});
  }
}

TEST(ObjFile, LineBesideTrianglesIsLeftOut) {
  const auto mesh = read("part.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\nv 9 9 9\nf 1 2 3\nl 1 4\n");
  EXPECT_EQ(mesh.triangles.size(), 1U);
  expect_box(mesh, {0, 0, 0}, {1, 2, 3});
}

TEST(ObjFile, LinesMayGoOnAndEndAnyWay) {
  const auto mesh = read("part.obj",
                         "\xEF\xBB\xBFv 0 0 0 # origin\r\nv 1 0 0 1 0.5 0\r\nv 0 2 \\\r\n 3\r\n"
                         "f 1 2 \\\n3");
  EXPECT_EQ(mesh.triangles.size(), 1U);
  expect_box(mesh, {0, 0, 0}, {1, 2, 3});
}

TEST(ObjFile, FourthNumberDividesTheOthers) {
  expect_box(read("part.obj", "v 0 0 0\nv 2 0 0 2\nv 0 4 6 2\nf 1 2 3\n"), {0, 0, 0}, {1, 2, 3});
}

TEST(ObjFile, ConcavePolygonKeepsItsArea) {
  // A square of 4 with a notch down to its middle: a fan around the first corner would cover it.
  const auto mesh = read("part.obj", "v 0 4 0\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 2 0\nf 1 2 3 4 5\n");
  EXPECT_NEAR(area_m2(mesh), 12, 1e-5);
}

TEST(ObjFile, MaterialsAreNotOpened) {
  const TemporaryFolder folder;
  folder.write("part.mtl", "newmtl a\nmap_Kd /nowhere.png\n");
  const auto file = folder.write("part.obj",
                                 "mtllib part.obj part.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 3\n"
                                 "usemtl a\nf 1 2 3\n");
  EXPECT_EQ(read_mesh_file(file).triangles.size(), 1U);
}

TEST(ObjFile, IsRefusedWithLineAndValue) {
  struct Bad {
    const char* line;
    std::string told;
  };
  const std::vector<Bad> all{
      {"v 0,5 0 0", ":4: a vertex has \"0,5\"; expected finite numbers"},
      {"v nan 0 0", ":4: a vertex has \"nan\"; expected"},
      {"v 1 2", ":4: a vertex of 2 numbers; expected 3"},
      {"v 1 2 3 4 5", ":4: a vertex of 5 numbers; expected 3"},
      {"v 1 2 3 0", ":4: w of a vertex is 0; expected"},
      {"f 1 2 9", ":4: a face's corner is \"9\"; expected the number of one of the 3 vertices"},
      {"f 1 2 0", ":4: a face's corner is \"0\"; expected"},
      {"f 1 2 -4", ":4: a face's corner is \"-4\"; expected"},
      {"f 1 2 x", ":4: a face's corner is \"x\"; expected"}};
  for (const auto& [line, told] : all) {
    const TemporaryFolder folder;
    const auto file =
        folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\n" + std::string(line) + "\nf 1 2 3\n");
    expect_error([&] { read_mesh_file(file); }, {file.string() + told});
  }
}

TEST(ObjFile, Utf16IsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.write("part.obj", std::string("v\0 \0"
                                                         "0\0\n\0",
                                                         8));
  expect_error([&] { read_mesh_file(file); }, {file.string() + ":1: a zero byte; expected"});
}

TEST(ObjFile, PolygonThatWouldTakeSecondsIsRefused) {
  const TemporaryFolder folder;
  std::string face = "f";
  for (int i = 0; i < 5000; ++i) face += " 1 2 3";
  const auto file = folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\n" + face + "\n");
  expect_error([&] { read_mesh_file(file); },
               {file.string() + ":4: a face of 15000 corners; expected 4096 at most"});
}

TEST(DaeFile, OnlyCornersOfTrianglesCount) {
  expect_box(read("part.dae", dae({})), {0, 0, 0}, {1, 2, 3});
}

TEST(DaeFile, UnitIsApplied) {
  expect_box(read("part.dae", dae({.unit = R"(<unit name="mm" meter="0.001"/>)"})), {0, 0, 0},
             {0.001F, 0.002F, 0.003F});
  expect_box(read("part.dae", dae({.unit = R"(<unit name="centimeter" meter="0.01"/>)"})),
             {0, 0, 0}, {0.01F, 0.02F, 0.03F});
  expect_box(read("part.dae", dae({.unit = R"(<unit meter="1" name="meter"/>)"})), {0, 0, 0},
             {1, 2, 3});
}

TEST(DaeFile, UpAxisIsNotApplied) {
  for (const char* up_axis : {"X_UP", "Y_UP", "Z_UP"})
    expect_box(read("part.dae", dae({.up_axis = up_axis})), {0, 0, 0}, {1, 2, 3});
}

TEST(DaeFile, NestedTransformsActFromTheRootDown) {
  // Inside out: (x, y, z) -> (2x, 2y, 2z) -> turned by 90 degrees around z -> moved by 10 in x.
  const auto mesh = read("part.dae", dae({.nodes = R"(
    <node id="a"><translate>10 0 0</translate><rotate>0 0 1 90</rotate>
      <node id="b"><matrix>2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 1</matrix>
        <instance_geometry url="#shape"/></node></node>)"}));
  expect_box(mesh, {6, 0, 0}, {10, 2, 6});
}

TEST(DaeFile, TransformsOfANodeActInTheirOrder) {
  const auto mesh = read("part.dae", dae({.nodes = R"(
    <node id="a"><scale>2 3 4</scale><translate>1 1 1</translate>
      <instance_geometry url="#shape"/></node>)"}));
  expect_box(mesh, {2, 3, 4}, {4, 9, 16});
}

TEST(DaeFile, UnitActsOnTranslationsToo) {
  const auto mesh = read("part.dae", dae({.unit = R"(<unit meter="0.01"/>)", .nodes = R"(
    <node id="a"><translate>100 0 0</translate><instance_geometry url="#shape"/></node>)"}));
  expect_box(mesh, {1, 0, 0}, {1.01F, 0.02F, 0.03F});
}

TEST(DaeFile, GeometryUsedTwiceAppearsTwice) {
  const auto mesh = read("part.dae", dae({.nodes = R"(
    <node id="a"><instance_geometry url="#shape"/></node>
    <node id="b"><translate>0 0 -5</translate><instance_geometry url="#shape"/></node>)"}));
  EXPECT_EQ(mesh.triangles.size(), 2U);
  expect_box(mesh, {0, 0, -5}, {1, 2, 3});
}

TEST(DaeFile, AGeometryThatIsGoneIsNamed) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "part.dae", dae({.nodes = R"(<node id="a"><instance_geometry url="#shape"/></node>
    <node id="b"><instance_geometry url="#gone"/></node>)"}));
  expect_error([&] { read_mesh_file(file); }, {file.string(), "gone"});
}

TEST(DaeFile, ANormalMayBeNoNumberAndIdsMayRepeatWhereNobodyRefersToThem) {
  std::string text = dae({.nodes = R"(<node id="n"><instance_geometry url="#shape"/></node>
    <node id="twice"/><node id="twice"/>)"});
  text.insert(text.find("<vertices"),
              "<source id=\"normals\"><float_array id=\"n_array\" count=\"3\">NaN 0 1</float_array>"
              "<technique_common><accessor count=\"1\" source=\"#n_array\" stride=\"3\"/>"
              "</technique_common></source>");
  expect_box(read("part.dae", text), {0, 0, 0}, {1, 2, 3});
}

TEST(GltfFile, YIsUp) {
  // (0, 0, 0), (1, 0, 0), (0, 2, 3).
  const std::string text = R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 2, 3]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAEBA"}]})";
  expect_box(read("part.gltf", text), {0, -3, 0}, {1, 0, 2});
}

TEST(DaeFile, WhatIsNotGeometryIsNotRead) {
  std::string text = dae({});
  text.insert(text.find("<library_geometries>"),
              "<library_animations><animation id=\"a\"><sampler id=\"s\"><input semantic=\"INPUT\" "
              "source=\"#nothing\"/></sampler><channel source=\"#s\" target=\"n/x\"/></animation>"
              "</library_animations><library_images><image id=\"i\"/></library_images>");
  expect_box(read("part.dae", text), {0, 0, 0}, {1, 2, 3});
}

TEST(DaeFile, MaterialsMayBeMissing) {
  const std::string binding = R"(<bind_material><technique_common>
    <instance_material symbol="red" target="#red">
      <bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/>
      <bind_material/></instance_material></technique_common></bind_material>)";
  const std::string node =
      R"(<node id="n"><instance_geometry url="#shape">)" + binding + "</instance_geometry></node>";
  std::string text = dae({.nodes = node});
  text.replace(text.find("<triangles"), 10, R"(<triangles material="red")");
  expect_box(read("part.dae", text), {0, 0, 0}, {1, 2, 3});
}

TEST(DaeFile, IsRefusedWithElementAndValue) {
  const std::string shape = R"(<instance_geometry url="#shape"/></node>)";
  const std::vector<std::pair<std::string, std::string>> all{
      {"<matrix>1 0 0</matrix>", "<matrix>: holds 3 numbers; expected 16"},
      {"<translate>1 0,5 0</translate>", "<translate>: holds \"0,5\"; expected numbers"},
      {"<skew>30 1 0 0 0 1 0</skew>", "<skew>: not supported; expected matrix"},
      {"<instance_controller url=\"#c\"/>", "<instance_controller>: a skin"}};
  for (const auto& [inside, told] : all) {
    const TemporaryFolder folder;
    const auto file = folder.write("part.dae", dae({.nodes = "<node id=\"n\">" + inside + shape}));
    expect_error([&] { read_mesh_file(file); }, {file.string(), told});
  }
}

TEST(DaeFile, CutOrWithoutGeometryIsAnError) {
  const TemporaryFolder folder;
  const std::string whole = dae({});
  for (const std::string& text :
       {whole.substr(0, whole.size() / 2), whole.substr(0, 60), dae({.nodes = R"(<node id="n"/>)"}),
        std::string("<html><body>404</body></html>")}) {
    const auto file = folder.write("part.dae", text);
    expect_error([&] { read_mesh_file(file); }, {file.string(), "expected"});
  }
}

}  // namespace
}  // namespace berth
