#include "bench/compare.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "apps/berth/interrupt.hpp"
#include "apps/berth/progress_bar.hpp"
#include "bench/heap.hpp"
#include "bench/peer.hpp"
#include "bench/statistics.hpp"

namespace berth::bench {
namespace {

const std::vector<std::string> kColumns = {"median ms",   "p99 ms",     "max ms",
                                           "build ms",    "memory MB",  "error median mm",
                                           "too near mm", "too far mm", "links missed"};

/// What one method did on all scenes so far.
struct Record {
  std::vector<double> total_ms;
  std::vector<double> build_ms;
  std::vector<double> error_mm;
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

/// The times, and the memory that the method holds afterwards.
void take_all(Peer& peer, const BenchScene& scene, const RunLimits& limits, Record& record,
              PeerDistances& answer_m) {
  answer_m.reserve(scene.link_count);
  const std::int64_t before = heap_bytes();
  peer.load(scene);
  const PeerTime time = time_peer(peer, scene, limits, answer_m);
  record.held_bytes += heap_bytes() - before;
  record.most_bytes = std::max(record.most_bytes, record.held_bytes);
  record.build_ms.push_back(time.build_ms);
  record.total_ms.push_back(time.total_ms);
}

/// Nothing for brute force, which has no errors.
std::optional<double> if_compared(const Record& record, double value) {
  return record.error_mm.empty() ? std::nullopt : std::optional(value);
}

Table::Row row_of(const Peer& peer, const Record& record) {
  const std::string lacks = peer.lacks();
  return {
      peer.name(),
      {median(record.total_ms), percentile(record.total_ms, 0.99), percentile(record.total_ms, 1),
       median(record.build_ms), static_cast<double>(record.most_bytes) / 1e6,
       median(record.error_mm), if_compared(record, record.too_near_mm),
       if_compared(record, record.too_far_mm), if_compared(record, record.links_missed)},
      lacks.empty() ? "" : "lacks: " + lacks};
}

}  // namespace

Table compare_peers(const SceneSet& scenes, const RunLimits& limits) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const std::unique_ptr<Peer> brute_force = make_brute_force();
  const std::vector<std::unique_ptr<Peer>> peers = make_peers();
  Record truth_record;
  std::vector<Record> records(peers.size());
  PeerDistances truth_m;
  PeerDistances answer_m;
  ProgressBar progress(scenes.title, scenes.count);
  for (int i = 0; i < scenes.count; ++i) {
    const BenchScene scene = scenes.make(i);
    take_all(*brute_force, scene, limits, truth_record, truth_m);
    // Nobody always comes after the same other one, whose data fills the caches.
    for (std::size_t k = 0; k < peers.size(); ++k) {
      stop_if_interrupted();
      const std::size_t p = (k + i) % peers.size();
      take_all(*peers[p], scene, limits, records[p], answer_m);
      take_errors(truth_m, answer_m, records[p]);
    }
    progress.step();
  }

  Table table{scenes.title, scenes.note, "method", kColumns, {}};
  for (std::size_t p = 0; p < peers.size(); ++p) {
    table.rows.push_back(row_of(*peers[p], records[p]));
  }
  table.rows.push_back(row_of(*brute_force, truth_record));
  return table;
}

}  // namespace berth::bench
