#include "lab/bench/growth.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "lab/bench/drawn_scenes.hpp"
#include "lab/bench/statistics.hpp"

namespace berth::lab {
namespace {

const std::vector<std::string> kGrowthColumns = {"pixels", "robot pixels", "median ms", "max ms",
                                                 "build ms"};

struct Size {
  int width;
  int height;
  int links;
};

double robot_pixels(const BenchScene& scene) {
  double count = 0;
  for (const LinkId id : scene.robot.link_id.pixels()) count += id != kNoLink;
  return count;
}

Table::Row measure(std::string name, const Size& size, int scenes, const RunLimits& limits) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const std::unique_ptr<Peer> exact = make_berth_exact();
  std::vector<double> build_ms;
  std::vector<double> total_ms;
  std::vector<double> pixels;
  PeerDistances distances_m;
  for (int seed = 0; seed < scenes; ++seed) {
    app::stop_if_interrupted();
    const BenchScene scene = scene_of(
        sim::random_images(static_cast<std::uint32_t>(seed), size.width, size.height, size.links));
    const PeerTime time = time_peer(*exact, scene, limits, distances_m);
    build_ms.push_back(time.build_ms);
    total_ms.push_back(time.total_ms);
    pixels.push_back(robot_pixels(scene));
  }
  return {std::move(name),
          {static_cast<double>(size.width) * size.height, median(pixels), median(total_ms),
           percentile(total_ms, 1), median(build_ms)},
          ""};
}

}  // namespace

Table measure_growth_of_image(int scenes, const RunLimits& limits) {
  constexpr Size kSizes[] = {
      {320, 240, 8}, {640, 480, 8}, {960, 540, 8}, {1280, 720, 8}, {1920, 1080, 8}};
  Table table{
      "Growth with the image",
      fmt::format("berth exact, one thread, {} random scenes of each size, 8 links.", scenes),
      "image",
      kGrowthColumns,
      {}};
  app::ProgressBar progress(table.title, std::size(kSizes));
  for (const Size& size : kSizes) {
    table.rows.push_back(
        measure(fmt::format("{} x {}", size.width, size.height), size, scenes, limits));
    progress.step();
  }
  return table;
}

Table measure_growth_of_links(int scenes, const RunLimits& limits) {
  constexpr int kLinks[] = {8, 16, 32, 64};
  Table table{"Growth with the links",
              fmt::format("berth exact, one thread, {} random scenes each, 640 x 480.", scenes),
              "links",
              kGrowthColumns,
              {}};
  app::ProgressBar progress(table.title, std::size(kLinks));
  for (const int links : kLinks) {
    table.rows.push_back(measure(fmt::format("{}", links), {640, 480, links}, scenes, limits));
    progress.step();
  }
  return table;
}

}  // namespace berth::lab
