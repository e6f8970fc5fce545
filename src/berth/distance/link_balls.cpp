#include "berth/distance/link_balls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace berth::mesh {
namespace {

using Point = Eigen::Vector3f;

/// Pays for the roundings of kinematics.
constexpr float kRounding_m = 2e-5f;

/// A part of a triangle that is small enough to lie in one ball.
struct Piece {
  std::array<Point, 3> corners_m;
  Point middle_m() const { return (corners_m[0] + corners_m[1] + corners_m[2]) / 3; }
};

void split(const Piece& piece, float most_m, std::vector<Piece>& out) {
  std::size_t longest = 0;
  std::array<float, 3> squared_m2;
  for (std::size_t i = 0; i < 3; ++i) {
    squared_m2[i] = (piece.corners_m[(i + 1) % 3] - piece.corners_m[i]).squaredNorm();
    if (squared_m2[i] > squared_m2[longest]) longest = i;
  }
  if (squared_m2[longest] <= most_m * most_m) return out.push_back(piece);
  const std::size_t next = (longest + 1) % 3;
  const Point half_m = (piece.corners_m[longest] + piece.corners_m[next]) / 2;
  Piece first = piece, second = piece;
  first.corners_m[next] = half_m;
  second.corners_m[longest] = half_m;
  split(first, most_m, out);
  split(second, most_m, out);
}

std::vector<Piece> pieces_of(const TriangleMesh& mesh) {
  constexpr std::size_t kEnough = 3000;
  std::vector<Piece> pieces;
  for (float most_m = 0.012f;; most_m *= 1.4f) {
    pieces.clear();
    for (const auto& [a, b, c] : mesh.triangles) {
      split({{mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]}}, most_m, pieces);
    }
    if (pieces.size() <= std::max(kEnough, 2 * mesh.triangles.size())) return pieces;
  }
}

/// About `most` of the pieces, spread over all of them.
std::vector<Piece> some_of(const std::vector<Piece>& pieces, std::size_t most) {
  std::vector<Piece> some;
  const std::size_t step = std::max<std::size_t>(1, pieces.size() / most);
  for (std::size_t i = 0; i < pieces.size(); i += step) some.push_back(pieces[i]);
  return some;
}

/// The least ball about p that holds the piece.
float reach_m(const Point& p_m, const Piece& piece) {
  float squared_m2 = 0;
  for (const Point& corner_m : piece.corners_m) {
    squared_m2 = std::max(squared_m2, (corner_m - p_m).squaredNorm());
  }
  return std::sqrt(squared_m2);
}

/// A place for a ball's centre, and how deep it lies inside.
struct Place {
  Point p_m;
  float depth_m;
};

/// Which places are inside of a surface: those that a flood from outside does not reach. Meshes
/// need not be closed for that, but for gaps of a voxel.
class Inside {
 public:
  explicit Inside(const std::vector<Piece>& pieces) {
    constexpr std::size_t kJudgedBy = 3000;
    for (const Piece& piece : some_of(pieces, kJudgedBy)) middles_m_.push_back(piece.middle_m());
    Eigen::AlignedBox3f box_m;
    for (const Piece& piece : pieces) {
      for (const Point& corner_m : piece.corners_m) box_m.extend(corner_m);
    }
    constexpr float kVoxels = 60'000;
    const Point size_m = box_m.sizes().array() + 0.02f;
    edge_m_ = std::max(0.003f, std::cbrt(size_m.prod() / kVoxels));
    low_m_ = box_m.min().array() - 2 * edge_m_;
    for (int k = 0; k < 3; ++k) count_[k] = static_cast<int>(box_m.sizes()[k] / edge_m_) + 5;
    kinds_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], Kind::inside);
    for (const Piece& piece : pieces) mark(piece);
    flood();
  }

  /// At most `most` places inside, or on the surface, within reach_m of the middle.
  std::vector<Place> places(const Point& middle_m, float reach_m, std::size_t most) const {
    std::vector<Point> all_m;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i] == Kind::outside) continue;
      const Point p_m = middle_of(i);
      if ((p_m - middle_m).squaredNorm() <= reach_m * reach_m) all_m.push_back(p_m);
    }
    std::mt19937 random(1);
    std::ranges::shuffle(all_m, random);
    all_m.resize(std::min(all_m.size(), most));
    std::vector<Place> out;
    for (const Point& p_m : all_m) out.push_back({p_m, depth_m(p_m)});
    return out;
  }

 private:
  enum class Kind : std::uint8_t { inside, surface, outside };

  std::size_t index_of(const Point& p_m) const {
    const Eigen::Vector3i at = ((p_m - low_m_) / edge_m_).cast<int>();
    return (static_cast<std::size_t>(at.z()) * count_[1] + at.y()) * count_[0] + at.x();
  }
  Point middle_of(std::size_t i) const {
    const auto x = i % count_[0], y = i / count_[0] % count_[1], z = i / count_[0] / count_[1];
    return low_m_ +
           edge_m_ * (Eigen::Vector3<std::size_t>(x, y, z).cast<float>().array() + 0.5f).matrix();
  }
  void mark(const Piece& piece) {
    const auto& [a_m, b_m, c_m] = piece.corners_m;
    const float longest_m = std::max({(b_m - a_m).norm(), (c_m - b_m).norm(), (a_m - c_m).norm()});
    const int steps = std::max(1, static_cast<int>(std::ceil(longest_m / (0.45f * edge_m_))));
    for (int i = 0; i <= steps; ++i) {
      for (int k = 0; k <= steps - i; ++k) {
        const float s = static_cast<float>(i) / steps, t = static_cast<float>(k) / steps;
        kinds_[index_of(a_m + s * (b_m - a_m) + t * (c_m - a_m))] = Kind::surface;
      }
    }
  }
  void flood() {
    const std::array<std::ptrdiff_t, 3> step{1, count_[0],
                                             static_cast<std::ptrdiff_t>(count_[0]) * count_[1]};
    std::vector<std::size_t> open{0};
    kinds_[0] = Kind::outside;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (int k = 0; k < 6; ++k) {
        const auto axis = static_cast<std::size_t>(k / 2);
        const auto place = static_cast<std::ptrdiff_t>(at) / step[axis] % count_[axis];
        if (k % 2 == 0 ? place == 0 : place + 1 == count_[axis]) continue;
        const std::size_t next = at + (k % 2 == 0 ? -step[axis] : step[axis]);
        if (kinds_[next] != Kind::inside) continue;
        kinds_[next] = Kind::outside;
        open.push_back(next);
      }
    }
  }
  /// About; nothing depends on it but how well balls fit.
  float depth_m(const Point& p_m) const {
    float squared_m2 = std::numeric_limits<float>::infinity();
    for (const Point& middle_m : middles_m_) {
      squared_m2 = std::min(squared_m2, (middle_m - p_m).squaredNorm());
    }
    return kinds_[index_of(p_m)] == Kind::inside ? std::sqrt(squared_m2) : 0;
  }

  std::vector<Point> middles_m_;
  Point low_m_;
  float edge_m_ = 0;
  std::array<int, 3> count_{};
  std::vector<Kind> kinds_;
};

struct Ball {
  Point centre_m;
  float radius_m = 0;
  std::vector<Piece> pieces;
};

/// Up to eight balls about some of the places that hold all pieces, and stick out of the surface as
/// little as a greedy choice finds. It is made for some of the pieces; the balls then hold all.
class Cover {
 public:
  Cover(const std::vector<Piece>& all, const std::vector<Place>& places)
      : all_(all), pieces_(some_of(all, kChosenFor)), places_(places) {
    excess_m_.resize(pieces_.size() * places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t k = 0; k < pieces_.size(); ++k) row(i)[k] = excess_of(i, pieces_[k]);
    }
  }

  std::vector<Ball> find() {
    std::vector<std::size_t> best, chosen;
    float low_m = 0, high_m = 1;
    // The first one holds for sure: one ball may stick out by as much as it likes.
    while (!choose(high_m, best)) high_m *= 2;
    for (int i = 0; i < 10; ++i) {
      const float middle_m = (low_m + high_m) / 2;
      if (choose(middle_m, chosen)) {
        high_m = middle_m;
        best = chosen;
      } else {
        low_m = middle_m;
      }
    }
    for (int i = 0; i < 4; ++i) move(best);
    return balls(best);
  }

 private:
  static constexpr std::size_t kChosenFor = 1000;

  float excess_of(std::size_t place, const Piece& piece) const {
    return reach_m(places_[place].p_m, piece) - places_[place].depth_m;
  }
  float* row(std::size_t place) { return &excess_m_[place * pieces_.size()]; }

  /// Whether eight balls, each of which sticks out by most_m, hold all.
  bool choose(float most_m, std::vector<std::size_t>& chosen) {
    std::vector<std::uint8_t> is_open(pieces_.size(), 1);
    std::size_t open = pieces_.size();
    chosen.clear();
    while (open > 0 && chosen.size() < 8) {
      std::size_t best = 0, most = 0;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const float* const excess_m = row(i);
        std::uint32_t held = 0;
        for (std::size_t k = 0; k < pieces_.size(); ++k)
          held += (excess_m[k] <= most_m) & is_open[k];
        if (held > most) most = held, best = i;
      }
      if (most == 0) return false;
      chosen.push_back(best);
      for (std::size_t k = 0; k < pieces_.size(); ++k) is_open[k] &= row(best)[k] > most_m;
      open -= most;
    }
    return open == 0;
  }
  /// Of each piece the ball that holds it with the least excess.
  std::vector<std::size_t> assign(const std::vector<std::size_t>& chosen) {
    std::vector<std::size_t> of(pieces_.size());
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      of[k] = static_cast<std::size_t>(
          std::ranges::min_element(chosen, {}, [&](std::size_t i) { return row(i)[k]; }) -
          chosen.begin());
    }
    return of;
  }
  /// Each ball to the place from where its pieces need the least.
  void move(std::vector<std::size_t>& chosen) {
    const std::vector<std::size_t> of = assign(chosen);
    for (std::size_t q = 0; q < chosen.size(); ++q) {
      std::vector<std::size_t> mine;
      for (std::size_t k = 0; k < of.size(); ++k) {
        if (of[k] == q) mine.push_back(k);
      }
      const auto excess_m = [&](std::size_t i) {
        float most_m = -1;
        for (const std::size_t k : mine) most_m = std::max(most_m, row(i)[k]);
        return most_m;
      };
      float least_m = excess_m(chosen[q]);
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (const float here_m = excess_m(i); here_m < least_m) least_m = here_m, chosen[q] = i;
      }
    }
  }
  std::vector<Ball> balls(const std::vector<std::size_t>& chosen) {
    std::vector<Ball> balls(chosen.size());
    for (std::size_t q = 0; q < chosen.size(); ++q) balls[q].centre_m = places_[chosen[q]].p_m;
    for (const Piece& piece : all_) {
      const auto of = std::ranges::min_element(
          chosen, {}, [&](std::size_t place) { return excess_of(place, piece); });
      Ball& ball = balls[static_cast<std::size_t>(of - chosen.begin())];
      ball.radius_m = std::max(ball.radius_m, reach_m(ball.centre_m, piece) + kRounding_m);
      ball.pieces.push_back(piece);
    }
    std::erase_if(balls, [](const Ball& ball) { return ball.pieces.empty(); });
    return balls;
  }

  const std::vector<Piece>& all_;
  std::vector<Piece> pieces_;
  const std::vector<Place>& places_;
  /// By place, then by piece.
  std::vector<float> excess_m_;
};

/// Eight points of the surface that lie apart.
EightBalls spread_points(const std::vector<Piece>& pieces) {
  EightBalls out;
  std::vector<float> apart_m2(pieces.size(), std::numeric_limits<float>::infinity());
  std::size_t next = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const Point p_m = pieces[next].middle_m();
    out.set(i, p_m, 0);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      apart_m2[k] = std::min(apart_m2[k], (pieces[k].middle_m() - p_m).squaredNorm());
    }
    next = static_cast<std::size_t>(std::ranges::max_element(apart_m2) - apart_m2.begin());
  }
  return out;
}

}  // namespace

LinkBalls build_link_balls(const TriangleMesh& mesh) {
  constexpr std::size_t kCoarsePlaces = 300, kFinePlaces = 150, kOnSurface = 40;
  LinkBalls out;
  const std::vector<Piece> pieces = pieces_of(mesh);
  if (pieces.empty()) return out;
  const Inside inside(pieces);
  const std::vector<Ball> coarse =
      Cover(pieces, inside.places(Point::Zero(), HUGE_VALF, kCoarsePlaces)).find();
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const Ball& ball = coarse[i];
    out.coarse.set(i, ball.centre_m, ball.radius_m);
    out.coarse_points[i] = spread_points(ball.pieces);
    std::vector<Place> places = inside.places(ball.centre_m, ball.radius_m, kFinePlaces);
    const std::size_t step = std::max<std::size_t>(1, ball.pieces.size() / kOnSurface);
    for (std::size_t k = 0; k < ball.pieces.size(); k += step) {
      places.push_back({ball.pieces[k].middle_m(), 0});
    }
    const std::vector<Ball> fine = Cover(ball.pieces, places).find();
    for (std::size_t k = 0; k < fine.size(); ++k) {
      out.fine[i].set(k, fine[k].centre_m, fine[k].radius_m);
      out.fine_points[i][k] = spread_points(fine[k].pieces);
    }
  }
  const Eigen::AlignedBox3f box_m = mesh.bounding_box_m();
  out.centre_m = box_m.center();
  for (const Piece& piece : pieces) {
    out.radius_m = std::max(out.radius_m, reach_m(out.centre_m, piece) + kRounding_m);
  }
  return out;
}

}  // namespace berth::mesh
