#!/bin/sh
# update_results.sh DIR: puts the tables that `berth_bench --out DIR` wrote below the marker of RESULTS.md, and
# draws its chart. The words above the marker are yours to keep true.
set -eu
[ $# -eq 1 ] || { echo "usage: update_results.sh DIR, the folder given to berth_bench --out" >&2; exit 2; }
results=$(dirname "$0")/RESULTS.md
tables=$1/results.md
[ -s "$tables" ] || { echo "$tables: missing or empty; expected the tables of berth_bench --out $1" >&2; exit 1; }
words=$(sed '/^<!-- tables -->$/q' "$results")
{ printf '%s\n\n' "$words"; cat "$tables"; } > "$results.new"
mv "$results.new" "$results"
"$(dirname "$0")/plot.py" "$1/bench.csv" "$(dirname "$0")/results.svg"
