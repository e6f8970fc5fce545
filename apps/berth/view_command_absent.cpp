// view in a build without the page's server.
#include <stdexcept>

#include "apps/berth/commands.hpp"

namespace berth::app {

void view_command(const ViewArguments&) {
  throw std::runtime_error(
      "this berth was built without the page; `make view` builds one that has it (CMake: "
      "BERTH_VIEW=ON, with the packages of scripts/packages-view.txt)");
}

}  // namespace berth::app
