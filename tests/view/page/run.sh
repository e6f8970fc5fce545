#!/bin/sh
# run.sh PAGE COMMAND...: runs the command where the page is built; else status 77, which is "skipped" to ctest.
set -eu
page=$1
shift
[ -e "$page/index.html" ] || { echo "skipped: $page is not built" >&2; exit 77; }
exec "$@"
