#include "tests/apps/berth_program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <system_error>

#include "berth/files/file_bytes.hpp"

namespace berth {
namespace {

void require(int error, const char* doing) {
  if (error != 0) throw std::system_error(error, std::generic_category(), doing);
}

/// What the child does with its streams and folder before it becomes berth.
class Preparations {
 public:
  Preparations() { require(::posix_spawn_file_actions_init(&actions_), "prepare"); }
  ~Preparations() { ::posix_spawn_file_actions_destroy(&actions_); }
  Preparations(const Preparations&) = delete;
  Preparations& operator=(const Preparations&) = delete;

  void write_to(int stream, const std::filesystem::path& file) {
    require(::posix_spawn_file_actions_addopen(&actions_, stream, file.c_str(),
                                               O_WRONLY | O_CREAT | O_TRUNC, 0600),
            "redirect");
  }
  void work_in(const std::filesystem::path& folder) {
    require(::posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()), "change folder");
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

BerthProgram::BerthProgram(const std::filesystem::path& folder,
                           const std::vector<std::string>& arguments,
                           const std::filesystem::path& terminal) {
  streams_.write("err", "");
  Preparations preparations;
  preparations.write_to(STDOUT_FILENO, streams_ / "out");
  preparations.write_to(STDERR_FILENO, terminal.empty() ? streams_ / "err" : terminal);
  preparations.work_in(folder);
  std::vector<std::string> words = {BERTH_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  require(
      ::posix_spawn(&process_, BERTH_PROGRAM, preparations.get(), nullptr, argv.data(), environ),
      "start " BERTH_PROGRAM);
}

BerthProgram::~BerthProgram() {
  if (process_ == 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void BerthProgram::interrupt() { ::kill(process_, SIGINT); }

Outcome BerthProgram::wait() {
  int status = 0;
  rusage used{};
  if (::wait4(process_, &status, 0, &used) != process_) require(errno, "wait for berth");
  process_ = 0;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          read_file_bytes(streams_ / "out"), read_file_bytes(streams_ / "err"),
          static_cast<std::size_t>(used.ru_maxrss) * 1024};
}

Outcome run_berth(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  return BerthProgram(folder, arguments).wait();
}

}  // namespace berth
