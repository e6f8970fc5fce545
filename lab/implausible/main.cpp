#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "berth/scene/simple_mistakes.hpp"
#include "lab/implausible/good_scenes.hpp"
#include "lab/implausible/mistakes.hpp"

namespace berth::lab {
namespace {
double seen(const RobotReadings& r) { return r.at_surface + r.behind + r.before + r.hidden; }
void print(const std::string& scene, const std::string& what, const OpenScene& s, std::size_t c, bool tries) {
  RobotInImages images(s, c);
  const RobotReadings r = images.readings(images.given());
  fmt::print("{}\t{}\t{}\tA {:.3f}\tS {:.3f}\tat {} behind {} before {} hidden {} none {}", scene, s.cameras[c].source.name, what,
             r.at_surface / double(std::max(1, r.at_surface + r.behind)), r.at_surface / std::max(1.0, seen(r)), r.at_surface, r.behind,
             r.before, r.hidden, r.none);
  if (tries) {
    std::vector<std::pair<double, std::string>> found;
    for (const auto& m : simple_mistakes(s, images)) {
      const RobotReadings t = images.readings(m.corrected);
      found.push_back({t.at_surface / std::max(1.0, seen(t)), fmt::format("{} ({} px)", m.as_if, seen(t))});
    }
    std::sort(found.rbegin(), found.rend());
    for (int i = 0; i < 3; ++i) fmt::print("\t{:.3f} {}", found[i].first, found[i].second);
  }
  fmt::print("\n");
  std::fflush(stdout);
}
int run(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const OpenScene right = open_scene(argv[i]);
    const std::string name = argv[i];
    for (std::size_t c = 0; c < right.cameras.size(); ++c) {
      print(name, "RIGHT", right, c, true);
      for (const MadeMistake& m : mistakes_in(right)) {
        OpenScene wrong = right;
        m.make(wrong, c);
        print(name, "WRONG " + m.name, wrong, c, true);
      }
      for (const auto& [cm, deg] : {std::pair{2, 2}, {5, 5}, {20, 15}}) {
        for (int seed = 0; seed < 15; ++seed) {
          OpenScene off = right;
          move_camera(off, c, cm / 100.0, deg * 3.14159 / 180, seed);
          print(name, fmt::format("OFF {} {}", cm, deg), off, c, true);
        }
      }
      for (int seed = 0; seed < 50; ++seed) {
        OpenScene hidden = right;
        hide_robot(hidden, c, seed);
        print(name, "HIDDEN", hidden, c, seed % 5 == 0);
      }
    }
  }
  return 0;
}
}  // namespace
}  // namespace berth::lab
int main(int argc, char** argv) { return berth::lab::run(argc, argv); }
