#include "berth/scene/moved_path.hpp"

#include "berth/files/glob.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return fs::absolute(file).lexically_normal().parent_path();
}

}  // namespace

PathMove::PathMove(const fs::path& from_file, const fs::path& to_file)
    : from_(folder_of(from_file)),
      to_(folder_of(to_file)),
      stays_(fs::weakly_canonical(from_) == fs::weakly_canonical(to_)) {}

fs::path PathMove::path(const fs::path& path) const {
  if (stays_ || path.is_absolute()) return path;
  // The reader of a scene takes ".." away by the text alone, others by the file system: a relative
  // path has to hold for both.
  const fs::path target = (from_ / path).lexically_normal();
  const fs::path relative = target.lexically_relative(to_);
  const fs::path found = fs::weakly_canonical(to_) / relative;
  return fs::weakly_canonical(found) == fs::weakly_canonical(target) ? relative : target;
}

std::string PathMove::pattern(const std::string& pattern) const {
  if (stays_ || fs::path(pattern).is_absolute()) return pattern;
  return (fs::path(escape_glob(path(".").string())) / pattern).lexically_normal().string();
}

}  // namespace berth
