#include "thesis/study/sweep.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <exception>
#include <functional>
#include <mutex>
#include <random>
#include <thread>

#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "thesis/brute_force.hpp"
#include "thesis/study/gl_measurement.hpp"

namespace berth::lab {
namespace {

/// Calls work(i) for 0 <= i < count on several threads, each i once; work() makes its own worker
/// state. Rethrows the first exception after all threads have ended.
void run_on_threads(int threads, std::size_t count,
                    const std::function<std::function<void(std::size_t)>()>& make_worker) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    try {
      const auto work = make_worker();
      for (std::size_t i; (i = next++) < count;) {
        app::stop_if_interrupted();
        work(i);
      }
    } catch (...) {
      next = count;
      const std::scoped_lock lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> pool;
    for (int i = 0; i < threads; ++i) pool.emplace_back(run);
  }
  if (failure) std::rethrow_exception(failure);
}

/// A scene's images and true distances.
struct MadeScene {
  sim::ImagePair images;
  LinkDistances truth;
};

double greatest_range_m(const std::vector<Task>& tasks) {
  double range_m = 0;
  for (const Task& task : tasks) range_m = std::max(range_m, task.set.settings.range_m);
  return range_m;
}

MadeScene make_scene(const StudyScene& scene, double range_m) {
  MadeScene made{scene.make(), {}};
  if (scene.kind == SceneKind::worst_case) {
    made.truth.links.resize(made.images.link_count);
    return made;
  }
  ImageDistanceSettings settings;
  settings.range_m = range_m;
  // Leaves out only pairs that are farther than one that was found.
  settings.surveillance.region = SurveillanceRegion::cube_projection;
  brute_force({made.images.camera, made.images.robot, made.images.link_count,
               SearchableDepth(made.images.obstacle_depth_m), settings},
              made.truth);
  return made;
}

std::vector<MadeScene> make_scenes(const std::vector<StudyScene>& scenes,
                                   const std::vector<Task>& tasks, int threads) {
  std::vector<std::size_t> needed;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const auto is_on_it = [s](const Task& task) { return task.scene == s; };
    if (std::any_of(tasks.begin(), tasks.end(), is_on_it)) needed.push_back(s);
  }
  std::vector<MadeScene> made(scenes.size());
  const double range_m = greatest_range_m(tasks);
  app::ProgressBar progress("scenes", needed.size());
  std::mutex mutex;
  run_on_threads(threads, needed.size(), [&] {
    return [&](std::size_t i) {
      made[needed[i]] = make_scene(scenes[needed[i]], range_m);
      const std::scoped_lock lock(mutex);
      progress.step();
    };
  });
  return made;
}

}  // namespace

std::string journal_header() {
  return fmt::format("scene,kind,{},{}", kSetColumns, kMeasurementColumns);
}

int journal_key_columns() {
  return 3 + static_cast<int>(std::count(kSetColumns.begin(), kSetColumns.end(), ','));
}

std::string journal_key(const StudyScene& scene, const ParameterSet& set) {
  return fmt::format("{},{},{}", scene.name, name_of(scene.kind), columns_of(set));
}

void sweep(const std::vector<StudyScene>& scenes, std::vector<Task> tasks, int threads,
           std::uint32_t seed, Journal& journal, GlContext* gl) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::erase_if(tasks, [&](const Task& task) {
    return journal.has(journal_key(scenes[task.scene], task.set));
  });
  std::shuffle(tasks.begin(), tasks.end(), std::mt19937(seed));
  const std::vector<MadeScene> made = make_scenes(scenes, tasks, threads);
  const auto first_on_gl = std::partition(
      tasks.begin(), tasks.end(), [](const Task& task) { return !runs_on_opengl(task.set.part); });

  app::ProgressBar progress("study", tasks.size());
  std::mutex mutex;
  const auto note = [&](const Task& task, const Measurement& found) {
    journal.add(journal_key(scenes[task.scene], task.set), columns_of(found));
    const std::scoped_lock lock(mutex);
    progress.step();
  };
  run_on_threads(threads, first_on_gl - tasks.begin(), [&] {
    return [&, workspace = std::make_shared<MeasureWorkspace>()](std::size_t i) {
      const MadeScene& scene = made[tasks[i].scene];
      note(tasks[i], measure(tasks[i].set, scene.images, scene.truth, *workspace));
    };
  });
  if (first_on_gl == tasks.end()) return;
  assert(gl);
  GlMeasurer measurer(*gl);
  for (auto task = first_on_gl; task != tasks.end(); ++task) {
    app::stop_if_interrupted();
    const MadeScene& scene = made[task->scene];
    note(*task, measurer.measure(task->set, scene.images, scene.truth));
  }
}

}  // namespace berth::lab
