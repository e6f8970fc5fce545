// Broken files are refused by std::exception or read, and nothing else: the fuzzers' first inputs,
// bombs, and what the fuzzers found.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include "berth/files/file_bytes.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/reader_inputs.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> inputs_of(std::string_view reader) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(BERTH_BROKEN_FILES) / reader)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The message of the refusal; empty where the input was read.
std::string refusal(const ReaderInput& reader, const fs::path& input) {
  const std::string bytes = read_file_bytes(input);
  return error_message<std::exception>([&] {
    reader.read({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  });
}

double most_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

class EachReader : public testing::TestWithParam<ReaderInput> {};

TEST_P(EachReader, RefusesOrReadsEveryInput) {
  const auto files = inputs_of(GetParam().name);
  ASSERT_GE(files.size(), 3U);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename());
    const auto begin = std::chrono::steady_clock::now();
    const std::string message = refusal(GetParam(), file);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    // Far above what any input needs, far below what a bomb does.
    EXPECT_LT(took.count(), 30);
    const bool is_seed = file.filename().string().starts_with("seed");
    // The 8-bit seed is one of the link ids, no depth image.
    if (is_seed && file.stem() != "seed_8_bit") {
      EXPECT_EQ(message, "");
    }
    // Names the file that it was written to.
    if (!message.empty()) {
      EXPECT_EQ(message.front(), '/') << message;
    }
  }
}

TEST_P(EachReader, RefusesEveryBomb) {
  for (const fs::path& file : inputs_of(GetParam().name)) {
    const std::string name = file.filename();
    const std::vector<std::string> bombs{"bomb", "claims_4", "of_itself", "unfolds", "deep_"};
    const auto is_in_name = [&](const std::string& word) { return name.find(word) != name.npos; };
    if (std::none_of(bombs.begin(), bombs.end(), is_in_name)) continue;
    if (name.starts_with("material_of_itself")) continue;  // not opened
    EXPECT_NE(refusal(GetParam(), file), "") << name;
  }
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(most_memory_mb(), 1024);
#endif
}

INSTANTIATE_TEST_SUITE_P(BrokenFiles, EachReader,
                         testing::ValuesIn(reader_inputs().begin(), reader_inputs().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace berth
