#include "lab/bench/compare.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "lab/bench/peer.hpp"
#include "lab/bench/statistics.hpp"

namespace berth::lab {
namespace {

const std::vector<std::string> kCompareColumns = {
    "median ms",   "p99 ms",          "max ms",      "build ms",   "speed-up",    "memory MB",
    "known to mm", "error median mm", "too near mm", "too far mm", "links missed"};

/// What one method did on all scenes so far.
struct Record {
  std::vector<double> total_ms;
  std::vector<double> build_ms;
  std::vector<double> error_mm;
  std::optional<double> known_to_mm;
  double too_near_mm = 0;
  double too_far_mm = 0;
  double links_missed = 0;
  std::int64_t held_bytes = 0;
  std::int64_t most_bytes = 0;
};

void take_errors(const PeerDistances& truth_m, const PeerDistances& answer_m, Record& record) {
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    if (truth_m[i] && !answer_m[i]) ++record.links_missed;
    if (!truth_m[i] || !answer_m[i]) continue;
    const double error_mm = 1000.0 * (*answer_m[i] - *truth_m[i]);
    record.error_mm.push_back(std::abs(error_mm));
    record.too_far_mm = std::max(record.too_far_mm, error_mm);
    record.too_near_mm = std::max(record.too_near_mm, -error_mm);
  }
}

/// Bytes that the program has allocated and not yet freed.
std::int64_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

/// The times, what the method certifies, and the memory that it holds afterwards.
void take_all(Peer& peer, const BenchScene& scene, const RunLimits& limits, Record& record,
              PeerDistances& answer_m) {
  app::stop_if_interrupted();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, peer.threads());
  answer_m.reserve(scene.link_count);
  const std::int64_t before = heap_bytes();
  peer.load(scene);
  const PeerTime time = time_peer(peer, scene, limits, answer_m);
  record.held_bytes += heap_bytes() - before;
  record.most_bytes = std::max(record.most_bytes, record.held_bytes);
  record.build_ms.push_back(time.build_ms);
  record.total_ms.push_back(time.total_ms);
  if (const auto known_to_m = peer.known_to_m()) {
    record.known_to_mm = std::max(record.known_to_mm.value_or(0), 1000 * *known_to_m);
  }
}

/// Nothing for brute force, which has no errors.
std::optional<double> if_compared(const Record& record, double value) {
  return record.error_mm.empty() ? std::nullopt : std::optional(value);
}

Table::Row row_of(const Peer& peer, const Record& record, const Record& truth) {
  const std::string lacks = peer.lacks();
  return {
      peer.name(),
      {median(record.total_ms), percentile(record.total_ms, 0.99), percentile(record.total_ms, 1),
       median(record.build_ms), median(truth.total_ms).value() / median(record.total_ms).value(),
       static_cast<double>(record.most_bytes) / 1e6, record.known_to_mm, median(record.error_mm),
       if_compared(record, record.too_near_mm), if_compared(record, record.too_far_mm),
       if_compared(record, record.links_missed)},
      lacks.empty() ? "" : "lacks: " + lacks};
}

double image_bytes(const BenchScene& scene) {
  const auto bytes = [](const auto& pixels) {
    return static_cast<double>(pixels.size() * sizeof(pixels[0]));
  };
  return bytes(scene.robot.depth_m.pixels()) + bytes(scene.robot.link_id.pixels()) +
         bytes(scene.obstacle_depth_m.pixels());
}

/// The floor, with how much of memory's speed it is.
Table::Row reader_row(const Peer& reader, const Record& record, double bytes) {
  const double median_ms = median(record.total_ms).value();
  Table::Row row{reader.name(), {}, ""};
  row.values = {median_ms, percentile(record.total_ms, 0.99), percentile(record.total_ms, 1),
                median(record.build_ms)};
  row.values.resize(kCompareColumns.size());
  row.remark = fmt::format("{:.1f} MB at {:.0f} GB/s", bytes / 1e6, bytes / 1e6 / median_ms);
  return row;
}

/// The methods in the order of scene i. Nobody always comes after the same other one, whose data
/// fills the caches; after those with company come none, since threads of TBB that wait
/// for more work would be billed to the next.
std::vector<std::size_t> order_of(const std::vector<std::unique_ptr<Peer>>& peers, int i) {
  std::vector<std::size_t> order(peers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::rotate(order.begin(), order.begin() + i % order.size(), order.end());
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t p) { return !peers[p]->has_company(); });
  return order;
}

}  // namespace

Table compare_peers(const SceneSet& scenes, const RunLimits& limits,
                    const std::vector<std::unique_ptr<Peer>>& peers) {
  const std::unique_ptr<Peer> brute_force = make_brute_force();
  const std::unique_ptr<Peer> reader = make_reader();
  Record truth;
  Record read;
  std::vector<Record> records(peers.size());
  PeerDistances truth_m;
  PeerDistances answer_m;
  double bytes = 0;
  app::ProgressBar progress(scenes.title, scenes.count);
  for (int i = 0; i < scenes.count; ++i) {
    const BenchScene scene = scenes.make(i);
    bytes = image_bytes(scene);
    take_all(*brute_force, scene, limits, truth, truth_m);
    take_all(*reader, scene, limits, read, answer_m);
    for (const std::size_t p : order_of(peers, i)) {
      take_all(*peers[p], scene, limits, records[p], answer_m);
      take_errors(truth_m, answer_m, records[p]);
    }
    progress.step();
  }

  Table table{scenes.title, scenes.note, "method", kCompareColumns, {}};
  table.rows.push_back(reader_row(*reader, read, bytes));
  for (std::size_t p = 0; p < peers.size(); ++p) {
    table.rows.push_back(row_of(*peers[p], records[p], truth));
  }
  table.rows.push_back(row_of(*brute_force, truth, truth));
  return table;
}

}  // namespace berth::lab
