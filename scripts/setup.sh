#!/bin/sh
# Installs the Debian packages that are missing; silent where nothing is.
# setup.sh [LIST...]: lists of packages in this folder; packages.txt where none is named.
set -eu
cd "$(dirname "$0")"
[ $# -gt 0 ] || set -- packages.txt
missing=
for package in $(cat "$@" | grep -v '^#'); do
  dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii' || missing="$missing $package"
done
[ -z "$missing" ] && exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup: these packages are missing, and there is neither root nor sudo to install them:$missing" >&2; exit 1; }
  as_root=sudo
fi
echo "Installing$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -q
# shellcheck disable=SC2086
$as_root apt-get install -q -y --no-install-recommends $missing
