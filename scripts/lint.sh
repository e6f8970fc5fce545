#!/bin/sh
# lint.sh [PART]: clang-tidy 14 (.clang-tidy) over what build/dev configures; over files with PART in their paths where it is given.
set -eu
cd "$(dirname "$0")/.."
exec run-clang-tidy-14 -quiet -p build/dev -j "$(nproc)" "$(pwd)/(src|apps|lab|tests|fuzz)/.*${1:-}.*\\.cpp"
