#!/usr/bin/env bash
# Builds the Debian packages in a bare Debian and tries them in another one: build/deb. deb.sh SUITE, such as bookworm.
# The source package has the files that git knows, as they are now, and in a second archive what npm would fetch for the page: three.js and
# uPlot as their authors publish them, to be read by people. So the build needs no network.
set -euo pipefail
cd "$(dirname "$0")/.."
suite=$1
version=$(sed -n 's/^project(berth VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
grep -q "^berth ($version-" debian/changelog || { echo "deb: debian/changelog begins with another version than CMakeLists.txt: $version" >&2; exit 1; }
grep -qx "Package: libberth${version%.*}" debian/control || { echo "deb: debian/control names no libberth${version%.*}, as the libraries' version is" >&2; exit 1; }

rm -rf build/deb
mkdir -p build/deb/page build/deb/npm
name=berth-$version
pack() { tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct)" -cJf "$@"; }
git ls-files ':!debian' | pack "build/deb/berth_$version.orig.tar.xz" --transform "s,^,$name/," -T -
command -v npm >/dev/null || scripts/setup.sh packages-page.txt
cp apps/view/page/package*.json build/deb/page
(cd build/deb/page && npm ci --omit=dev --no-audit --no-fund --ignore-scripts --loglevel=error)
(cd build/deb/page/node_modules && cp --parents -r three/{LICENSE,package.json,src,build/three.core.js,build/three.module.js,examples/jsm/{controls,lines}} \
  uplot/{LICENSE,package.json,dist/uPlot.esm.js,dist/uPlot.min.css} ../../npm)
(cd build/deb && pack "berth_$version.orig-npm.tar.xz" npm && rm -r page npm)

work=build/bare/$suite/build/deb
rm -rf "$work"
mkdir -p "$work/$name"
mv build/deb/*.tar.xz "$work"
tar -xf "$work/berth_$version.orig.tar.xz" -C "$work"
tar -xf "$work/berth_$version.orig-npm.tar.xz" -C "$work/$name"
cp -r debian "$work/$name"
scripts/bare.sh "$suite" "cd build/deb/$name
  apt-get install -qq --no-install-recommends dpkg-dev lintian
  apt-get build-dep -qq --no-install-recommends .
  dpkg-buildpackage -us -uc
  lintian --info --fail-on error ../berth_*.changes"
rm -r "${work:?}/$name"
mv "$work"/* build/deb
cp build/deb/* "$work"
scripts/bare.sh "$suite" 'apt-get install -qq --no-install-recommends ./build/deb/{berth,libberth}[_0]*.deb && debian/tests/bundled-scene'
scripts/bare.sh "$suite" 'apt-get install -qq --no-install-recommends autopkgtest dpkg-dev apt-utils
  autopkgtest build/deb/*.deb build/deb/*.dsc -- null'
ls -l build/deb
