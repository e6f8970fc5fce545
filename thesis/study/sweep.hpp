#pragma once

#include <cstdint>
#include <vector>

#include "thesis/opengl/gl_context.hpp"
#include "thesis/study/journal.hpp"
#include "thesis/study/parameter_sets.hpp"
#include "thesis/study/scenes.hpp"

namespace berth::lab {

/// One line of the journal to be.
struct Task {
  std::size_t scene;
  ParameterSet set;
};

/// The header of the journal, and how many of its columns are the key.
std::string journal_header();
int journal_key_columns();
/// scene, kind and the set's columns.
std::string journal_key(const StudyScene& scene, const ParameterSet& set);

/// Measures what the journal does not have yet, on `threads` threads, with a progress bar; then
/// what runs on OpenGL, one after another on the calling thread, in its current context `gl`. The
/// tasks are shuffled by `seed`, so that a disturbance of the machine falls on no parameter more
/// than on others. Scenes are made, and brute force tried on them, only where a task needs them;
/// on the worst case every true distance is known to be 0 and none is compared. Throws Interrupted
/// where the user stopped it; what is complete is in the journal then.
void sweep(const std::vector<StudyScene>& scenes, std::vector<Task> tasks, int threads,
           std::uint32_t seed, Journal& journal, GlContext* gl = nullptr);

}  // namespace berth::lab
