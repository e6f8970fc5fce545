#include "lab/stream/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "berth/scene/open_scene.hpp"

namespace berth::lab {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

Film film_of_scene(const OpenScene& scene, const StreamSettings& settings) {
  require(settings.cameras <= static_cast<int>(scene.cameras.size()),
          fmt::format("{}: has {} cameras; --cameras {} asks for more", settings.scene.string(),
                      scene.cameras.size(), settings.cameras));
  require(
      scene.joints->last_s() > scene.joints->first_s(),
      fmt::format("{}: the joints have a single time; expected a robot that is filmed over time",
                  scene.joints->source()));
  Film film{scene.robot, scene.joints, {}};
  film.cameras.resize(settings.cameras == 0 ? scene.cameras.size() : settings.cameras);
  for (std::size_t k = 0; k < film.cameras.size(); ++k) {
    const OpenCamera& from = scene.cameras[k];
    FilmedCamera& to = film.cameras[k];
    to.mounted = from.mounted;
    for (std::size_t i = 0; i < from.at_exposure.size(); ++i) {
      to.stamps_s.push_back(from.at_exposure[i].stamp_s);
      to.depth_m.push_back(from.read_depth(i));
    }
  }
  return film;
}

}  // namespace

Film film_of(const StreamSettings& settings) {
  const OpenScene scene = open_scene(settings.scene);
  if (!settings.room) return film_of_scene(scene, settings);
  const auto cameras = static_cast<std::size_t>(settings.cameras);
  return film_of_room(scene.robot, scene.cameras.front().mounted->settings(), *settings.room,
                      cameras == 0 ? scene.cameras.size() : cameras);
}

double Play::film_s(double time_s) const {
  const double turns = (time_s - begin_s) / length_s();
  const double part = turns - std::floor(turns);
  const bool is_forth = std::fmod(std::floor(turns), 2) == 0;
  return first_s + (is_forth ? part : 1 - part) * (last_s - first_s);
}

double Play::time_s(double film_s, int turn) const {
  const double from_begin_s = (turn % 2 == 0 ? film_s - first_s : last_s - film_s) / speed;
  return begin_s + turn * length_s() + from_begin_s;
}

std::vector<Shown> shown_images(const Film& film, const Play& play, double seconds) {
  std::vector<Shown> shown;
  for (int turn = 0; turn * play.length_s() < seconds; ++turn) {
    for (std::size_t k = 0; k < film.cameras.size(); ++k) {
      for (std::size_t i = 0; i < film.cameras[k].stamps_s.size(); ++i) {
        const double time_s = play.time_s(film.cameras[k].stamps_s[i], turn);
        if (time_s < play.begin_s + seconds) shown.push_back({time_s, k, i});
      }
    }
  }
  std::ranges::sort(shown, {}, &Shown::time_s);
  return shown;
}

}  // namespace berth::lab
