#include "thesis/study/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <stdexcept>

#include "lab/measure/instruction_set.hpp"
#include "lab/measure/machine.hpp"
#include "thesis/study/page.hpp"
#include "thesis/study/sweep.hpp"

namespace berth::lab {
namespace {

namespace fs = std::filesystem;

constexpr int kDrawnScenes = 20;
constexpr int kQuickDrawnScenes = 3;
/// Brute force takes seconds for each of its points.
constexpr int kDrawnScenesOfBruteForce = 2;
/// Of OpenGL on the processor, where each set takes as long as a hundred of them on a GPU.
constexpr int kDrawnScenesOfSoftware = 1;

std::vector<StudyScene> scenes_of(const StudySettings& settings) {
  const auto bundled = open_recording(settings.bundled_scene, "Bundled scene");
  std::vector<StudyScene> scenes = {recorded_scene(bundled, SceneKind::bundled)};
  // The quick ones are smaller, since even one brute force over large images takes seconds.
  const auto drawn = settings.quick
                         ? drawn_scenes(*bundled, settings.seed, kQuickDrawnScenes, 320, 240)
                         : drawn_scenes(*bundled, settings.seed, kDrawnScenes, 640, 480);
  scenes.insert(scenes.end(), drawn.begin(), drawn.end());
  for (const fs::path& file : settings.scenes) {
    scenes.push_back(
        recorded_scene(open_recording(file, recording_title(file)), SceneKind::recording));
  }
  scenes.push_back(worst_case_scene());
  std::set<std::string> names;
  for (const StudyScene& scene : scenes) {
    if (names.insert(scene.name).second) continue;
    throw std::runtime_error(fmt::format(
        "--scene: \"{}\" is there twice; expected scene files in folders of different names",
        scene.name));
  }
  return scenes;
}

/// Whether the part is measured on the n-th scene of this kind.
bool has_part(Part part, SceneKind kind, int n, bool quick) {
  switch (part) {
    case Part::brute_force:
      return (kind == SceneKind::bundled && !quick) ||
             (kind == SceneKind::drawn && n < (quick ? 1 : kDrawnScenesOfBruteForce));
    case Part::surveillance_length:
      return kind != SceneKind::worst_case;
    case Part::every_pair:
      return kind == SceneKind::worst_case;
    case Part::parameters:
    case Part::exact:
    case Part::gl_hybrid:
    case Part::gl_lattice:
    case Part::gl_exact:
      return true;
  }
  return false;
}

std::vector<Task> tasks_of(const std::vector<StudyScene>& scenes, bool quick, const GlContext* gl) {
  std::vector<Task> tasks;
  for (const Part part : kParts) {
    if (runs_on_opengl(part) && !gl) continue;
    const bool in_software = runs_on_opengl(part) && gl->is_software();
    const std::vector<ParameterSet> sets =
        sets_of(part, quick || in_software ? quick_extent() : full_extent());
    std::map<SceneKind, int> scenes_of_kind;
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      const SceneKind kind = scenes[s].kind;
      const int n = scenes_of_kind[kind]++;
      if (!has_part(part, kind, n, quick)) continue;
      if (in_software && kind == SceneKind::drawn && n >= kDrawnScenesOfSoftware) continue;
      for (const ParameterSet& set : sets) tasks.push_back({s, set});
    }
  }
  return tasks;
}

/// As make_page.py knows it.
std::string name_of(const GlContext* gl) {
  if (!gl) return "none";
  return gl->renderer() + (gl->is_software() ? ", software" : "");
}

Identity identity_of(const StudySettings& settings, const GlContext* gl) {
  std::vector<std::string> scenes;
  for (const fs::path& file : settings.scenes) scenes.push_back(fs::canonical(file).string());
  return {{"commit", commit_name()},
          {"compiler", compiler_name()},
          {"extent", settings.quick ? "quick" : "full"},
          {"OpenGL", name_of(gl)},
          {"instruction set", best_instruction_set()},
          {"processor", processor_name()},
          {"recordings", scenes.empty() ? "none" : fmt::format("{}", fmt::join(scenes, ", "))},
          {"seed", std::to_string(settings.seed)}};
}

}  // namespace

void run_study(const StudySettings& settings) {
  require_page_program();
  std::optional<GlContext> context;
  if (settings.gl_device) context.emplace(*settings.gl_device);
  GlContext* gl = context ? &*context : nullptr;
  const std::vector<StudyScene> scenes = scenes_of(settings);
  std::vector<Task> tasks = tasks_of(scenes, settings.quick, gl);
  {
    Journal journal(settings.out_folder, identity_of(settings, gl), journal_header(),
                    journal_key_columns());
    fmt::print("{} measurements on {} scenes; {} are there already\n", tasks.size(), scenes.size(),
               journal.found_lines());
    std::fflush(stdout);
    sweep(scenes, std::move(tasks), settings.threads, settings.seed, journal, gl);
  }
  make_page(settings.scripts_folder, settings.out_folder);
  fmt::print("The figures and what became of the findings: {}\n",
             (fs::absolute(settings.out_folder) / "index.html").lexically_normal().string());
}

}  // namespace berth::lab
