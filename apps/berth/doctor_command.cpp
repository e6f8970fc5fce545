// doctor: all checks of a scene, and what to do next.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "apps/berth/checkup.hpp"
#include "apps/berth/commands.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/scene/scene_file.hpp"

namespace berth::app {
namespace {

const char* word_of(Verdict verdict) {
  return verdict == Verdict::ok ? "ok" : verdict == Verdict::advice ? "advice" : "wrong";
}

/// What is said of several cameras in the same words is said once: "watch, cameras left, right".
std::vector<Finding> merged(const std::vector<Finding>& all) {
  constexpr std::string_view kOne = ", camera ";
  std::vector<Finding> kept;
  for (const Finding& one : all) {
    const std::size_t at = one.about.find(kOne);
    const auto same = std::ranges::find_if(kept, [&](const Finding& earlier) {
      return at != std::string::npos && earlier.verdict == one.verdict &&
             earlier.text == one.text && earlier.next == one.next &&
             earlier.about.starts_with(one.about.substr(0, at) + ", camera");
    });
    if (same == kept.end()) {
      kept.push_back(one);
      continue;
    }
    if (same->about.compare(at, kOne.size(), kOne) == 0)
      same->about.insert(at + kOne.size() - 1, "s");
    same->about += ", " + one.about.substr(at + kOne.size());
  }
  return kept;
}

/// Prints what each check finds, as soon as it is found.
class Doctor {
 public:
  void take(const Finding& found) {
    fmt::print("{:<7} {}: {}\n", word_of(found.verdict), found.about, found.text);
    std::fflush(stdout);
    const bool is_wrong = found.verdict == Verdict::wrong;
    wrong_ += is_wrong;
    std::vector<std::string>& next = is_wrong ? fix_ : improve_;
    const bool is_new = std::ranges::find(next, found.next) == next.end();
    if (!found.next.empty() && is_new) next.push_back(found.next);
  }

  /// Runs a check. What it throws is a finding as well, after which nothing more is looked at.
  template <class Check>
  void look(const char* about, const Check& check) {
    if (wrong_ > 0) {
      ++left_out_;
      return;
    }
    ProgressBar progress(fmt::format("look at {}", about), 0);
    try {
      const auto found = check([&progress] {
        stop_if_interrupted();
        progress.step();
      });
      progress.clear();
      for (const Finding& one : merged(found)) take(one);
    } catch (const std::runtime_error& error) {
      progress.clear();
      const std::string text = error.what();
      take({Verdict::wrong, about, text,
            fmt::format("Correct {}, then run berth doctor again.",
                        text.substr(0, text.find(':')))});
    }
  }

  void say_next(const std::string& scene) const {
    std::vector<std::string> next = fix_;
    next.insert(next.end(), improve_.begin(), improve_.end());
    if (next.empty()) return fmt::print("\nNothing is left to do: berth run {}\n", scene);
    fmt::print("\nWhat to do next:\n");
    for (std::size_t i = 0; i < next.size(); ++i) fmt::print("{}. {}\n", i + 1, next[i]);
  }
  bool is_wrong() const { return wrong_ > 0; }
  int left_out() const { return left_out_; }

 private:
  int wrong_ = 0;
  /// Checks that were not run, since one before them found something wrong.
  int left_out_ = 0;
  /// What to do next: where something is wrong, and then where something could be better.
  std::vector<std::string> fix_, improve_;
};

}  // namespace

void doctor_command(const DoctorArguments& arguments) {
  Doctor doctor;
  std::optional<OpenScene> scene;
  using Findings = std::vector<Finding>;
  doctor.look("files", [&](const Pause& pause) {
    scene = open_scene(read_scene(arguments.scene), pause);
    Findings found{check_images(*scene, pause)};
    for (const std::string& warning : scene->warnings) {
      found.push_back(
          {Verdict::advice, "scene", warning,
           "Read the lines \"advice  scene\": where one is not what you want, change the "
           "file that it names."});
    }
    return found;
  });
  doctor.look("stamps", [&](const Pause&) { return check_stamps(*scene); });
  doctor.look("places", [&](const Pause&) { return check_poses(*scene); });
  doctor.look("no reading", [&](const Pause&) { return check_unread(*scene); });
  doctor.look("in no image", [&](const Pause&) { return Findings{check_views(*scene)}; });
  doctor.look("known", [&](const Pause&) { return Findings{check_known(*scene)}; });
  doctor.look("results", [&](const Pause& pause) { return check_results(*scene, pause); });
  doctor.look("detection", [&](const Pause&) { return check_detection(*scene); });
  doctor.look("watch", [&](const Pause&) { return check_watch(*scene); });
  doctor.look("separation", [&](const Pause&) { return Findings{check_separation(*scene)}; });
  doctor.look("time", [&](const Pause& pause) { return check_time(*scene, pause); });
  doctor.say_next(arguments.scene.string());
  if (doctor.is_wrong()) {
    throw std::runtime_error(fmt::format(
        "{}: a check found it wrong, and {} after it were not run; standard output says "
        "what to do",
        arguments.scene.string(), doctor.left_out()));
  }
}

}  // namespace berth::app
