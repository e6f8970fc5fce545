#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cmath>

#include "berth/scene/scene_file.hpp"
#include "lab/bench/cameras_peer.hpp"
#include "lab/bench/coarse_robot.hpp"
#include "lab/bench/statistics.hpp"
#include "lab/bench/whole_robot.hpp"
#include "lab/bench/whole_robot_methods.hpp"

namespace berth::lab {
namespace {

const std::vector<std::string> kWholeRobotColumns = {"median ms",
                                                     "95 % ms",
                                                     "max ms",
                                                     "x exact",
                                                     "build ms",
                                                     "from readings, median mm",
                                                     "too near mm",
                                                     "too far mm",
                                                     "beyond both, median mm",
                                                     "beyond both, max mm",
                                                     "links missed"};

/// What one method did on all scenes so far.
struct CamerasRecord {
  std::vector<double> build_ms = {};
  std::vector<double> total_ms = {};
  /// Sizes of the differences from the distance to readings.
  std::vector<double> error_mm = {};
  double too_near_mm = 0;
  double too_far_mm = 0;
  /// By how much it is above the distance to what is seen or hidden; 0 where it is not.
  std::vector<double> beyond_both_mm = {};
  /// Those that have something seen or hidden in range, and no answer.
  double links_missed = 0;

  void take_link(const WholeLinkDistance& truth, std::optional<double> answer_m) {
    if (truth.nearest.is_known() && !answer_m) ++links_missed;
    if (!answer_m) return;
    if (truth.occupied.is_known()) {
      const double mm = 1000 * (*answer_m - truth.occupied.distance_m);
      error_mm.push_back(std::abs(mm));
      too_near_mm = std::max(too_near_mm, -mm);
      too_far_mm = std::max(too_far_mm, mm);
    }
    if (truth.nearest.is_known()) {
      beyond_both_mm.push_back(std::max(0.0, 1000 * (*answer_m - truth.nearest.distance_m)));
    }
  }
};

/// Both from images that are filtered to the answer of all links, one thread, processor time.
template <class Build, class Ask>
void time_once(Build build, Ask ask, CamerasRecord& record) {
  const Stopwatch watch(CLOCK_THREAD_CPUTIME_ID);
  build();
  record.build_ms.push_back(watch.ms());
  ask();
  record.total_ms.push_back(watch.ms());
}

Table::Row row_of(const std::string& name, const CamerasRecord& record, double exact_ms,
                  const std::string& lacks) {
  Table::Row row{
      name,
      {median(record.total_ms), percentile(record.total_ms, 0.95), percentile(record.total_ms, 1),
       median(record.total_ms).value() / exact_ms, median(record.build_ms)},
      lacks.empty() ? "" : "lacks: " + lacks};
  if (!record.error_mm.empty()) {
    row.values.insert(
        row.values.end(),
        {median(record.error_mm), record.too_near_mm, record.too_far_mm,
         median(record.beyond_both_mm), percentile(record.beyond_both_mm, 1), record.links_missed});
  }
  row.values.resize(kWholeRobotColumns.size());
  return row;
}

/// `mesh` and the peers on the same scenes.
class CamerasComparison {
 public:
  explicit CamerasComparison(const RobotModel& model) : links_(model.link_count()), mesh_(model) {
    peers_.push_back({make_cameras_nanoflann(model), {}});
    peers_.push_back({make_cameras_octomap(model, 0.02), {}});
    peers_.push_back({make_cameras_octomap(model, 0.01), {}});
  }

  void run(const WholeRobotScene& scene) {
    exact_ms_.push_back(exact_.ms(scene, links_));
    run_mesh(scene, {.unknown = false}, readings_);
    run_mesh(scene, kBoth, both_);
    for (auto& [peer, record] : peers_) {
      std::vector<std::optional<double>> answer_m;
      time_once([&, &peer = peer] { peer->build(scene); },
                [&, &peer = peer] { answer_m = peer->ask(scene, kBoth.range_m); }, record);
      for (std::size_t i = 0; i < answer_m.size(); ++i) {
        record.take_link(mesh_.distances()[i], answer_m[i]);
      }
    }
  }

  std::vector<Table::Row> rows() const {
    const double exact_ms = median(exact_ms_).value();
    std::vector<Table::Row> rows;
    rows.push_back(row_of("mesh, both", both_, exact_ms, ""));
    rows.push_back(row_of("mesh, readings alone", readings_, exact_ms, "unknown space"));
    for (const auto& [peer, record] : peers_) {
      rows.push_back(row_of(peer->name(), record, exact_ms, peer->lacks()));
    }
    return rows;
  }

 private:
  static constexpr MeshRequest kBoth{};

  struct Compared {
    std::unique_ptr<CamerasPeer> peer;
    CamerasRecord record;
  };

  void run_mesh(const WholeRobotScene& scene, const MeshRequest& request, CamerasRecord& record) {
    time_once(
        [&] {
          spaces_.build_all(scene);
          spaces_.assign(scene, kSceneCameras);
        },
        [&] { mesh_.ask(spaces_, scene.pose, request); }, record);
  }

  int links_;
  ExactYardstick exact_;
  SceneSpaces spaces_;
  MeshMethod mesh_;
  std::vector<double> exact_ms_;
  CamerasRecord both_;
  CamerasRecord readings_;
  std::vector<Compared> peers_;
};

}  // namespace

Table compare_whole_robot(const std::filesystem::path& scene_file, int scenes) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const RobotModel model = coarse_robot(read_scene(scene_file).robot, kUsualParts);
  CamerasComparison comparison(model);
  run_scenes("Several cameras", WholeRobotScenes(model, 640, 480), scenes, comparison);
  return {"What there is for several cameras",
          fmt::format("{} of the same scenes, 3 cameras, one run each with one thread, processor "
                      "time, from the filtered images to the distances of all links; build is what "
                      "each set of frames costs. Errors are against mesh: of the distance to "
                      "readings, and how far beyond the distance to what is seen or hidden.",
                      scenes),
          "method", kWholeRobotColumns, comparison.rows()};
}

}  // namespace berth::lab
