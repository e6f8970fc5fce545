#!/usr/bin/env bash
# compare_answers.sh BERTH OTHER_BERTH [DATA]: whether two builds of berth answer every scene with the same bytes: the bundled
# ones, and those of DATA/recordings, where there are some.
set -euo pipefail
one=$(realpath "$1")
other=$(realpath "$2")
shopt -s nullglob
source=$(realpath "$(dirname "$0")/..")
scenes=("$source"/data/bundled/scene.yaml "$source"/data/bundled/one_camera.yaml)
[ $# -lt 3 ] || scenes+=("$3"/recordings/*/scene.yaml)
answers=$(mktemp -d)
trap 'rm -rf "$answers"' EXIT

# What a program says of a scene: its results, or why it refuses it. Warnings and refusals may name the program.
ask() {
  local status=0
  "$1" run "$2" --format json >"$3" 2>"$3.said" || status=$?
  sed -i "s|$1|berth|g" "$3.said"
  printf 'exit status %s\n' "$status" >>"$3.said"
}

for scene in "${scenes[@]}"; do
  ask "$one" "$scene" "$answers/one"
  ask "$other" "$scene" "$answers/other"
  if ! cmp "$answers/one" "$answers/other" || ! cmp "$answers/one.said" "$answers/other.said"; then
    echo "$scene: $1 and $2 answer differently; the first lines that differ:" >&2
    diff "$answers/one" "$answers/other" | head -4 | cut -c1-2000 >&2 || true
    diff "$answers/one.said" "$answers/other.said" | head -4 >&2 || true
    exit 1
  fi
  echo "$scene: the same $(wc -l <"$answers/one") results, $(wc -c <"$answers/one") bytes; $(tail -n 1 "$answers/one.said")"
done
echo "${#scenes[@]} scenes, the same answers from $1 and $2"
