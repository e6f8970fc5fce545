#include "berth/files/joints_csv.hpp"

#include <gtest/gtest.h>

#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

TEST(JointsCsv, GivesNamesTimesPositionsAndLines) {
  const TemporaryFolder folder;
  const auto file = folder.write("joints.csv", "time,a,b\n0.5,1,-2.25\n1.5,+3e-1,0.1\n");
  const JointTable table = read_joints_csv(file);
  EXPECT_EQ(table.file, file);
  EXPECT_EQ(table.names, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].time_s, 0.5);
  EXPECT_EQ(table.rows[0].positions, (std::vector<double>{1, -2.25}));
  EXPECT_EQ(table.rows[0].line, 2);
  EXPECT_EQ(table.rows[1].time_s, 1.5);
  EXPECT_EQ(table.rows[1].positions, (std::vector<double>{0.3, 0.1}));
  EXPECT_EQ(table.rows[1].line, 3);
}

TEST(JointsCsv, DoesNotMindBlanksLineEndsOrByteOrderMarks) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("joints.csv", "\xEF\xBB\xBFtime, a ,b\r\n 0,\t1 , 2\r\n1,3,4\r\n\r\n  \n");
  const JointTable table = read_joints_csv(file);
  EXPECT_EQ(table.names, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1].positions, (std::vector<double>{3, 4}));
}

TEST(JointsCsv, ARobotWithoutJointsHasTimesAlone) {
  const TemporaryFolder folder;
  const JointTable table = read_joints_csv(folder.write("joints.csv", "time\n0\n1\n"));
  EXPECT_TRUE(table.names.empty());
  EXPECT_EQ(table.rows.size(), 2U);
}

TEST(JointsCsv, RefusesABadFileAndSaysWhere) {
  const std::vector<BadText> table = {
      {"", {"joints.csv: is empty; expected a header: time"}},
      {"\r\n \n", {"joints.csv: is empty"}},
      {std::string("t\0i\0m\0e\0", 8), {"joints.csv: holds a zero byte; expected UTF-8 text"}},
      {"a,time\n1,2\n", {"joints.csv:1: the first column is 'a'; expected time"}},
      {"0,1\n1,2\n", {"joints.csv:1: the first column is '0'; expected time"}},
      {"time;a\n0;1\n", {"joints.csv:1: the first column is 'time;a'; expected time"}},
      {"time,a,b,a\n0,1,2,3\n",
       {"joints.csv:1: column 4 is 'a'; expected a joint's name that stands here once"}},
      {"time,time\n0,1\n", {"joints.csv:1: column 2 is 'time'; expected"}},
      {"time,a,\n0,1,2\n", {"joints.csv:1: column 3 is ''; expected"}},
      {"time,a\n", {"joints.csv: has no rows; expected one row"}},
      {"time,a\n0,1\n1\n", {"joints.csv:3: 1 fields; expected 2 as in the header"}},
      {"time,a\n0,1,2\n", {"joints.csv:2: 3 fields; expected 2"}},
      {"time,a\n0,1\n\n1,2\n", {"joints.csv:3: 1 fields; expected 2"}},
      {"time,a\n0,one\n", {"joints.csv:2: a: 'one'; expected a finite number"}},
      {"time,a\n0,1.5x\n", {"joints.csv:2: a: '1.5x'; expected a finite number"}},
      {"time,a\n0,\n", {"joints.csv:2: a: ''; expected a finite number"}},
      {"time,a\n0,+-1\n", {"joints.csv:2: a: '+-1'; expected a finite number"}},
      {"time,a\n0,nan\n", {"joints.csv:2: a: 'nan'; expected a finite number"}},
      {"time,a\n0,-inf\n", {"joints.csv:2: a: '-inf'; expected a finite number"}},
      {"time,a\n0,1e999\n", {"joints.csv:2: a: '1e999'; expected a finite number"}},
      {"time,a\nNaN,1\n", {"joints.csv:2: time: 'NaN'; expected a finite number"}},
      {"time,a\n1,0\n2,0\n2,0\n", {"joints.csv:4: time: 2; expected more than 2"}},
      {"time,a\n1,0\n0.5,0\n", {"joints.csv:3: time: 0.5; expected more than 1"}},
  };
  const TemporaryFolder folder;
  for (const BadText& bad : table) {
    SCOPED_TRACE(bad.text);
    const auto file = folder.write("joints.csv", bad.text);
    expect_parts(error_message([&] { read_joints_csv(file); }), bad.message_parts);
  }
  expect_parts(error_message([&] { read_joints_csv(folder / "none.csv"); }),
               {"none.csv: No such file", "expected"});
}

}  // namespace
}  // namespace berth
