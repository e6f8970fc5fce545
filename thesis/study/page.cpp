#include "thesis/study/page.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "apps/support/interrupt.hpp"

namespace berth::lab {
namespace {

/// Debian's own: python3 of the PATH may be another one, which knows nothing of Debian's packages.
constexpr const char* kPython = "/usr/bin/python3";

/// Its exit status; 127 where it is not there. Without -B it would write beside the scripts.
int run_python(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {kPython, "-B"});
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t process = 0;
  if (::posix_spawn(&process, kPython, nullptr, nullptr, argv.data(), environ) != 0) return 127;
  int status = 0;
  if (::waitpid(process, &status, 0) != process) {
    throw std::system_error(errno, std::generic_category(), "wait for Python");
  }
  app::stop_if_interrupted();
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

void require_page_program() {
  const char* imports =
      "import importlib.util, sys\n"
      "sys.exit(any(importlib.util.find_spec(m) is None for m in ('matplotlib', 'numpy')))";
  if (run_python({"-c", imports}) == 0) return;
  throw std::runtime_error(fmt::format(
      "{} with matplotlib is needed for the figures; install Debian's python3-matplotlib",
      kPython));
}

void make_page(const std::filesystem::path& scripts_folder,
               const std::filesystem::path& study_folder) {
  const int status =
      run_python({(scripts_folder / "make_page.py").string(), study_folder.string()});
  if (status == 0) return;
  throw std::runtime_error(
      fmt::format("{}: the figures could not be made (exit status {} of make_page.py); what was "
                  "measured is kept",
                  study_folder.string(), status));
}

}  // namespace berth::lab
