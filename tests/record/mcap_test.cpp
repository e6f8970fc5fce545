// MCAP files, and what recordings put into them, byte by byte.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "berth/files/depth_units.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/record/depth_message.hpp"
#include "berth/record/mcap_reader.hpp"
#include "berth/record/recorded_robot.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

mcap::Head some_head() {
  mcap::Head head;
  head.schemas.push_back({1, "berth.Thing", "jsonschema", "{}"});
  head.channels.push_back({7, 1, "/things", "json"});
  head.channels.push_back({9, 0, "/others", "json"});
  head.attachments.push_back({"a.txt", "text/plain", "some text"});
  head.attachments.push_back({"empty", "text/plain", ""});
  return head;
}

void write_some(const fs::path& file, const mcap::Head& head) {
  mcap::FileWriter out(file, head);
  for (int i = 0; i < 3; ++i) {
    mcap::ChunkBuilder chunk;
    chunk.add(7, 10 + i, "first " + std::to_string(i));
    chunk.add(9, 5 + i, std::string(1000, 'x'));
    std::string bytes;
    out.begin_chunk(chunk.finish(bytes));
    out.write(bytes);
  }
  out.finish();
}

TEST(Mcap, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  write_some(folder / "a.mcap", some_head());
  mcap::FileReader in(folder / "a.mcap");
  ASSERT_EQ(in.head().channels.size(), 2U);
  EXPECT_EQ(in.head().channels[0].topic, "/things");
  EXPECT_EQ(in.head().schemas[0].name, "berth.Thing");
  EXPECT_EQ(in.attachment("a.txt").data, "some text");
  EXPECT_EQ(in.attachment("empty").data, "");
  mcap::Message message;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(in.next(message));
    EXPECT_EQ(message.channel, 7);
    EXPECT_EQ(message.time_ns, 10U + i);
    EXPECT_EQ(message.data, "first " + std::to_string(i));
    ASSERT_TRUE(in.next(message));
    EXPECT_EQ(message.data.size(), 1000U);
  }
  EXPECT_FALSE(in.next(message));
}

/// Reads all of it; the error, or nothing.
std::string read_all(const fs::path& file) {
  return error_message([&] {
    mcap::FileReader in(file);
    for (mcap::Message message; in.next(message);) {
    }
  });
}

TEST(Mcap, TellsOfEachByteThatIsMissingAtTheEnd) {
  const TemporaryFolder folder;
  write_some(folder / "a.mcap", some_head());
  const std::string bytes = read_file_bytes(folder / "a.mcap");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const fs::path file = folder.write("cut.mcap", bytes.substr(0, size));
    ASSERT_FALSE(read_all(file).empty()) << size;
    if (size > 16) {
      expect_parts(read_all(file), {"cut.mcap", "cut off", "expected"});
    }
  }
}

TEST(Mcap, TellsOfEachByteThatIsDamagedBeforeTheIndex) {
  const TemporaryFolder folder;
  write_some(folder / "a.mcap", some_head());
  const std::string bytes = read_file_bytes(folder / "a.mcap");
  // The index behind the data is for other programs.
  const std::size_t end = bytes.rfind(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
  ASSERT_NE(end, std::string::npos);
  for (std::size_t i = 0; i < end; ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_FALSE(read_all(folder.write("damaged.mcap", damaged)).empty()) << i;
  }
}

TEST(Mcap, GivesTheChunksOfAFileThatIsCutOffAndThenSaysWhere) {
  const TemporaryFolder folder;
  write_some(folder / "a.mcap", some_head());
  const std::string bytes = read_file_bytes(folder / "a.mcap");
  std::size_t most = 0;
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    // Zeros are what a disk that lost its power may leave.
    const std::string zeros(size % 2 == 0 ? 100 : 0, '\0');
    const fs::path file = folder.write("cut.mcap", bytes.substr(0, size) + zeros);
    std::size_t messages = 0;
    EXPECT_FALSE(error_message([&] {
                   mcap::FileReader in(file);
                   for (mcap::Message message; in.next(message); ++messages) {
                   }
                 }).empty());
    EXPECT_EQ(messages % 2, 0U);
    EXPECT_GE(messages, most);
    most = messages;
  }
  EXPECT_EQ(most, 6U);
}

/// Files of a ring have no index and no checksum of all.
TEST(Mcap, ReadsFilesWithoutAnIndexAndTellsOfEachByteOfAnAttachmentThatIsDamaged) {
  const TemporaryFolder folder;
  const std::string head = mcap::beginning_of_file(some_head());
  mcap::ChunkBuilder chunk;
  chunk.add(7, 10, "some message");
  std::string bytes = head;
  chunk.finish(bytes);
  bytes += mcap::end_without_index();
  mcap::FileReader in(folder.write("a.mcap", bytes));
  EXPECT_EQ(in.attachment("a.txt").data, "some text");
  mcap::Message message;
  ASSERT_TRUE(in.next(message));
  EXPECT_EQ(message.data, "some message");
  EXPECT_FALSE(in.next(message));
  const std::size_t begin = head.find("some text");
  for (std::size_t i = begin; i < begin + 9; ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    expect_parts(read_all(folder.write("damaged.mcap", damaged)),
                 {"damaged.mcap", "damaged", "attachment a.txt", "expected"});
  }
}

TEST(Mcap, ReadsFilesOfMoreThanOneGibibyte) {
  const TemporaryFolder folder;
  write_some(folder / "a.mcap", some_head());
  // It has no content on disk.
  fs::resize_file(folder / "a.mcap", (std::uintmax_t{1} << 30) + 1);
  expect_parts(read_all(folder / "a.mcap"), {"cut off", "index ends"});
}

TEST(Mcap, RefusesWhatIsNoRecording) {
  const TemporaryFolder folder;
  expect_parts(read_all(folder.write("text.mcap", "some text that is long enough")),
               {"text.mcap", "does not begin as an MCAP file does", "expected"});
  EXPECT_FALSE(read_all(folder / "nothing.mcap").empty());
  EXPECT_FALSE(read_all(folder.path()).empty());
}

TEST(DepthMessage, KeepsEveryBitOfAReading) {
  DepthImage depth_m(3, 2, 0.5F);
  depth_m(1, 0) = kNoDepth;
  depth_m(2, 0) = -0.0F;
  depth_m(0, 1) = std::nextafter(1.0F, 2.0F);
  depth_m(1, 1) = HUGE_VALF;
  const std::uint32_t odd_nan = 0x7FC12345;
  std::memcpy(&depth_m(2, 1), &odd_nan, sizeof odd_nan);
  for (const char* name : {"", "a", "left", "camera"}) {
    const std::string message = depth_message(depth_m, 12.25, name);
    EXPECT_TRUE(same_bits(depth_of_message(message), depth_m));
    for (std::size_t size = 0; size < message.size(); ++size) {
      EXPECT_THROW(depth_of_message(message.substr(0, size)), std::runtime_error);
    }
  }
}

TEST(DepthMessage, KeepsEveryNumberOfAMillimetreCameraInHalfOfTheBytes) {
  DepthImage depth_m(256, 256);
  for (int i = 0; i < 1 << 16; ++i) {
    depth_m.pixels()[i] = depth_of(static_cast<std::uint16_t>(i), DepthUnits{});
  }
  const std::string message = depth_message(depth_m, 12.25, "left");
  EXPECT_LT(message.size(), (std::size_t{2} << 16) + 200);
  EXPECT_NE(message.find("16UC1"), std::string::npos);
  EXPECT_TRUE(same_bits(depth_of_message(message), depth_m));
  // One of another kind, and all are kept as they are.
  for (const float other_m : {std::nextafter(1.0F, 2.0F), -1.0F, 0.0F, 70.0F, HUGE_VALF}) {
    depth_m.pixels().back() = other_m;
    const std::string exact = depth_message(depth_m, 12.25, "left");
    EXPECT_NE(exact.find("32FC1"), std::string::npos);
    EXPECT_TRUE(same_bits(depth_of_message(exact), depth_m));
  }
}

TEST(DepthMessage, RefusesWhatIsNoDepthImage) {
  std::string message = depth_message(DepthImage(2, 1, 1.5F), 0, "left");
  expect_parts(error_message([&] { depth_of_message("no message"); }), {"CDR", "expected"});
  message.replace(message.find("16UC1"), 5, "8UC10");
  expect_parts(error_message([&] { depth_of_message(message); }),
               {"encoding 8UC10; expected 32FC1 or 16UC1"});
  message.replace(message.find("8UC10"), 5, "32FC1");
  expect_parts(error_message([&] { depth_of_message(message); }),
               {"2 x 1 px in 4 bytes; expected 4 bytes a pixel"});
}

TEST(Ply, KeepsEveryBitOfAMesh) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0.1F, -0.0F}, {1e-30F, 2, 3}, {4, 5, 1.0F / 3}, {7, 8, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 2, 0}};
  const std::string bytes = ply_of(mesh);
  const TriangleMesh again = mesh_of_ply(bytes);
  EXPECT_EQ(again.triangles, mesh.triangles);
  ASSERT_EQ(again.vertices_m.size(), 4U);
  EXPECT_EQ(std::memcmp(again.vertices_m.data(), mesh.vertices_m.data(), 4 * 12), 0);
  EXPECT_THROW(mesh_of_ply(bytes.substr(0, bytes.size() - 1)), std::runtime_error);
  EXPECT_THROW(mesh_of_ply("ply"), std::runtime_error);
  mesh.triangles[1][0] = 4;
  expect_parts(error_message([&] { mesh_of_ply(ply_of(mesh)); }), {"face 1", "4 vertices"});
}

}  // namespace
}  // namespace berth
