#!/bin/sh
# build.sh FOLDER: builds the page of this build; status 77, "skipped" to ctest, where npm's packages cannot be fetched.
set -eu
npm ping >/dev/null 2>&1 || { echo "skipped: npm, or the packages that it fetches, cannot be reached" >&2; exit 77; }
exec cmake --build "$1" --target berth_page
