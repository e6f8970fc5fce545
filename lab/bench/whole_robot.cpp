#include "lab/bench/whole_robot.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/scene/scene_file.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "lab/bench/coarse_robot.hpp"
#include "lab/bench/statistics.hpp"
#include "lab/bench/whole_robot_methods.hpp"

namespace berth::lab {
namespace {

/// The process's own time: neighbours on the machine count little.
constexpr clockid_t kProcessorTime = CLOCK_THREAD_CPUTIME_ID;
constexpr MeshRequest kReadings{.unknown = false};
constexpr MeshRequest kHasty{.deadline_us = 1000};
/// A controller's requests between two images of a camera, one each millisecond. In this time all
/// joints turn by up to WholeRobotScene::next_joints, 0.05 rad.
constexpr int kRequestsPerFrame = 33;
/// Of each edge of the meshes, where they grow and where there are most triangles.
constexpr int kGrowingParts[] = {1, 2, kUsualParts, 4};
constexpr int kMostParts = 4;

const std::vector<std::string> kTimeColumns = {"median ms", "95 % ms",      "max ms",
                                               "x exact",   "95 % x exact", "max x exact"};

/// The times of a row, each the least of three runs, over all scenes.
struct TimeRow {
  std::string name;
  std::vector<double> ms = {};
  /// How far the truth of a link may lie below its distance.
  std::vector<double> known_to_mm = {};
};

Table::Row row_of(const TimeRow& row, double exact_ms) {
  const double median_ms = median(row.ms).value();
  const double late_ms = percentile(row.ms, 0.95).value();
  const double max_ms = percentile(row.ms, 1).value();
  const std::string remark = row.known_to_mm.empty()
                                 ? ""
                                 : fmt::format("links known to {} mm in the median, {} in 95 %",
                                               format_value(median(row.known_to_mm)),
                                               format_value(percentile(row.known_to_mm, 0.95)));
  return {row.name,
          {median_ms, late_ms, max_ms, median_ms / exact_ms, late_ms / exact_ms, max_ms / exact_ms},
          remark};
}

/// A row for each; the first one is the yardstick.
std::vector<Table::Row> rows_of(const std::vector<const TimeRow*>& times) {
  std::vector<Table::Row> rows;
  const double exact_ms = median(times.front()->ms).value();
  for (const TimeRow* row : times) rows.push_back(row_of(*row, exact_ms));
  return rows;
}

/// What a camera's frame costs, and requests about one and three cameras.
class WholeRobotStages {
 public:
  explicit WholeRobotStages(const RobotModel& model)
      : model_(model), meshes_(build_link_meshes(model)), mesh_(model) {}

  void run(const WholeRobotScene& scene) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    exact_row_.ms.push_back(exact_.ms(scene, model_.link_count()));
    for (int k = 0; k < kSceneCameras; ++k) run_frame(scene, k);
    one_camera_.ms.push_back(cold_ms(scene, 1, {}));
    readings_.ms.push_back(cold_ms(scene, kSceneCameras, kReadings));
    first_.ms.push_back(cold_ms(scene, kSceneCameras, {}));
    for (const RobotPose& next : scene.next_poses) run_next(scene, next);
    run_hasty(scene);
    run_moving(scene);
  }

  std::vector<Table::Row> rows() const {
    return rows_of({&exact_row_, &one_camera_, &readings_, &first_, &next_, &hasty_, &moving_,
                    &render_, &filter_, &space_});
  }

 private:
  double cold_ms(const WholeRobotScene& scene, int cameras, const MeshRequest& request) {
    return least_ms(
        kProcessorTime, [&] { spaces_.assign(scene, cameras); },
        [&] { mesh_.ask(spaces_, scene.pose, request); });
  }

  void run_frame(const WholeRobotScene& scene, int k) {
    const CameraImages& view = scene.views[k];
    RobotRenderer renderer(meshes_, scene.camera);
    const auto nothing = [] {};
    render_.ms.push_back(
        least_ms(kProcessorTime, nothing, [&] { renderer.render(scene.pose, view.X_BC, robot_); }));
    filter_.ms.push_back(least_ms(kProcessorTime, nothing, [&] {
      self_filter(scene.camera, view.depth_m, robot_, {}, filter_workspace_, obstacles_);
    }));
    space_.ms.push_back(least_ms(kProcessorTime, nothing, [&] { spaces_.build_view(scene, k); }));
  }

  void run_next(const WholeRobotScene& scene, const RobotPose& next) {
    next_.ms.push_back(least_ms(
        kProcessorTime,
        [&] {
          spaces_.assign(scene, kSceneCameras);
          mesh_.ask(spaces_, scene.pose);
        },
        [&] { mesh_.ask(spaces_, next); }));
  }

  void run_hasty(const WholeRobotScene& scene) {
    hasty_.ms.push_back(cold_ms(scene, kSceneCameras, kHasty));
    note_known(hasty_);
  }

  void run_moving(const WholeRobotScene& scene) {
    spaces_.assign(scene, kSceneCameras);
    mesh_.ask(spaces_, scene.pose, kHasty);
    RobotPose pose;
    for (int i = 1; i <= kRequestsPerFrame; ++i) {
      std::vector<double> joints = scene.joints.position;
      for (std::size_t k = 0; k < joints.size(); ++k) {
        joints[k] += (scene.next_joints[0].position[k] - joints[k]) * i / kRequestsPerFrame;
      }
      forward_kinematics(model_, joints, pose);
      const Stopwatch watch(kProcessorTime);
      mesh_.ask_on(spaces_, pose, kHasty);
      moving_.ms.push_back(watch.ms());
      note_known(moving_);
    }
  }

  /// How far each link's bounds are apart.
  void note_known(TimeRow& row) const {
    for (const WholeLinkDistance& link : mesh_.distances()) {
      const double upper_m = link.nearest.is_known() ? link.nearest.distance_m : kHasty.range_m;
      row.known_to_mm.push_back(1000 * (upper_m - link.nearest.lower_bound_m));
    }
  }

  const RobotModel& model_;
  std::shared_ptr<const LinkMeshes> meshes_;
  MeshMethod mesh_;
  ExactYardstick exact_;
  SceneSpaces spaces_;
  RobotImage robot_;
  SelfFilterWorkspace filter_workspace_;
  ObstacleImage obstacles_;
  TimeRow exact_row_{"exact, 1 camera"};
  TimeRow one_camera_{"mesh, 1 camera, both"};
  TimeRow readings_{"mesh, 3 cameras, readings alone"};
  TimeRow first_{"mesh, 3 cameras, both, first request"};
  TimeRow next_{"mesh, 3 cameras, both, next request"};
  TimeRow hasty_{"mesh, 3 cameras, both, deadline 1 ms"};
  TimeRow moving_{"the same, one each ms until the next image"};
  TimeRow render_{"a camera's frame: render"};
  TimeRow filter_{"a camera's frame: self filter"};
  TimeRow space_{"a camera's frame: space for mesh"};
};

/// The same requests by the clock on the wall with one thread and with two.
class WholeRobotThreads {
 public:
  explicit WholeRobotThreads(const RobotModel& model) : mesh_(model) {}

  void run(const WholeRobotScene& scene) {
    spaces_.build_all(scene);
    for (Asked& asked : asked_) {
      for (const int threads : {1, 2}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        asked.ms[threads - 1].push_back(least_ms(
            CLOCK_MONOTONIC, [&] { spaces_.assign(scene, asked.cameras); },
            [&] { mesh_.ask(spaces_, scene.pose, asked.request); }));
      }
    }
  }

  std::vector<Table::Row> rows() const {
    std::vector<Table::Row> rows;
    for (const Asked& asked : asked_) {
      const double one_ms = median(asked.ms[0]).value();
      const double two_ms = median(asked.ms[1]).value();
      rows.push_back({asked.name, {one_ms, two_ms, one_ms / two_ms}, ""});
    }
    return rows;
  }

 private:
  struct Asked {
    std::string name;
    int cameras;
    MeshRequest request;
    /// By threads - 1.
    std::array<std::vector<double>, 2> ms = {};
  };

  MeshMethod mesh_;
  SceneSpaces spaces_;
  std::array<Asked, 3> asked_ = {Asked{"1 camera, both", 1, {}},
                                 Asked{"3 cameras, readings alone", kSceneCameras, kReadings},
                                 Asked{"3 cameras, both, first request", kSceneCameras, {}}};
};

/// The same surface in more and smaller triangles.
class WholeRobotGrowth {
 public:
  explicit WholeRobotGrowth(const RobotSettings& robot) {
    for (const int parts : kGrowingParts) {
      const RobotModel model = coarse_robot(robot, parts);
      meshes_.push_back({MeshMethod(model), {fmt::format("{}", triangle_count(model))}});
    }
  }

  void run(const WholeRobotScene& scene) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    spaces_.build_all(scene);
    for (auto& [mesh, row] : meshes_) {
      row.ms.push_back(least_ms(
          kProcessorTime, [&] { spaces_.assign(scene, kSceneCameras); },
          [&, &mesh = mesh] { mesh.ask(spaces_, scene.pose); }));
    }
  }

  std::vector<Table::Row> rows() const {
    std::vector<Table::Row> rows;
    const double fewest_ms = median(meshes_.front().row.ms).value();
    for (const Mesh& mesh : meshes_) {
      const double median_ms = median(mesh.row.ms).value();
      rows.push_back({mesh.row.name,
                      {median_ms, percentile(mesh.row.ms, 0.95), percentile(mesh.row.ms, 1),
                       median_ms / fewest_ms},
                      ""});
    }
    return rows;
  }

 private:
  struct Mesh {
    MeshMethod method;
    TimeRow row;
  };

  std::vector<Mesh> meshes_;
  SceneSpaces spaces_;
};

/// The whole way from joint angles to an answer with visibility, beside `exact` on the same images.
class LargeImages {
 public:
  explicit LargeImages(RobotModel model)
      : robot_(std::make_shared<const Robot>(std::move(model), settings())), query_(robot_) {}

  void run(const WholeRobotScene& scene) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const RobotModel& model = robot_->model();
    exact_row_.ms.push_back(exact_.ms(scene, model.link_count()));
    const CameraImages& images = scene.views.front();
    const auto view = std::make_shared<const MountedCamera>(
        robot_, CameraMount{scene.camera, model.links.front().name, images.X_BC});
    Frame frame;
    Observer(view).observe(images.depth_m, scene.joints, frame);
    for (const JointState& next : scene.next_joints) {
      request_.ms.push_back(least_ms(
          kProcessorTime,
          [&] {
            // Another image, or what was found out about unknown space would be known already.
            ++frame.number;
            query_.ask({.frames = frame});
          },
          [&] { query_.ask({.frames = frame, .joints = next}); }));
    }
  }

  std::vector<Table::Row> rows() const { return rows_of({&exact_row_, &request_}); }

 private:
  static EvaluationSettings settings() {
    EvaluationSettings settings;
    settings.distance.mean_direction = false;
    return settings;
  }

  std::shared_ptr<const Robot> robot_;
  ExactYardstick exact_;
  Query query_;
  TimeRow exact_row_{"exact, 1 camera"};
  TimeRow request_{"mesh, 1 camera, request at new joint angles with visibility"};
};

Table large_table(const RobotSettings& robot, const RobotModel& drawn, int count) {
  RobotModel model = coarse_robot(robot, kMostParts);
  const std::string note = fmt::format(
      "{} scenes, 1280 x 720, {} triangles, one thread, processor time. The request is that of "
      "the pipeline, both distances to 1 mm, and begins from the answer before.",
      count, triangle_count(model));
  LargeImages large(std::move(model));
  run_scenes("Whole robot, 1280 x 720", WholeRobotScenes(drawn, 1280, 720), count, large);
  return {"The whole robot in large images", note, "", kTimeColumns, large.rows()};
}

}  // namespace

std::vector<Table> measure_whole_robot(const std::filesystem::path& scene_file, int scenes) {
  const RobotSettings robot = read_scene(scene_file).robot;
  const RobotModel model = coarse_robot(robot, kUsualParts);
  WholeRobotStages stages(model);
  WholeRobotThreads threads(model);
  WholeRobotGrowth growth(robot);
  run_scenes("Whole robot", WholeRobotScenes(model, 640, 480), scenes, stages, threads, growth);
  const std::string where = fmt::format("{} drawn scenes, 640 x 480, {} links, to 1 mm, cold",
                                        scenes, model.link_count());
  std::vector<Table> tables;
  tables.push_back({"The whole robot",
                    fmt::format("{}, {} triangles, one thread, processor time. x exact: in "
                                "multiples of the median of exact.",
                                where, triangle_count(model)),
                    "", kTimeColumns, stages.rows()});
  tables.push_back({"The whole robot with two threads",
                    where + ". By the clock on the wall, medians.",
                    "mesh",
                    {"1 thread ms", "2 threads ms", "speed-up"},
                    threads.rows()});
  tables.push_back({"Growth of the whole robot with the meshes",
                    where + ". The same surface in each row; 3 cameras, both, first request.",
                    "triangles",
                    {"median ms", "95 % ms", "max ms", "x fewest"},
                    growth.rows()});
  tables.push_back(large_table(robot, model, scenes));
  return tables;
}

}  // namespace berth::lab
