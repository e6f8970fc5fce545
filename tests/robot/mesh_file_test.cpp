// STL files, whole and broken. OBJ and DAE: mesh_text_test.cpp.
#include "berth/robot/mesh_file/mesh_file.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <cstring>

#include <algorithm>
#include <cctype>
#include <limits>

#include "tests/robot/error_text.hpp"
#include "tests/robot/mesh_writing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

void expect_two_triangles(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.triangles.size(), 2U);
  const Eigen::AlignedBox3f box = mesh.bounding_box_m();
  EXPECT_EQ(box.min(), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(box.max(), Eigen::Vector3f(1, 2, 3));
}

void expect_unreadable(const std::string& name, const std::string& bytes, const std::string& why) {
  const TemporaryFolder folder;
  const auto file = folder.write(name, bytes);
  expect_error([&] { read_mesh_file(file); }, {file.string(), why});
}

TEST(StlFile, BinaryGivesItsTriangles) {
  const TemporaryFolder folder;
  expect_two_triangles(read_mesh_file(folder.write("part.stl", binary_stl(two_triangles()))));
}

TEST(StlFile, BinaryThatBeginsWithSolidIsBinary) {
  const TemporaryFolder folder;
  for (const char* header : {"solid part", "solid", "solid facet endsolid"}) {
    const auto file = folder.write("part.stl", binary_stl(two_triangles(), header));
    expect_two_triangles(read_mesh_file(file));
  }
}

TEST(StlFile, TextGivesItsTriangles) {
  const TemporaryFolder folder;
  expect_two_triangles(read_mesh_file(folder.write("part.stl", text_stl(two_triangles()))));
}

TEST(StlFile, TextOfTwoSolidsGivesBoth) {
  const TemporaryFolder folder;
  const Triangles both = two_triangles();
  const auto file = folder.write("part.stl", text_stl({both[0]}) + text_stl({both[1]}));
  expect_two_triangles(read_mesh_file(file));
}

TEST(StlFile, WhatIsWrittenIsReadAgain) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0.25F, 0, 3.5F}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {2, 2, 3}};
  const TemporaryFolder folder;
  const std::string bytes = stl_bytes(mesh);
  EXPECT_EQ(bytes.size(), 84 + 3 * 50U);
  const TriangleMesh read = read_mesh_file(folder.write("part.stl", bytes));
  ASSERT_GE(read.triangles.size(), 2U);
  for (std::size_t t = 0; t < 2; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(read.vertices_m[read.triangles[t][k]], mesh.vertices_m[mesh.triangles[t][k]]);
    }
  }
  float normal_z = 0;
  std::memcpy(&normal_z, bytes.data() + 84 + 8, sizeof normal_z);
  EXPECT_EQ(normal_z, 1);
}

TEST(StlFile, CapitalEndingIsRead) {
  const TemporaryFolder folder;
  expect_two_triangles(read_mesh_file(folder.write("part.STL", binary_stl(two_triangles()))));
}

TEST(StlFile, TrianglesThatShareCornersShareVertices) {
  const TemporaryFolder folder;
  const auto mesh = read_mesh_file(folder.write("part.stl", binary_stl(two_triangles())));
  EXPECT_EQ(mesh.vertices_m.size(), 4U);
}

TEST(StlFile, CutBinaryIsAnErrorAtEveryLength) {
  for (const char* header : {"binary", "solid part"}) {
    const std::string whole = binary_stl(two_triangles(), header);
    for (const std::size_t length : {1UL, 40UL, 83UL, 84UL, 100UL, 134UL, whole.size() - 1})
      expect_unreadable("part.stl", whole.substr(0, length), "the STL holds");
  }
}

TEST(StlFile, CutTextIsAnErrorAtEveryLength) {
  const std::string whole = text_stl(two_triangles());
  for (std::size_t length = 1; length < whole.find("endsolid"); length += 7)
    expect_unreadable("part.stl", whole.substr(0, length), "the STL holds");
}

TEST(StlFile, TextCutInItsSecondSolidIsAnError) {
  const std::string whole = text_stl(two_triangles());
  expect_unreadable("part.stl", whole + whole.substr(0, whole.size() / 2), "the STL holds");
}

TEST(StlFile, BytesBehindTheTrianglesAreNoErrorUnlessTheyMayBeMoreOfThem) {
  const TemporaryFolder folder;
  for (const std::string& more : {std::string("\n"), std::string("more"), std::string(200, '\0')}) {
    const auto file = folder.write("part.stl", binary_stl(two_triangles()) + more);
    EXPECT_EQ(read_mesh_file(file).triangles.size(), 2U);
  }
  expect_unreadable("part.stl", binary_stl(two_triangles()) + std::string(49, 'x') + "y",
                    "the STL holds");
}

TEST(StlFile, TextMayBeInCapitalsAndEndInTwoWords) {
  const TemporaryFolder folder;
  std::string text = text_stl(two_triangles());
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  EXPECT_EQ(read_mesh_file(folder.write("a.stl", text)).triangles.size(), 2U);
  text.replace(text.rfind("ENDSOLID"), 8, "END SOLID");
  EXPECT_EQ(read_mesh_file(folder.write("b.stl", text)).triangles.size(), 2U);
}

TEST(StlFile, NoTriangleIsAnError) {
  expect_unreadable("part.stl", binary_stl({}), "the STL holds 84 bytes; expected text");
  expect_unreadable("part.stl", text_stl({}), "no facet; expected one at least");
}

TEST(StlFile, VertexThatIsNotFiniteIsAnError) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Triangles triangles = two_triangles();
    triangles[1][2].y() = bad;
    expect_unreadable("part.stl", binary_stl(triangles), "expected finite numbers");
    expect_unreadable("part.stl", text_stl(triangles), "expected finite numbers");
  }
}

TEST(StlFile, TextIsRefusedWithLineAndValue) {
  const std::string whole = text_stl(two_triangles());
  const auto with = [&](const std::string& old, const std::string& spoilt) {
    return std::string(whole).replace(whole.find(old), old.size(), spoilt);
  };
  expect_unreadable("part.stl", with("vertex 1 0 0", "vertex 0,5 0 0"),
                    ":5: x of a vertex is \"0,5\"; expected finite numbers");
  expect_unreadable("part.stl", with("vertex 1 0 0", "vertex 1 0"),
                    ":6: z of a vertex is \"vertex\"");
  expect_unreadable("part.stl", with("  vertex 1 0 0\n", ""),
                    ":6: a loop of 2 corners; expected three");
  expect_unreadable("part.stl", with("vertex 1 0 0", "vertex 1 0 0 vertex 1 1 1"),
                    ":7: a loop of 4 corners; expected three");
  expect_unreadable("part.stl", with("vertex 1 0 0", "vertx 1 0 0"), ":5: \"vertx\"; expected");
}

TEST(StlFile, NormalOfATextMayBeNoNumber) {
  std::string text = text_stl(two_triangles());
  text.replace(text.find("0 0 1"), 5, "-nan(ind) x 1,5");
  const TemporaryFolder folder;
  expect_two_triangles(read_mesh_file(folder.write("part.stl", text)));
}

TEST(StlFile, LinesMayBeOne) {
  std::string text = text_stl(two_triangles());
  std::replace(text.begin() + 11, text.begin() + text.rfind("endsolid") - 1, '\n', ' ');
  const TemporaryFolder folder;
  expect_two_triangles(read_mesh_file(folder.write("part.stl", text)));
}

TEST(MeshFile, PipeIsRefusedAndNotWaitedFor) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "part.stl";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_error([&] { read_mesh_file(pipe); }, {pipe.string() + ": is a pipe or device; expected"});
}

TEST(MeshFile, EmptyFileIsAnError) {
  for (const char* name : {"part.stl", "part.obj", "part.dae"})
    expect_unreadable(name, "", "empty");
}

TEST(MeshFile, MissingFileAndFolderAreErrors) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "missing.stl";
  expect_error([&] { read_mesh_file(missing); }, {missing.string() + ": No such file"});
  expect_error([&] { read_mesh_file(folder.path()); },
               {folder.path().string() + ": is a folder; expected a file"});
}

TEST(MeshFile, GarbageIsAnError) {
  std::string garbage;
  for (int i = 0; i < 400; ++i) garbage.push_back(static_cast<char>(i * 37 + 11));
  for (const char* name : {"part.stl", "part.obj", "part.dae", "part.xyz", "part"})
    expect_unreadable(name, garbage, "");
}

}  // namespace
}  // namespace berth
