#!/usr/bin/env bash
# Runs a command in a bare Debian (debootstrap's minbase) of which nothing is left afterwards, as root. It sees this folder as /berth.
# bare.sh SUITE COMMAND. Kept for the next run are the suite, the packages that were installed, ccache's folder and /berth/build, all in
# build/bare. BERTH_DATA is seen as well.
set -euo pipefail
if [ "$(id -u)" -ne 0 ]; then exec sudo --preserve-env=BERTH_DATA "$0" "$@"; fi
cd "$(dirname "$0")/.."
export suite=$1 command=$2 tree=$PWD kept=$PWD/build/bare/$1
mkdir -p "$kept"/{packages,ccache,build}
# Another run of this suite is waited for: apt wants the packages for itself.
exec 9>"$kept/lock"
flock 9
if [ ! -d "$kept/system" ]; then
  scripts/setup.sh packages-bare.txt
  rm -rf "$kept/system.part"
  debootstrap --variant=minbase "$suite" "$kept/system.part" http://deb.debian.org/debian
  mv "$kept/system.part" "$kept/system"
fi
export root
root=$(mktemp -d "$kept/run.XXXXXX")
# What was bound into it is gone by then, with the last process of the command.
trap 'rm -rf --one-file-system "$root"' EXIT
cp -a "$kept/system/." "$root"
unshare --mount --pid --fork --kill-child bash -euc '
  bind() { mkdir -p "$root$2"; mount --bind "$1" "$root$2"; }
  bind "$tree" /berth
  bind "$kept/build" /berth/build
  bind "$kept/packages" /var/cache/apt/archives
  bind "$kept/ccache" /root/.cache/ccache
  if [ -n "${BERTH_DATA:-}" ]; then bind "$BERTH_DATA" /berth_data; mount -o remount,ro,bind "$root/berth_data"; fi
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    ${BERTH_DATA:+BERTH_DATA=/berth_data} bash -euc "cd /berth; apt-get update -qq; $command"'
