#include "berth/files/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "berth/files/glob.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

using Names = std::vector<std::string>;

/// No file may grow beyond a few bytes while this lives, as on a disk that is full.
class FullDisk {
 public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit small = before_;
    small.rlim_cur = 16;
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(FileInParts, AppearsWithAllItsPartsWhenItIsKept) {
  const TemporaryFolder folder;
  folder.write("x.txt", "before");
  {
    FileInParts file(folder / "x.txt");
    file.write("one ");
    file.write("two");
    EXPECT_EQ(read_file_bytes(folder / "x.txt"), "before");
    file.keep();
  }
  EXPECT_EQ(read_file_bytes(folder / "x.txt"), "one two");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"x.txt"});
}

TEST(FileInParts, IsGoneWhereItIsNotKept) {
  const TemporaryFolder folder;
  FileInParts(folder / "x.txt").write("one");
  EXPECT_TRUE(folder.names().empty());
}

TEST(FileInParts, APieceThatFindsNoRoomLeavesThoseBefore) {
  const TemporaryFolder folder;
  {
    const FullDisk full;
    FileInParts file(folder / "x.txt");
    file.write("one\n");
    expect_parts(error_message([&] { file.write(std::string(100'000, 'x')); }),
                 {"x.txt: cannot be written: File too large"});
    file.keep();
  }
  EXPECT_EQ(read_file_bytes(folder / "x.txt"), "one\n");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"x.txt"});
}

TEST(FileBytes, ComeBackAsTheyWereWritten) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xFF", 6);
  write_file_bytes(folder / "x.bin", bytes);
  EXPECT_EQ(read_file_bytes(folder / "x.bin"), bytes);
  write_file_bytes(folder / "x.bin", "");
  EXPECT_EQ(read_file_bytes(folder / "x.bin"), "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"x.bin"});
}

TEST(FileBytes, MissingFileOrFolderIsNamed) {
  const TemporaryFolder folder;
  expect_parts(error_message([&] { read_file_bytes(folder / "none.txt"); }),
               {"none.txt: No such file or directory; expected a readable file"});
  expect_parts(error_message([&] { read_file_bytes(folder / ""); }), {"is a folder; expected"});
  expect_parts(error_message([&] { write_file_bytes(folder / "no/x.txt", "x"); }),
               {"no/x.txt: cannot be written: No such file or directory; expected"});
}

TEST(FileBytes, WhatHasNoEndIsRefusedAndNotWaitedFor) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder / "zero");
  for (const char* name : {"pipe", "zero"}) {
    expect_parts(error_message([&] { read_file_bytes(folder / name); }),
                 {std::string(name) + ": is a pipe or device; expected a regular file"});
  }
  std::filesystem::create_symlink("loop", folder / "loop");
  expect_parts(error_message([&] { read_file_bytes(folder / "loop"); }),
               {"loop: Too many levels of symbolic links; expected a readable file"});
}

TEST(FileBytes, FailedWriteKeepsTheOldFileAndLeavesNoOther) {
  const TemporaryFolder folder;
  write_file_bytes(folder / "old.txt", "old");
  const std::string much(100'000, 'x');
  {
    const FullDisk full;
    expect_parts(error_message([&] { write_file_bytes(folder / "old.txt", much); }),
                 {"old.txt: cannot be written: File too large"});
    expect_parts(error_message([&] { write_file_bytes(folder / "new.txt", much); }), {"new.txt"});
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"old.txt"});
  EXPECT_EQ(read_file_bytes(folder / "old.txt"), "old");
}

TEST(FileBytes, WriteNeverTakesThePlaceOfAFolderOrDevice) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "images");
  // A pipe stands for devices: code that is wrong must not be let loose on /dev.
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const char* name : {"images", "pipe"}) {
    expect_parts(error_message([&] { write_file_bytes(folder / name, "x"); }),
                 {std::string(name) + ": is there and no regular file; expected"});
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"images", "pipe"}));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

/// Written and found.
Names sorted(const Names& names) {
  const TemporaryFolder folder;
  for (const std::string& name : names) folder.write(name, "");
  Names found;
  for (const auto& file : glob_files(folder.path(), "*.png")) found.push_back(file.filename());
  return found;
}

TEST(Glob, SortsNumbersByTheirValue) {
  const Names counted{"a1.png", "a2.png", "a10.png"};
  EXPECT_EQ(sorted({"a10.png", "a1.png", "a2.png"}), counted);
  const Names in_parts{"3.8.png", "3.9.png", "3.10.png", "3.11.png"};
  EXPECT_EQ(sorted({"3.10.png", "3.11.png", "3.9.png", "3.8.png"}), in_parts);
  const Names each_fifth{"3.0.png", "3.5.png", "3.10.png", "3.15.png"};
  EXPECT_EQ(sorted({"3.10.png", "3.15.png", "3.5.png", "3.0.png"}), each_fifth);
}

TEST(Glob, SortsTimesWhoseLastZerosWereCutAsTimes) {
  const Names times{"1700000000.05.png", "1700000000.16.png", "1700000000.7.png", "1700000001.png",
                    "1700000001.032.png"};
  EXPECT_EQ(sorted({times[2], times[4], times[1], times[3], times[0]}), times);
  const Names short_ones{"d0.033.png", "d0.066.png", "d0.1.png", "d0.133.png", "d0.2.png"};
  EXPECT_EQ(sorted({short_ones[4], short_ones[2], short_ones[3], short_ones[1], short_ones[0]}),
            short_ones);
}

}  // namespace
}  // namespace berth
