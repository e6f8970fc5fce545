#!/bin/sh
# lint.sh [PART]: clang-tidy 14 (.clang-tidy) over src and apps; over folders with PART in their paths where it is given.
set -eu
cd "$(dirname "$0")/.."
exec run-clang-tidy-14 -quiet -p build/lint -j "$(nproc)" "/(src|apps)/.*${1:-}"
