#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace berth {

/// Seconds since 1970 have ten digits before the point; what has more is milliseconds or less.
inline constexpr double kLastTime_s = 1e11;
/// What was expected of a time above kLastTime_s, for messages.
std::string time_expected(double time);

/// Joint positions over time, in the file's own order of joints; rad, or m for prismatic joints.
struct JointTable {
  /// Where the joints were at a time.
  struct Row {
    double time_s = 0;
    std::vector<double> positions;  ///< one for each name
    int line = 0;                   ///< of the file, from 1
  };
  std::filesystem::path file;
  std::vector<std::string> names;
  std::vector<Row> rows;  ///< one at least; their times increase
};

/// Reads comma-separated values whose header is `time` and the joints' names. CRLF, a UTF-8 byte
/// order mark, blank lines at the end and spaces around the fields are accepted. Throws
/// std::runtime_error with file, line, column, value and what was expected: missing or empty file,
/// header without time in front, a name that is empty or there twice, a wrong number of fields, a
/// field that is no finite number, a time that does not increase, no rows.
JointTable read_joints_csv(const std::filesystem::path& file);

}  // namespace berth
