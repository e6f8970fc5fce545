#include "lab/closed_loop/film.hpp"

#include <fmt/format.h>

#include <array>

#include "apps/berth/picture.hpp"
#include "apps/berth/picture_projection.hpp"
#include "berth/files/file_bytes.hpp"
#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/goals.hpp"

namespace berth::lab {
namespace {

/// Of the encounter's time.
constexpr std::array kPictures = {0.12, 0.3, 0.42, 0.55, 0.8};

template <class Filmed>
class FilmedSupervisor : public Filmed {
 public:
  template <class... More>
  FilmedSupervisor(double duration_s, std::filesystem::path folder, More... more)
      : Filmed({0, 1, 2}, cell_separation(SimulationSettings().request_hz), more...),
        duration_s_(duration_s),
        folder_(std::move(folder)) {}

  void see(std::size_t which, const DepthImage& depth_m, double stamp_s,
           const JointBuffer& joints) override {
    Filmed::see(which, depth_m, stamp_s, joints);
    if (which == 0) newest_depth_m_ = depth_m;
  }

  double scale(const Situation& situation) override {
    const double scale = Filmed::scale(situation);
    const bool is_time =
        taken_ < kPictures.size() && situation.now_s >= kPictures[taken_] * duration_s_;
    if (is_time && this->newest(0)) draw(situation.now_s);
    return scale;
  }

 private:
  void draw(double now_s) {
    const Frame& frame = *this->newest(0);
    const auto links = app::projected(frame.mounted->camera(), frame.X_BC, this->result().links);
    app::write_picture(
        folder_ / fmt::format("film_{}.png", taken_),
        {newest_depth_m_, &frame.robot, &frame.obstacles, &links, kCellRange_m,
         fmt::format("{:.2f} s, speed {:.0f} %", now_s, 100 * this->last().speed_scale)});
    ++taken_;
  }

  double duration_s_;
  std::filesystem::path folder_;
  DepthImage newest_depth_m_;
  std::size_t taken_ = 0;
};

}  // namespace

void film_encounter(std::uint32_t seed, bool has_goals, const std::filesystem::path& folder) {
  const SimulationSettings settings;
  const double duration_s = sim::Visit(settings.kind, seed).duration_s();
  std::vector<LoopSample> samples;
  if (has_goals) {
    FilmedSupervisor<GoalSupervisor> supervisor(duration_s, folder, settings.request_hz);
    simulate(seed, supervisor, settings, &samples);
  } else {
    FilmedSupervisor<MonitorSupervisor> supervisor(duration_s, folder);
    simulate(seed, supervisor, settings, &samples);
  }
  std::string csv = "time_s,clearance_m,fastest_m_s,scale\n";
  for (const LoopSample& s : samples) {
    csv += fmt::format("{:.3f},{:.4f},{:.4f},{:.4f}\n", s.time_s, s.clearance_m, s.fastest_m_s,
                       s.scale);
  }
  write_file_bytes(folder / "samples.csv", csv);
}

}  // namespace berth::lab
