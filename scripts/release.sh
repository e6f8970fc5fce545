#!/bin/sh
# Makes what a release has of the last commit: source, packages, wheel, site, schemas and their sums in build/release_files. First it
# checks that nothing is left to commit, that all files tell one version, and that CHANGELOG.md has its day.
# `make deb` leaves its packages in build/deb, `make wheel` its wheel in build/wheel; who has no such target is told so.
set -eu
cd "$(dirname "$0")/.."
fail() { echo "release: $1" >&2; exit 1; }
check() { /usr/bin/python3 -B "$@" || fail "$1 refuses it"; }

[ -z "$(git status --porcelain)" ] || fail "there are changes that are not committed; expected none (git status)"
scripts/setup.sh packages-docs.txt
check tests/source/versions.py --release

version=$(sed -n 's/^project(berth VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
out=build/release_files
rm -rf "$out" && mkdir -p "$out"
git archive --prefix="berth-$version/" HEAD | gzip -9n >"$out/berth-$version.tar.gz"
for target in deb wheel; do
  if make -n "$target" >/dev/null 2>&1; then
    rm -rf "build/$target"
    make "$target"
    find "build/$target" -maxdepth 1 -type f -exec cp {} "$out" \;
  else
    echo "release: without make $target, which there is not" >&2
  fi
done
make site
tar -C build --transform "s,^site,berth-$version-site," --sort=name --mtime="@$(git log -1 --format=%ct)" --owner=0 --group=0 -c site |
  gzip -9n >"$out/berth-$version-site.tar.gz"
for schema in data/schema/*.json; do
  cp "$schema" "$out/berth-$version-$(basename "$schema" .json).schema.json"
done
(cd "$out" && sha256sum -- * >SHA256SUMS)
ls -l "$out"
