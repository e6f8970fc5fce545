#include "berth/files/joints_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/files/number.hpp"

namespace berth {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t\r";

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// The trimmed pieces between separators: one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t end = text.find(separator); end != std::string_view::npos;
       end = text.find(separator)) {
    pieces.push_back(trim(text.substr(0, end)));
    text.remove_prefix(end + 1);
  }
  pieces.push_back(trim(text));
  return pieces;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<std::string_view> lines = split(text, '\n');
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

std::vector<std::string> read_header(const FilePlace& place, std::string_view line) {
  const std::vector<std::string_view> fields = split(line, ',');
  if (fields[0] != "time") {
    throw_bad_file(place, fmt::format("the first column is '{}'", fields[0]),
                   fields[0].find(';') != std::string_view::npos
                       ? "time, and commas between the columns"
                   : fields[0].starts_with('"') ? "time, without quotation marks"
                                                : "time");
  }
  std::vector<std::string> names;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::string name(fields[i]);
    if (name.empty() || name == "time" ||
        std::find(names.begin(), names.end(), name) != names.end()) {
      throw_bad_file(place, fmt::format("column {} is '{}'", i + 1, name),
                     "a joint's name that stands here once");
    }
    names.push_back(name);
  }
  return names;
}

double read_field(FilePlace place, std::string_view column, std::string_view field) {
  place.where = column;
  const std::optional<double> value = parse_finite(field);
  if (!value) throw_bad_file(place, fmt::format("'{}'", field), "a finite number");
  return *value;
}

JointTable::Row read_row(const FilePlace& place, const std::vector<std::string>& names,
                         std::string_view line) {
  const std::vector<std::string_view> fields = split(line, ',');
  if (fields.size() != names.size() + 1) {
    throw_bad_file(place, fmt::format("{} fields", fields.size()),
                   fmt::format("{} as in the header", names.size() + 1));
  }
  JointTable::Row row{read_field(place, "time", fields[0]), {}, place.line};
  for (std::size_t i = 0; i < names.size(); ++i) {
    row.positions.push_back(read_field(place, names[i], fields[i + 1]));
  }
  return row;
}

}  // namespace

std::string time_expected(double time) {
  return fmt::format("seconds; this looks like {}", time > 1e17   ? "nanoseconds"
                                                    : time > 1e14 ? "microseconds"
                                                                  : "milliseconds");
}

JointTable read_joints_csv(const std::filesystem::path& file) {
  const std::string text = read_file_bytes(file);
  if (text.find('\0') != std::string::npos) {
    throw_bad_file({file}, "holds a zero byte", "UTF-8 text, not UTF-16");
  }
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty()) throw_bad_file({file}, "is empty", "a header: time, then joint names");
  JointTable table{file, read_header({file, 1, ""}, lines[0]), {}};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const FilePlace place{file, static_cast<int>(i) + 1, ""};
    JointTable::Row row = read_row(place, table.names, lines[i]);
    if (row.time_s > kLastTime_s) {
      throw_bad_file({file, place.line, "time"}, fmt::format("{}", row.time_s),
                     time_expected(row.time_s));
    }
    if (!table.rows.empty() && row.time_s <= table.rows.back().time_s) {
      throw_bad_file({file, place.line, "time"}, fmt::format("{}", row.time_s),
                     fmt::format("more than {}, the row before", table.rows.back().time_s));
    }
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) throw_bad_file({file}, "has no rows", "one row of positions at least");
  return table;
}

}  // namespace berth
