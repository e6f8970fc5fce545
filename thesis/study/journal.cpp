#include "thesis/study/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"

namespace berth::lab {
namespace {

namespace fs = std::filesystem;

void require_same(const fs::path& file, const Identity& identity) {
  const auto found =
      nlohmann::json::parse(read_file_bytes(file), nullptr, /*allow_exceptions=*/false);
  if (!found.is_object()) throw_bad_file({file}, "is no JSON object", "what berth_study wrote");
  for (const auto& [name, value] : identity) {
    const auto member = found.find(name);
    const bool is_text = member != found.end() && member->is_string();
    const std::string there = is_text ? member->get<std::string>() : "nothing";
    if (there == value) continue;
    throw_bad_file({file, 0, name}, fmt::format("\"{}\"", there),
                   fmt::format("\"{}\" as in this run; a new folder for another study, or the "
                               "same options to go on with this one",
                               value));
  }
}

/// The end of the n-th field of a line.
std::size_t end_of_fields(const std::string& line, int n) {
  std::size_t end = 0;
  for (int i = 0; i < n && end != std::string::npos; ++i) end = line.find(',', end + (i > 0));
  return end;
}

/// Reads the keys of all whole lines after the header. Returns the bytes of the whole lines.
std::size_t read_keys(const fs::path& file, const std::string& header, int key_columns,
                      std::unordered_set<std::string>& keys) {
  const std::string bytes = read_file_bytes(file);
  const auto commas = std::count(header.begin(), header.end(), ',');
  std::size_t begin = 0;
  int number = 1;
  for (std::size_t end; (end = bytes.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = bytes.substr(begin, end - begin);
    if (number == 1 && line != header) {
      throw_bad_file({file, 1}, fmt::format("\"{}\"", line), fmt::format("\"{}\"", header));
    }
    if (std::count(line.begin(), line.end(), ',') != commas) {
      throw_bad_file({file, number}, fmt::format("\"{}\"", line),
                     fmt::format("{} columns", commas + 1));
    }
    if (number > 1) keys.insert(line.substr(0, end_of_fields(line, key_columns)));
    ++number;
  }
  return begin;
}

}  // namespace

Journal::Journal(const fs::path& folder, const Identity& identity, std::string header,
                 int key_columns)
    : file_(folder / "measurements.csv") {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path description = folder / "study.json";
  if (fs::exists(description)) {
    require_same(description, identity);
  } else if (fs::exists(file_)) {
    throw_bad_file({file_}, "is there without study.json", "a new folder, or both files");
  } else {
    write_file_bytes(description, nlohmann::json(identity).dump(1) + "\n");
  }
  if (!fs::exists(file_)) write_file_bytes(file_, header + "\n");
  const std::size_t whole_bytes = read_keys(file_, header, key_columns, keys_);
  fs::resize_file(file_, whole_bytes);
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0) throw_bad_file({file_}, std::strerror(errno), "a file to write to");
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::add(const std::string& key, const std::string& values) {
  const std::string line = fmt::format("{},{}\n", key, values);
  const std::scoped_lock lock(mutex_);
  const auto written = ::write(descriptor_, line.data(), line.size());
  if (written != static_cast<ssize_t>(line.size())) {
    throw_bad_file({file_}, written < 0 ? std::strerror(errno) : "is cut: the disk is full",
                   "room for more lines");
  }
}

}  // namespace berth::lab
