#include "berth/scene/moved_path.hpp"

#include "berth/files/glob.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return fs::absolute(file).lexically_normal().parent_path();
}

fs::path real_path(const fs::path& path) {
  fs::path result = fs::weakly_canonical(fs::absolute(path).lexically_normal());
  return result.has_filename() ? result : result.parent_path();
}

}  // namespace

bool is_same_path(const fs::path& a, const fs::path& b) { return real_path(a) == real_path(b); }

PathMove::PathMove(const fs::path& from_file, const fs::path& to_file)
    : from_(folder_of(from_file)), to_(folder_of(to_file)), stays_(is_same_path(from_, to_)) {}

fs::path PathMove::path(const fs::path& path) const {
  if (stays_ || path.is_absolute()) return path;
  // The reader of a scene takes ".." away by the text alone, others by the file system: a relative
  // path has to hold for both.
  const fs::path target = (from_ / path).lexically_normal();
  const fs::path relative = target.lexically_relative(to_);
  return is_same_path(real_path(to_) / relative, target) ? relative : target;
}

std::string PathMove::pattern(const std::string& pattern) const {
  if (stays_ || fs::path(pattern).is_absolute()) return pattern;
  return (fs::path(escape_glob(path(".").string())) / pattern).lexically_normal().string();
}

}  // namespace berth
