#include "lab/bench/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace berth::lab {
namespace {

using Line = std::vector<std::string>;

/// Heading and rows as words; the last column holds the remarks and may be empty throughout.
std::vector<Line> lines_of(const Table& table) {
  std::vector<Line> lines{{table.row_heading}};
  lines[0].insert(lines[0].end(), table.columns.begin(), table.columns.end());
  lines[0].emplace_back();
  for (const Table::Row& row : table.rows) {
    Line line{row.name};
    for (const auto& value : row.values) line.push_back(format_value(value));
    line.push_back(row.remark);
    lines.push_back(std::move(line));
  }
  const auto no_remark = [](const Line& line) { return line.back().empty(); };
  if (std::all_of(lines.begin(), lines.end(), no_remark)) {
    for (Line& line : lines) line.pop_back();
  }
  return lines;
}

}  // namespace

std::string format_value(std::optional<double> value) {
  if (!value) return "-";
  if (*value == 0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(*value))));
  const int digits = std::clamp(2 - exponent, 0, 6);
  return fmt::format("{:.{}f}", *value, digits);
}

std::string text_of(const Table& table) {
  const std::vector<Line> lines = lines_of(table);
  std::vector<std::size_t> width(lines[0].size(), 0);
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) width[i] = std::max(width[i], line[i].size());
  }
  const std::size_t last_value = table.columns.size();
  std::string text = fmt::format("{}\n{}\n", table.title, table.note);
  for (const Line& line : lines) {
    text += fmt::format("  {:<{}}", line[0], width[0]);
    for (std::size_t i = 1; i <= last_value; ++i)
      text += fmt::format("  {:>{}}", line[i], width[i]);
    if (line.size() > last_value + 1 && !line.back().empty()) text += "  " + line.back();
    text += '\n';
  }
  return text;
}

std::string markdown_of(const Table& table) {
  const std::vector<Line> lines = lines_of(table);
  std::string text = fmt::format("## {}\n\n{}\n\n", table.title, table.note);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    for (const std::string& word : lines[n]) text += fmt::format("| {} ", word);
    text += "|\n";
    if (n > 0) continue;
    for (std::size_t i = 0; i < lines[0].size(); ++i) {
      text += i == 0 || i > table.columns.size() ? "| --- " : "| ---: ";
    }
    text += "|\n";
  }
  return text;
}

}  // namespace berth::lab
