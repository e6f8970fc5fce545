#include "berth/scene/attach_parts.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "berth/files/file_bytes.hpp"
#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/scene/scene_file.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

void require_own_file(const SceneFile& scene, const fs::path& file) {
  const auto place = [](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); };
  for (const SceneAttachment& one : scene.attached) {
    if (one.mesh.empty() || place(one.mesh) != place(file)) continue;
    throw std::runtime_error(
        fmt::format("{}: is a mesh in {}, which is never overwritten; expected --out of another "
                    "name",
                    file.string(), scene.file.string()));
  }
}

}  // namespace

fs::path attached_file(const fs::path& new_file, const AttachedPart& part) {
  return new_file.parent_path() /
         fmt::format("{}.attached.{}.stl", new_file.stem().string(), part.name);
}

void attach_parts(const fs::path& scene_file, const AttachedParts& parts, const fs::path& new_file,
                  SceneChange& change) {
  for (const AttachedPart& part : parts.parts) {
    if (!part.is_taken) continue;
    const fs::path file = attached_file(new_file, part);
    require_own_file(read_scene(scene_file), file);
    change.attached.push_back({part.link, file, part.name});
  }
}

void write_attached_parts(const AttachedParts& parts, const fs::path& new_file) {
  for (const AttachedPart& part : parts.parts) {
    if (part.is_taken) write_file_bytes(attached_file(new_file, part), stl_bytes(part.mesh_L));
  }
}

}  // namespace berth
