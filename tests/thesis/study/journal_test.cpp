// What a study that was stopped leaves, and what it takes up again.
#include "thesis/study/journal.hpp"

#include <gtest/gtest.h>

#include "berth/files/file_bytes.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::lab {
namespace {

const Identity kIdentity = {{"commit", "abc"}, {"seed", "1"}};
constexpr const char* kHeader = "scene,step,time_ms,pairs";

class JournalOnDisk : public ::testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "measurements.csv"; }

  /// The message of a journal that cannot be opened.
  std::string refusal(const Identity& identity) const {
    return error_message([&] { Journal(folder_.path(), identity, kHeader, 2); });
  }

  void write_two_lines() const {
    Journal journal(folder_.path(), kIdentity, kHeader, 2);
    journal.add("a,1", "0.5,100");
    journal.add("a,2", "0.25,50");
  }

  const TemporaryFolder folder_;
};

TEST_F(JournalOnDisk, KnowsWhatWasWrittenBefore) {
  write_two_lines();
  Journal journal(folder_.path(), kIdentity, kHeader, 2);
  EXPECT_EQ(journal.found_lines(), 2u);
  EXPECT_TRUE(journal.has("a,1"));
  EXPECT_TRUE(journal.has("a,2"));
  EXPECT_FALSE(journal.has("a,3"));
  EXPECT_FALSE(journal.has("a"));
}

TEST_F(JournalOnDisk, DropsALineThatWasCut) {
  write_two_lines();
  const std::string whole = read_file_bytes(file());
  const std::string first = whole.substr(0, whole.size() - std::string("a,2,0.25,50\n").size());
  for (std::size_t size = first.size(); size < whole.size(); ++size) {
    write_file_bytes(file(), whole.substr(0, size));
    {
      Journal journal(folder_.path(), kIdentity, kHeader, 2);
      EXPECT_TRUE(journal.has("a,1"));
      EXPECT_FALSE(journal.has("a,2")) << "cut at " << size;
      journal.add("a,2", "0.25,50");
    }
    EXPECT_EQ(read_file_bytes(file()), whole);
  }
}

TEST_F(JournalOnDisk, BeginsWhereOnlyTheIdentityWasWritten) {
  write_two_lines();
  std::filesystem::remove(file());
  Journal journal(folder_.path(), kIdentity, kHeader, 2);
  EXPECT_EQ(journal.found_lines(), 0u);
}

TEST_F(JournalOnDisk, RefusesAnotherStudyAndNamesWhatDiffers) {
  write_two_lines();
  const std::string before = read_file_bytes(file());
  const std::string message = refusal({{"commit", "abc"}, {"seed", "7"}});
  EXPECT_NE(message.find("study.json: seed: \"1\"; expected \"7\""), std::string::npos) << message;
  EXPECT_EQ(read_file_bytes(file()), before);
}

TEST_F(JournalOnDisk, RefusesFilesThatAreNotItsOwn) {
  write_two_lines();
  write_file_bytes(file(), std::string(kHeader) + "\na,1,0.5\n");
  EXPECT_NE(refusal(kIdentity).find("measurements.csv:2"), std::string::npos) << refusal(kIdentity);
  write_file_bytes(file(), "other,columns\n");
  EXPECT_NE(refusal(kIdentity).find("measurements.csv:1"), std::string::npos) << refusal(kIdentity);
  write_file_bytes(folder_ / "study.json", "[1");
  EXPECT_NE(refusal(kIdentity).find("study.json: is no JSON object"), std::string::npos);
  std::filesystem::remove(folder_ / "study.json");
  EXPECT_NE(refusal(kIdentity).find("is there without study.json"), std::string::npos);
}

}  // namespace
}  // namespace berth::lab
