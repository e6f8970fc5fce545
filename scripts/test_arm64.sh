#!/usr/bin/env bash
# Builds all for ARM64 and runs the tests in qemu, with these options of ctest. For scripts/bare.sh: it adds the architecture to the
# system that it runs in.
set -euo pipefail
cd "$(dirname "$0")"
dpkg --add-architecture arm64
apt-get update -qq
apt-get install -qq --no-install-recommends crossbuild-essential-arm64 qemu-user-static ccache cmake dart-doc fonts-dejavu-core glslang-tools ninja-build \
  nlohmann-json3-dev pkg-config python3 \
  $(grep -hE '^(lib|zlib)' packages.txt packages-opengl.txt packages-lab.txt packages-tests.txt | sed 's/$/:arm64/')
# Programs of ARM64 that tests start run in qemu, too. The kernel knows of that for as long as the tests take, unless it did before.
formats=/proc/sys/fs/binfmt_misc
[ -e $formats/register ] || mount -t binfmt_misc binfmt_misc $formats
if [ ! -e $formats/qemu-aarch64 ]; then
  cat /usr/lib/binfmt.d/qemu-aarch64.conf >$formats/register
  trap 'echo -1 >$formats/qemu-aarch64' EXIT
fi
cd ..
cmake --preset arm64
cmake --build --preset arm64
ctest --preset arm64 -j2 "$@"
