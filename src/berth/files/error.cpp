#include "berth/files/error.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {

void throw_bad_file(const FilePlace& place, std::string_view found, std::string_view expected) {
  std::string message = place.file.string();
  if (place.line > 0) message += fmt::format(":{}", place.line);
  if (!place.where.empty()) message += ": " + place.where;
  throw std::runtime_error(fmt::format("{}: {}; expected {}", message, found, expected));
}

}  // namespace berth
