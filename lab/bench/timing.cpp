#include "lab/bench/timing.hpp"

#include "lab/bench/statistics.hpp"
#include "lab/measure/stopwatch.hpp"

namespace berth::lab {
namespace {

clockid_t clock_for(const Peer& peer) {
  return peer.has_company() ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID;
}

PeerTime run_once(Peer& peer, const BenchScene& scene, PeerDistances& distances_m) {
  peer.begin();
  const Stopwatch watch(clock_for(peer));
  peer.prepare(scene);
  const double build_ms = watch.ms();
  peer.evaluate(scene, distances_m);
  return {build_ms, watch.ms()};
}

}  // namespace

PeerTime time_peer(Peer& peer, const BenchScene& scene, const RunLimits& limits,
                   PeerDistances& distances_m) {
  const PeerTime first = run_once(peer, scene, distances_m);
  if (first.total_ms > limits.once_above_ms) return first;
  std::vector<double> build_ms;
  std::vector<double> total_ms;
  const Stopwatch watch;
  do {
    const PeerTime run = run_once(peer, scene, distances_m);
    build_ms.push_back(run.build_ms);
    total_ms.push_back(run.total_ms);
  } while (static_cast<int>(total_ms.size()) < limits.max_runs && watch.ms() < limits.enough_ms);
  return {median(build_ms).value(), median(total_ms).value()};
}

}  // namespace berth::lab
