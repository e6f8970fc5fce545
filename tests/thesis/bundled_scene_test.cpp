// The bundled scene, whose true distances are known: mesh to mesh, by FCL.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "thesis/brute_force.hpp"
#include "thesis/image_query.hpp"

namespace berth {
namespace {

/// On this scene no distance is larger by more than this than the true one of what the camera sees
/// of the link: the padding hides an obstacle's nearest pixels (20 mm), and the sensor's noise and
/// steps move its depth.
constexpr double kMaxOverestimateOfSeen_m = 0.010;
/// The camera does not see the link's far side, nor the far side of an obstacle: against the whole
/// link.
constexpr double kMaxOverestimateOfWhole_m = 0.090;

struct Truth {
  double whole_m;
  double seen_m;
};

std::map<std::pair<int, std::string>, Truth> read_truth(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::map<std::pair<int, std::string>, Truth> truth;
  while (std::getline(stream, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    int frame = 0;
    std::string link;
    Truth row{};
    fields >> frame >> link >> row.whole_m >> row.seen_m;
    truth[{frame, link}] = row;
  }
  return truth;
}

TEST(BundledScene, NoDistanceIsAboveTheTrueOneByMoreThanTheNamedBound) {
  const std::string folder = BERTH_SOURCE_DIR "/data/bundled";
  const auto truth = read_truth(folder + "/truth.csv");
  const OpenScene scene = open_scene(folder + "/one_camera.yaml");
  const OpenCamera& camera = scene.cameras.front();
  const std::vector<std::string> names = camera.mounted->robot()->model().evaluated_link_names();
  Observer observer(camera.mounted);
  ImageQuery query(scene.robot, Method::exact);
  Frame frame;
  std::map<std::string, std::pair<double, double>>
      over_m;  // least and greatest, against what is seen
  ASSERT_GE(camera.source.depth.size(), 30U);
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    observer.observe(camera.read_depth(i), camera.at_exposure[i], frame);
    for (const LinkResult& link : query.ask(frame).links) {
      const std::string& name = names[link.id - 1];
      const Truth& row = truth.at({static_cast<int>(i), name});
      ASSERT_EQ(link.status, LinkStatus::ok) << "frame " << i << ", " << name;
      EXPECT_LE(link.distance_m, row.seen_m + kMaxOverestimateOfSeen_m)
          << "frame " << i << ", " << name;
      EXPECT_LE(link.distance_m, row.whole_m + kMaxOverestimateOfWhole_m)
          << "frame " << i << ", " << name;
      const double over = link.distance_m - row.seen_m;
      const auto [entry, is_new] = over_m.try_emplace(name, over, over);
      entry->second = {std::min(entry->second.first, over), std::max(entry->second.second, over)};
    }
  }
  for (const auto& [name, range] : over_m) {
    fmt::print("{}: distance minus the true one of what is seen: {:+.4f} to {:+.4f} m\n", name,
               range.first, range.second);
  }
}

TEST(BundledScene, BruteForceGivesTheSameDistances) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  const OpenCamera& camera = scene.cameras.front();
  Observer observer(camera.mounted);
  ImageQuery query(scene.robot, Method::exact);
  Frame frame;
  const std::size_t closest_approach = 19;
  observer.observe(camera.read_depth(closest_approach), camera.at_exposure[closest_approach],
                   frame);
  const ImageResult exact = query.ask(frame);
  const SearchableDepth obstacles(frame.obstacles.depth_m);
  LinkDistances brute;
  brute_force({camera.mounted->camera(),
               frame.robot,
               camera.mounted->robot()->model().link_count(),
               obstacles,
               {}},
              brute);
  ASSERT_EQ(brute.links.size(), exact.links.size());
  for (std::size_t i = 0; i < brute.links.size(); ++i) {
    EXPECT_EQ(brute.links[i].status, exact.links[i].status);
    EXPECT_NEAR(brute.links[i].distance_m, exact.links[i].distance_m, 1e-5);
  }
}

}  // namespace
}  // namespace berth
