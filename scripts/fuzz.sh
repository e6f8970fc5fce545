#!/bin/sh
# fuzz.sh SECONDS [READER...]: each reader under libFuzzer for so long, from the inputs in tests/broken_files/.
# New inputs go to build/fuzz/corpus/, what was found to build/fuzz/found/; the status is 1 where anything was.
set -eu
cd "$(dirname "$0")/.."
seconds=$1
shift
[ $# -gt 0 ] || set -- png camera_info scene joints_csv urdf stl obj dae
export ASAN_OPTIONS="allocator_may_return_null=0:detect_odr_violation=0"
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
# A ring of links leaves urdfdom's shared pointers holding each other.
export LSAN_OPTIONS="suppressions=$PWD/cmake/lsan.supp:print_suppressions=0"
status=0
for reader in "$@"; do
  mkdir -p "build/fuzz/corpus/$reader" "build/fuzz/found/$reader"
  echo "fuzz $reader"
  build/fuzz/fuzz_"$reader" -max_total_time="$seconds" -max_len=8192 -timeout=10 -rss_limit_mb=2048 \
    -print_final_stats=1 -artifact_prefix="build/fuzz/found/$reader/" "build/fuzz/corpus/$reader" \
    "tests/broken_files/$reader" >"build/fuzz/found/$reader.log" 2>&1 || status=1
  grep -E "stat::(number_of_executed_units|peak_rss)|cov: .*DONE|ERROR|SUMMARY|runtime error" "build/fuzz/found/$reader.log" || true
done
exit $status
