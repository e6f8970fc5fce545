#!/usr/bin/env bash
# Builds berth and ros2/ by colcon into build/ros2 and runs their tests there. With BERTH_INSTALLED=1 the berth that CMake finds in
# CMAKE_PREFIX_PATH is used. Needs a sourced ROS 2; exits with 77 without one where the first argument is --skip, else with 1.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ -z "${ROS_DISTRO:-}" ] || ! command -v colcon > /dev/null; then
  echo "test_ros2: no ROS 2 is sourced, or there is no colcon; the tests of ros2/ were not run" >&2
  [ "${1:-}" = --skip ] && exit 77
  exit 1
fi
mkdir -p build/ros2
touch build/ros2/COLCON_IGNORE
paths=(--build-base build/ros2/build --install-base build/ros2/install --base-paths ros2)
[ -n "${BERTH_INSTALLED:-}" ] || paths+=(.)
colcon --log-base build/ros2/log build "${paths[@]}" --packages-up-to berth_ros \
  --event-handlers console_direct+ --cmake-args -DCMAKE_BUILD_TYPE=Release
set +u  # colcon's own scripts read variables that nobody set
. build/ros2/install/setup.bash
set -u
colcon --log-base build/ros2/log test "${paths[@]}" --packages-select berth_msgs berth_ros --event-handlers console_direct+
colcon --log-base build/ros2/log test-result --test-result-base build/ros2/build --verbose
