#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Cross-compiles preset arm64 in a Debian 12 root folder that it makes, and runs tests of it under qemu.
#   tests/arm64.sh [ninja target ...]    (default: the tests of shared memory, the wire format, links and crashes, and the wheelchair)
# Without targets, the wheelchair must write the same bytes in lock-step as on x86-64; log and figure are in build/arm64/wheelchair.
# Times under qemu say nothing about a board. Needs root, debootstrap and 3 GB in /var/tmp/tandem-arm64.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
target=/var/tmp/tandem-arm64
[ "$(id -u)" -eq 0 ] || { echo "tests/arm64.sh: must make a root folder; run it as root or with sudo" >&2; exit 1; }
# Other users may write to /var/tmp: what is run as root must come from a folder that root has made.
mkdir -p -m 755 "$target"
if [ -L "$target" ] || [ ! -O "$target" ]; then
    echo "tests/arm64.sh: $target belongs to another user; remove it" >&2
    exit 1
fi
command -v debootstrap >/dev/null || { echo "tests/arm64.sh: debootstrap not found; apt install debootstrap" >&2; exit 1; }

# `ready` has the dependencies that are installed.
if ! cmp -s "$top/apps/dependencies.txt" "$target/ready"; then
    [ -e "$target/ready" ] || debootstrap --variant=minbase bookworm "$target" http://deb.debian.org/debian
    cat > "$target/prepare.sh" <<'PREPARE'
set -eu
export DEBIAN_FRONTEND=noninteractive
dpkg --add-architecture arm64
apt-get update -qq
packages="g++-aarch64-linux-gnu qemu-user-static libstdc++-12-dev:arm64"
for package in $(awk '/^\[/ { group = $1 } group ~ /^\[(build|npm|packages)\]$/ && /^[a-z]/ { print $1 }' dependencies.txt); do
    # Libraries are for arm64, programs for this machine. Packages of headers alone have no architecture.
    case $package in lib*-dev|catch2) if apt-cache show "$package:arm64" >/dev/null 2>&1; then package=$package:arm64; fi ;; esac
    packages="$packages $package"
done
apt-get install -y -qq --no-install-recommends $packages >/dev/null
PREPARE
    cp "$top/apps/dependencies.txt" "$target/"
    chroot "$target" sh /prepare.sh
    cp "$top/apps/dependencies.txt" "$target/ready"
fi

cat > "$target/build_and_test.sh" <<'BUILD'
# build_and_test.sh TREE [ninja target ...]
set -euo pipefail
cd "$1"
shift
# Tests start programs for arm64. The kernel hands them to qemu, unless this machine has another setting, until this script ends.
setting=/proc/sys/fs/binfmt_misc
mount -t binfmt_misc none $setting
if [ ! -e $setting/qemu-aarch64 ]; then
    trap 'echo -1 > $setting/tandem-arm64' EXIT
    if [ ! -e $setting/tandem-arm64 ]; then # else a run that was killed has left it
        echo ':tandem-arm64:M::\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00:\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff:/usr/bin/qemu-aarch64-static:OCPF' \
            > $setting/register
    fi
fi
cmake --preset arm64 >/dev/null
programs=("$@")
if [ $# -eq 0 ]; then
    # Not test_shm_data_path, which forbids system calls: qemu needs its own.
    programs=(test_shm_segment test_shm_ring test_shm_calls test_shm_pages_16k test_shm_pages_64k test_wire test_link
        test_crash test_wheelchair_core)
    set -- "${programs[@]}" test_wheelchair_hosts wheelchair_all
fi
cmake --build --preset arm64 --target "$@"
for program in "${programs[@]}"; do
    case $program in test_*) echo "== $program"; "build/arm64/tests/$program" ;; esac
done
if [ ${#programs[@]} -lt $# ]; then
    echo "== test_wheelchair_hosts: lock-step"
    build/arm64/tests/test_wheelchair_hosts -w NoTests '*lock-step is the in-memory run*'
    mkdir -p build/arm64/wheelchair
    build/arm64/bin/wheelchair --lockstep --host-wait 60 --csv build/arm64/wheelchair/run.csv --plot build/arm64/wheelchair/run.svg \
        --json build/arm64/wheelchair/run.json
fi
BUILD
mkdir -p "$target$top"
export top target
# The mounts and all processes end with this one.
exec unshare --mount --pid --fork --kill-child bash -euc '
    mount --rbind "$top" "$target$top"
    mount -t proc proc "$target/proc"
    mount --rbind /dev "$target/dev"
    mount -t tmpfs tmpfs "$target/dev/shm"
    exec chroot "$target" bash /build_and_test.sh "$top" "$@"' bash "$@"
