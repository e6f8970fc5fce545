// The bundled scene's cameras and robot in a loop with a recorder, and recordings that are changed.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "berth/record/mcap_reader.hpp"
#include "berth/record/recorder.hpp"
#include "berth/record/replay.hpp"
#include "berth/scene/scene_run.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {

inline SeparationSettings some_separation() {
  SeparationSettings settings;
  settings.detection_m = 0.04;
  settings.not_seen = UnknownPolicy::ignore;
  settings.no_reading = UnknownPolicy::ignore;
  return settings;
}

class RecordedScene : public ::testing::Test {
 protected:
  RecordedScene() : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    scene_.separation = some_separation();
  }

  std::filesystem::path file() const { return folder_ / "stop.mcap"; }
  RecorderSettings settings() const { return {.file = file(), .seconds = 1}; }
  std::vector<std::shared_ptr<const MountedCamera>> cameras() const {
    std::vector<std::shared_ptr<const MountedCamera>> cameras;
    for (const OpenCamera& camera : scene_.cameras) cameras.push_back(camera.mounted);
    return cameras;
  }
  std::unique_ptr<Recorder> recorder(const RecorderSettings& settings) const {
    return std::make_unique<Recorder>(scene_.robot, cameras(), scene_.separation, settings);
  }

  /// The scene's first results, recorded; a recording of them.
  void record_scene(const RecorderSettings& settings, int results) {
    const auto black_box = recorder(settings);
    SceneRun run(scene_);
    run.record_with(*black_box);
    for (int i = 0; i < results && run.next();) {
      if (!run.begins_result()) continue;
      run.ask();
      ++i;
    }
    black_box->write();
    black_box->finish();
  }

  OpenScene scene_;
  TemporaryFolder folder_;
};

/// What a test changes of a recording.
struct Change {
  std::function<void(mcap::Head&)> head = [](mcap::Head&) {};
  /// Of each message; whether it stays.
  std::function<bool(const mcap::Message&, std::string& data)> message =
      [](const mcap::Message&, std::string&) { return true; };
};

/// The same recording with the change, and checksums that go with it.
inline void rewrite(const std::filesystem::path& from, const std::filesystem::path& to,
                    const Change& change) {
  mcap::FileReader in(from);
  mcap::Head head = in.head();
  change.head(head);
  mcap::FileWriter out(to, head);
  mcap::ChunkBuilder chunk;
  const auto flush = [&] {
    if (chunk.is_empty()) return;
    std::string bytes;
    out.begin_chunk(chunk.finish(bytes));
    out.write(bytes);
  };
  for (mcap::Message message; in.next(message);) {
    std::string data(message.data);
    if (!change.message(message, data)) continue;
    chunk.add(message.channel, message.time_ns, data);
    if (chunk.size() > 1'000'000) flush();
  }
  flush();
  out.finish();
}

inline mcap::Attachment& attachment(mcap::Head& head, std::string_view name) {
  return *std::ranges::find(head.attachments, name, &mcap::Attachment::name);
}

inline void replace(std::string& text, std::string_view before, std::string_view after) {
  const std::size_t at = text.find(before);
  ASSERT_NE(at, std::string::npos) << before;
  text.replace(at, before.size(), after);
}

}  // namespace berth
