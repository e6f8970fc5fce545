// record: a scene's frames through the pipeline, and a black box beside it.
#include <fmt/format.h>

#include <stdexcept>

#include "apps/berth/commands.hpp"
#include "apps/berth/run_frames.hpp"
#include "apps/berth/speed_changes.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/record/recorder.hpp"

namespace berth::app {
namespace {

RecorderSettings settings_of(const RecordArguments& arguments, const SceneFile& scene) {
  RecorderSettings settings;
  settings.file = arguments.out;
  settings.seconds = arguments.seconds;
  settings.on_stop = arguments.on_stop;
  settings.also = {{"scene.yaml", "application/yaml", read_file_bytes(scene.file)},
                   {"robot.urdf", "application/xml", read_file_bytes(scene.robot.urdf)}};
  settings.tell = [](const std::string& sentence) { fmt::print(stderr, "{}\n", sentence); };
  return settings;
}

void ask_all(const OpenScene& scene, SceneRun& run) {
  SpeedChanges changes;
  each_frame(scene, run, "record", [&] {
    if (!run.begins_result()) return;
    const Result result = run.ask();
    stop_if_interrupted();
    changes.take(result.stamp_s, result);
  });
}

void finish(Recorder& recorder, bool writes) {
  if (writes) recorder.write();
  recorder.finish();
  const RecorderCounts counts = recorder.counts();
  if (counts.lost_images + counts.lost_requests == 0) return;
  fmt::print(stderr, "{} images and {} requests are not recorded: the disk was too slow\n",
             counts.lost_images, counts.lost_requests);
}

}  // namespace

void record_command(const RecordArguments& arguments) {
  const SceneFile file = read_scene(arguments.scene);
  const OpenScene scene = open_with_progress(file, "check images", open_scene);
  if (arguments.on_stop && !scene.separation) {
    throw std::runtime_error(fmt::format(
        "{}: separation: missing, so that nothing stops the robot; expected it, or --on always",
        arguments.scene.string()));
  }
  std::vector<std::shared_ptr<const MountedCamera>> cameras;
  for (const OpenCamera& camera : scene.cameras) cameras.push_back(camera.mounted);
  Recorder recorder(scene.robot, cameras, scene.separation, settings_of(arguments, file));
  SceneRun run(scene, stop_if_interrupted);
  run.record_with(recorder);
  // The recording is kept, whatever ends the run.
  try {
    ask_all(scene, run);
  } catch (...) {
    finish(recorder, !arguments.on_stop);
    throw;
  }
  finish(recorder, !arguments.on_stop);
  if (arguments.on_stop && recorder.counts().files.empty()) {
    fmt::print(
        stderr,
        "Nothing is written: the monitor stopped no robot that it had let go on; --on always "
        "writes all the same\n");
  }
}

}  // namespace berth::app
