#include "lab/bench/report.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "lab/bench/machine.hpp"

namespace berth::lab {
namespace {

std::ofstream open_file(const std::filesystem::path& file) {
  std::ofstream stream(file);
  if (!stream) {
    throw std::runtime_error(
        fmt::format("{}: cannot be written; expected a folder to write to", file.string()));
  }
  return stream;
}

void write_to(std::ofstream& stream, const std::string& text, const std::filesystem::path& file) {
  stream << text << std::flush;
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace

Report::Report(const std::filesystem::path& folder, const std::string& gl_renderer,
               const ReportFiles& files)
    : folder_(folder), files_(files) {
  std::vector<std::string> machine = describe_machine();
  if (!gl_renderer.empty()) machine.push_back("OpenGL: " + gl_renderer);
  for (const std::string& line : machine) fmt::print("{}\n", line);
  fmt::print("\n");
  std::fflush(stdout);
  if (folder_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  markdown_ = open_file(folder_ / files_.markdown);
  csv_ = open_file(folder_ / files_.csv);
  for (const std::string& line : machine) markdown_ << "- " << line << '\n';
  csv_ << "table,row,column,value\n";
}

void Report::add(const Table& table) {
  fmt::print("{}\n", text_of(table));
  std::fflush(stdout);
  if (folder_.empty()) return;
  write_to(markdown_, '\n' + markdown_of(table), folder_ / files_.markdown);
  write_to(csv_, csv_of(table), folder_ / files_.csv);
}

}  // namespace berth::lab
