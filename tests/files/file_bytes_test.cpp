#include "berth/files/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

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

}  // namespace
}  // namespace berth
