#!/usr/bin/env bash
# Writes build/ros_release, the two repositories that bloom releases from. bloom looks for no package below another one, and takes each
# package's folder alone: so berth is one repository, and the packages of ros2/ are another, in which no link leads out of its package.
set -euo pipefail
cd "$(dirname "$0")/.."
out=build/ros_release
rm -rf "$out"
mkdir -p "$out/berth" "$out/berth_ros_packages"
git ls-files ':!ros2' ':!debian' | tar -cf - -T - | tar -xf - -C "$out/berth"
git ls-files ros2 | tar -chf - --transform 's,^ros2/,,' -T - | tar -xf - -C "$out/berth_ros_packages"
cp LICENSE "$out/berth_ros_packages"
broken=$(find "$out" -type l)
if [ -n "$broken" ]; then echo "ros_release: these links lead out of their packages: $broken" >&2; exit 1; fi
echo "berth: $out/berth; berth_msgs and berth_ros: $out/berth_ros_packages"
