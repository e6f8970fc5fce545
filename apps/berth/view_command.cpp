// view: a page that shows a scene.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "apps/berth/commands.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "apps/view/page_server.hpp"
#include "apps/view/viewed_scene.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

fs::path save_folder_of(const ViewArguments& arguments) {
  if (arguments.save_folder.empty()) return fs::absolute(arguments.scene).parent_path();
  if (fs::is_directory(arguments.save_folder)) return arguments.save_folder;
  throw std::runtime_error(fmt::format("--save-to {}: is no folder; expected one that is there",
                                       arguments.save_folder.string()));
}

/// Until Ctrl-C, which is how a page is ended.
void wait_for_interrupt() {
  constexpr std::chrono::milliseconds kBetweenLooks{50};
  try {
    while (true) {
      stop_if_interrupted();
      std::this_thread::sleep_for(kBetweenLooks);
    }
  } catch (const Interrupted&) {
  }
}

}  // namespace

void view_command(const ViewArguments& arguments) {
  const fs::path save_folder = save_folder_of(arguments);
  ViewedScene* scene = nullptr;
  std::mutex mutex;
  // Before the images are read, so that a taken port is told at once.
  PageServer server({arguments.bind, arguments.port}, read_page_files(program_page_folders()),
                    [&](const std::string& request) {
                      const std::scoped_lock lock(mutex);
                      if (scene) scene->receive(request);
                    });
  const Publish publish = [&](const std::string& kind, PageMessage message) {
    server.publish(kind, std::move(message));
  };
  ProgressBar progress("read images", 0);
  std::size_t images = 0;
  ViewedScene viewed(arguments.scene, save_folder, publish, [&] {
    stop_if_interrupted();
    progress.step();
    publish("loading", json_message({{"type", "loading"}, {"images", images++}}));
  });
  progress.clear();
  {
    const std::scoped_lock lock(mutex);
    scene = &viewed;
  }
  fmt::print("{}\nCtrl-C ends it.\n", server.url());
  std::fflush(stdout);
  wait_for_interrupt();
  viewed.finish();
  // A calibration looks up every few seconds only, and nobody waits for what it would find.
  std::quick_exit(EXIT_SUCCESS);
}

}  // namespace berth::app
