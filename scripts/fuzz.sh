#!/bin/sh
# fuzz.sh SECONDS [READER...]: builds the readers' fuzzers and runs each for so long under libFuzzer, from the inputs in
# tests/broken_files/. New inputs go to build/fuzz/corpus/, what was found to build/fuzz/found/. The status is 1 where
# anything was found, 2 where the arguments are wrong.
set -eu
cd "$(dirname "$0")/.."
all="png camera_info scene joints_csv urdf stl obj dae recording"

usage() {
  echo "fuzz: $1; expected SECONDS [READER...], readers: $all" >&2
  exit 2
}
case ${1:-} in
  '' | *[!0-9]*) usage "the seconds for each reader are \"${1:-}\"" ;;
esac
# libFuzzer would run for ever.
[ "$1" -gt 0 ] || usage "the seconds for each reader are $1"
seconds=$1
shift
for reader in "$@"; do
  case " $all " in *" $reader "*) ;; *) usage "there is no reader \"$reader\"" ;; esac
done
# shellcheck disable=SC2086
[ $# -gt 0 ] || set -- $all

scripts/setup.sh packages.txt packages-fuzz.txt
cmake --preset fuzz
# shellcheck disable=SC2046
cmake --build --preset fuzz --target $(printf 'fuzz_%s ' "$@")

export ASAN_OPTIONS="allocator_may_return_null=0:detect_odr_violation=0"
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
# A ring of links leaves urdfdom's shared pointers holding each other.
export LSAN_OPTIONS="suppressions=$PWD/cmake/lsan.supp:print_suppressions=0"
# A file for each input: in memory that is 30 times as fast.
[ ! -w /dev/shm ] || export TMPDIR=/dev/shm
TMPDIR=$(mktemp -d)
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
trap 'echo "fuzz: stopped at $reader; its new inputs are in build/fuzz/corpus/$reader"; exit 130' INT TERM

status=0
for reader in "$@"; do
  corpus=build/fuzz/corpus/$reader
  found=build/fuzz/found/$reader
  mkdir -p "$corpus" "$found"
  echo "fuzz $reader for $seconds s, log: $found.log"
  if build/fuzz/fuzz_"$reader" -max_total_time="$seconds" -max_len=16384 -timeout=10 -rss_limit_mb=2048 \
    -print_final_stats=1 -artifact_prefix="$found/" "$corpus" "tests/broken_files/$reader" >"$found.log" 2>&1; then
    sed -n 's/^stat::number_of_executed_units: */  nothing found, inputs: /p' "$found.log"
  else
    status=1
    grep -E "ERROR|SUMMARY|runtime error" "$found.log" || tail -n 5 "$found.log"
    sed -n 's/.*Test unit written to \(.*\)/  once more: build\/fuzz\/fuzz_'"$reader"' \1/p' "$found.log"
  fi
done
exit $status
