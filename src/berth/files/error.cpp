#include "berth/files/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace berth {
namespace {

std::string text_without_line(const FilePlace& place, std::string_view found,
                              std::string_view expected) {
  const std::string where = place.where.empty() ? "" : place.where + ": ";
  return fmt::format("{}{}; expected {}", where, found, expected);
}

std::string text_of_place(const FilePlace& place) {
  const std::string file = place.file.string();
  return place.line > 0 ? fmt::format("{}:{}", file, place.line) : file;
}

}  // namespace

BadFile::BadFile(FilePlace place, std::string_view found, std::string_view expected)
    : runtime_error(text_of_place(place) + ": " + text_without_line(place, found, expected)),
      place_(std::move(place)),
      without_line_(text_without_line(place_, found, expected)) {}

void throw_bad_file(const FilePlace& place, std::string_view found, std::string_view expected) {
  throw BadFile(place, found, expected);
}

}  // namespace berth
