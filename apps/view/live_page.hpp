#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/view/page_files.hpp"
#include "apps/view/page_server.hpp"
#include "apps/view/scene_messages.hpp"

namespace berth::app {

/// A page that shows a running robot: what its pipeline gives, as it comes. One thread at a time
/// calls show().
class LivePage {
 public:
  /// Serves the page from now on; throws as PageServer does.
  LivePage(std::shared_ptr<const Robot> robot, const std::vector<PageCamera>& cameras,
           const PageAddress& address, PageFiles files);
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  std::string url() const;

  /// Shows a result and the frames that it is about: frames[k] is camera k's, or null. Waits for
  /// no page: one that is slower than the results misses some. Throws std::invalid_argument unless
  /// there is one for each camera.
  void show(const Result& result, const std::vector<std::shared_ptr<const Frame>>& frames);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth::app
