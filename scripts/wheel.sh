#!/usr/bin/env bash
# Builds the wheel that stands alone in a bare Debian 12, and imports it in another one that has Python and numpy: build/wheel.
set -euo pipefail
cd "$(dirname "$0")/.."
made=build/bare/bookworm/build/wheel
rm -rf "$made" build/wheel
# scikit-build-core is in Debian from 13 on; it and what it reads versions with are Python alone.
scripts/bare.sh bookworm '
  apt-get install -qq --no-install-recommends $(grep -hv "^#" scripts/packages.txt scripts/packages-python.txt) \
    patchelf python3-pathspec python3-pip python3-pyproject-metadata
  echo "deb http://deb.debian.org/debian trixie main" >/etc/apt/sources.list.d/trixie.list
  printf "Package: *\nPin: release n=trixie\nPin-Priority: 1\n" >/etc/apt/preferences.d/trixie
  apt-get update -qq
  apt-get install -qq --no-install-recommends python3-{packaging,scikit-build-core}/trixie
  python3 -m pip wheel . --no-build-isolation --no-deps --no-index --wheel-dir build/wheel
  scripts/repair_wheel.py build/wheel/berth-*-linux_*.whl build/wheel/alone libeigen3-dev nlohmann-json3-dev pybind11-dev'
scripts/bare.sh bookworm '
  apt-get install -qq --no-install-recommends python3-numpy
  python3 -m zipfile -e build/wheel/alone/*.whl /usr/lib/python3/dist-packages
  cd /
  python3 /berth/examples/python/look_ahead.py /berth/data/bundled/scene.yaml'
mv "$made/alone" build/wheel
ls -l build/wheel
