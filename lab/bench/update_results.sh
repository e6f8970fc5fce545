#!/bin/sh
# update_results.sh DIR: puts the tables that `berth_bench --out DIR` wrote between their markers in RESULTS.md.
# Of a run with --whole-robot only those of the whole robot are there. The words are yours to keep true.
set -eu
[ $# -eq 1 ] || { echo "usage: update_results.sh DIR, the folder given to berth_bench --out" >&2; exit 2; }
results=$(dirname "$0")/RESULTS.md

# put MARKER FILE: the file's lines take the place of those between <!-- MARKER --> and <!-- end of MARKER -->.
put() {
  sed -e "/^<!-- $1 -->\$/,/^<!-- end of $1 -->\$/{//!d}" "$results" |
    sed -e "/^<!-- $1 -->\$/{G;r $2" -e '}' -e "s/^<!-- end of $1 -->\$/\n&/" > "$results.new"
  mv "$results.new" "$results"
}

[ -s "$1/results.md" ] || [ -s "$1/whole_robot.md" ] ||
  { echo "$1: no results.md or whole_robot.md; expected the tables of berth_bench --out $1" >&2; exit 1; }
[ ! -s "$1/whole_robot.md" ] || put "whole robot" "$1/whole_robot.md"
[ ! -s "$1/results.md" ] || put tables "$1/results.md"
