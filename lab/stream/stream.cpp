#include "lab/stream/stream.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "berth/live/joint_intake.hpp"
#include "berth/live/live_camera.hpp"
#include "berth/live/live_space.hpp"
#include "berth/pipeline/configuration_check.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/record/recorder.hpp"
#include "lab/stream/configurations.hpp"
#include "lab/stream/film.hpp"
#include "lab/stream/percentiles.hpp"
#include "lab/stream/steps.hpp"

namespace berth::lab {
namespace {

using Clock = std::chrono::steady_clock;

double now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

void sleep_until(double time_s) {
  std::this_thread::sleep_until(Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_s))));
}

/// The cores that this thread, and those that it begins from now on, may use.
void use_cores(const cpu_set_t& cores) {
  (void)pthread_setaffinity_np(pthread_self(), sizeof(cores), &cores);
}

/// The last core for requests, the others for making images ready; all for both where there is
/// only one.
struct Cores {
  cpu_set_t all, of_requests, of_images;

  Cores() {
    CPU_ZERO(&of_requests);
    CPU_ZERO(&all);
    (void)pthread_getaffinity_np(pthread_self(), sizeof(all), &all);
    of_images = all;
    if (CPU_COUNT(&of_images) < 2) {
      of_requests = of_images;
      return;
    }
    int last = CPU_SETSIZE - 1;
    while (!CPU_ISSET(last, &of_images)) --last;
    CPU_SET(last, &of_requests);
    CPU_CLR(last, &of_images);
  }
};

struct Measured {
  std::int64_t answers = 0;
  std::int64_t ok = 0;
  double seconds = 0;
  std::vector<double> ask_us;
  std::vector<double> gap_m;
  std::vector<double> exposure_to_answer_ms;
  std::mutex images_mutex;
  std::vector<double> image_ms;
  std::optional<RecorderCounts> recorded;
  std::vector<double> plan_ms;
};

/// As a controller asks: a request has most of the time until the next one, unless the scene says
/// how long it may take.
std::shared_ptr<const Robot> robot_in_time(const Film& film, double rate_hz) {
  constexpr double kShare = 0.6;
  EvaluationSettings settings = film.robot->settings();
  if (!settings.distance.deadline_us) settings.distance.deadline_us = 1e6 * kShare / rate_hz;
  return with_settings(film.robot, settings);
}

class Stream {
 public:
  Stream(const Film& film, const StreamSettings& settings)
      : film_(film),
        settings_(settings),
        joints_(film.robot->model(), {}),
        robot_(robot_in_time(film, settings.rate_hz)),
        query_(robot_),
        count_(film.cameras.size()),
        space_(robot_, count_, joints_) {
    if (!settings.record.empty()) record();
    if (settings.plans_hz > 0) check_ = std::make_unique<ConfigurationCheck>(film.robot);
    for (std::size_t k = 0; k < count_; ++k) {
      cameras_.push_back(std::make_unique<LiveCamera>(
          film.cameras[k].mounted, joints_, LiveCameraSettings{},
          [this, k](const std::shared_ptr<const Frame>& frame, DepthView depth_m,
                    const std::shared_ptr<const void>&) {
            if (recorder_) recorder_->put(*frame, depth_m);
            keep(k);
          }));
    }
  }

  void run(const Cores& cores) {
    // The images of the first turn come after everybody is ready.
    play_ = {film_.joints->first_s(), film_.joints->last_s(), settings_.speed, now_s() + 0.2};
    std::jthread feeding([this](const std::stop_token& stop) { feed(stop); });
    std::jthread planning;
    if (settings_.plans_hz > 0)
      planning = std::jthread([&](const std::stop_token& stop) { plan(stop, cores.all); });
    use_cores(cores.of_requests);
    ask();
  }

  const Measured& measured() const { return measured_; }
  /// Writes the recording, where there is one to be.
  void finish() {
    if (!recorder_) return;
    recorder_->write();
    recorder_->finish();
    measured_.recorded = recorder_->counts();
  }

 private:
  void record() {
    std::vector<std::shared_ptr<const MountedCamera>> cameras;
    for (const FilmedCamera& camera : film_.cameras) cameras.push_back(camera.mounted);
    recorder_.emplace(robot_, cameras, std::nullopt, RecorderSettings{.file = settings_.record});
  }

  void keep(std::size_t camera) {
    space_.put(camera, cameras_[camera]->newest());
    const std::lock_guard lock(measured_.images_mutex);
    // Its own work, and that of the set before, since its own is still to be made.
    const double work_s =
        cameras_[camera]->counts().last_observe_s + space_.counts().last_prepare_s;
    measured_.image_ms.push_back(1000 * work_s);
  }

  /// As a robot's and the cameras' drivers do.
  void feed(const std::stop_token& stop) {
    std::vector<std::string> names;
    for (const MovableJoint& joint : film_.robot->model().joints) names.push_back(joint.name);
    const auto shown = shown_images(film_, play_, settings_.seconds + 1);
    std::size_t next = 0;
    JointState state;
    for (std::int64_t i = -100; !stop.stop_requested(); ++i) {
      const double time_s = play_.begin_s + static_cast<double>(i) / settings_.rate_hz;
      sleep_until(time_s);
      (void)film_.joints->at(play_.film_s(time_s), kAnyGap, state);
      joints_.push(time_s, names, state.position);
      for (const auto& camera : cameras_) camera->look_again();
      for (; next < shown.size() && shown[next].time_s <= time_s; ++next) {
        const Shown& image = shown[next];
        DepthImage copy = cameras_[image.camera]->spare_image();
        copy = film_.cameras[image.camera].depth_m[image.frame];
        cameras_[image.camera]->push(image.time_s, std::move(copy));
      }
    }
  }

  /// As a sampling planner does, each time that it wants to know what is there now.
  void plan(const std::stop_token& stop, const cpu_set_t& cores) {
    use_cores(cores);
    tbb::task_arena arena(CPU_COUNT(&cores));
    sim::Random random(1);
    const std::vector<double> positions =
        draw_configurations(film_.robot->model(), kPlanned, random);
    std::vector<Verdict> verdicts(kPlanned);
    for (int i = 0; !stop.stop_requested(); ++i) {
      sleep_until(play_.begin_s + i / settings_.plans_hz);
      const std::shared_ptr<const PreparedSpace> space = space_.newest();
      const double begin_s = now_s();
      arena.execute([&] {
        if (check_->prepare(space) != ResultStatus::stale) check_->ask(positions, {}, verdicts);
      });
      measured_.plan_ms.push_back(1000 * (now_s() - begin_s));
    }
  }

  void ask() {
    constexpr double kWarmUp_s = 1;
    std::vector<double> known_s(count_, 0);
    const double begin_s = play_.begin_s + kWarmUp_s;
    const double end_s = begin_s + settings_.seconds;
    double due_s = play_.begin_s;
    while (due_s < end_s) {
      sleep_until(due_s);
      const double asked_s = now_s();
      const Request request{
          .frames = space_.newest(), .joints = joints_.buffer(), .now_s = asked_s};
      const Result& result = recorder_ ? recorder_->ask(query_, request) : query_.ask(request);
      const double told_s = now_s();
      if (due_s >= begin_s) take(result, asked_s, told_s, known_s);
      // A late request does not make the next one late: its turn is left out.
      const double turns = std::floor((now_s() - due_s) * settings_.rate_hz) + 1;
      due_s += turns / settings_.rate_hz;
    }
    measured_.seconds = now_s() - begin_s;
  }

  void take(const Result& result, double asked_s, double told_s, std::vector<double>& known_s) {
    ++measured_.answers;
    measured_.ok += result.status == ResultStatus::ok;
    measured_.ask_us.push_back(1e6 * (told_s - asked_s));
    for (const LinkResult& link : result.links) {
      if (link.has_distance()) measured_.gap_m.push_back(link.distance_m - link.lower_bound_m);
    }
    for (std::size_t k = 0; k < count_; ++k) {
      const double stamp_s = result.cameras[k].stamp_s;
      if (!(stamp_s > known_s[k])) continue;
      if (known_s[k] > 0) measured_.exposure_to_answer_ms.push_back(1000 * (told_s - stamp_s));
      known_s[k] = stamp_s;
    }
  }

  static constexpr std::size_t kPlanned = 10'000;

  const Film& film_;
  const StreamSettings& settings_;
  JointIntake joints_;
  std::shared_ptr<const Robot> robot_;
  Query query_;
  std::optional<Recorder> recorder_;
  /// Of the planner, where there is one.
  std::unique_ptr<ConfigurationCheck> check_;
  std::size_t count_;
  LiveSpace space_;
  Measured measured_;
  Play play_{};
  /// The last member: their threads use the others.
  std::vector<std::unique_ptr<LiveCamera>> cameras_;
};

nlohmann::ordered_json json_of(const Measured& m) {
  nlohmann::ordered_json out;
  out["answers_per_s"] = static_cast<double>(m.answers) / m.seconds;
  out["ok_share"] = m.answers == 0 ? 0 : static_cast<double>(m.ok) / static_cast<double>(m.answers);
  out["ask_us"] = percentiles(m.ask_us, {{"p50", 0.5}, {"p99", 0.99}, {"p999", 0.999}, {"max", 1}});
  out["image_ms"] = percentiles(m.image_ms, {{"p50", 0.5}, {"p99", 0.99}});
  out["exposure_to_answer_ms"] =
      percentiles(m.exposure_to_answer_ms, {{"p50", 0.5}, {"p99", 0.99}});
  out["gap_m"] = percentiles(m.gap_m, {{"p50", 0.5}, {"p99", 0.99}, {"max", 1}});
  if (!m.plan_ms.empty()) out["plan_ms"] = percentiles(m.plan_ms, {{"p50", 0.5}, {"max", 1}});
  if (m.recorded) {
    out["recorded"] = {{"images", m.recorded->images},
                       {"requests", m.recorded->requests},
                       {"lost_images", m.recorded->lost_images},
                       {"lost_requests", m.recorded->lost_requests}};
  }
  return out;
}

nlohmann::ordered_json in_real_time(const Film& film, const StreamSettings& settings) {
  const Cores cores;
  use_cores(cores.of_images);
  Stream stream(film, settings);
  stream.run(cores);
  stream.finish();
  return json_of(stream.measured());
}

}  // namespace

std::string run_stream(const StreamSettings& settings) {
  const Film film = film_of(settings);
  // Each thread works alone, on the images' cores or on the requests', but for a planner's.
  const std::size_t threads = settings.plans_hz > 0 ? std::thread::hardware_concurrency() : 1;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const nlohmann::ordered_json out =
      settings.in_steps ? measure_steps(film, settings) : in_real_time(film, settings);
  if (settings.as_json) return out.dump() + "\n";
  std::string lines;
  for (const auto& [name, value] : out.items())
    lines += fmt::format("{}: {}\n", name, value.dump());
  return lines;
}

}  // namespace berth::lab
