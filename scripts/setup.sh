#!/bin/sh
# Installs the Debian packages that are missing; silent where nothing is.
set -eu
folder=$(dirname "$0")
missing=
for package in $(grep -v '^#' "$folder/packages.txt"); do
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
