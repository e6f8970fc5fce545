#include "berth/files/glob.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

using Names = std::vector<std::string>;

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
