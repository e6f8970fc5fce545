// What a benchmark found: as text and Markdown.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace berth::lab {

struct Table {
  struct Row {
    std::string name;
    /// One for each column; nothing where nothing was measured.
    std::vector<std::optional<double>> values;
    std::string remark;
  };

  std::string title;
  /// What was measured and how, in a sentence or two.
  std::string note;
  /// The heading of the rows' names.
  std::string row_heading;
  /// Each names its unit.
  std::vector<std::string> columns;
  std::vector<Row> rows;
};

/// Three significant digits, without an exponent; "-" for nothing.
std::string format_value(std::optional<double> value);

/// Columns side by side, for a terminal.
std::string text_of(const Table& table);
/// Under a heading of the second level.
std::string markdown_of(const Table& table);

}  // namespace berth::lab
