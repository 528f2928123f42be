#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Cross-compiles preset arm64 in a Debian 12 root folder that it makes, and runs tests of it under qemu.
#   tests/arm64.sh [ninja target ...]    (default: the tests of shared memory and of the wire format)
# Needs root, debootstrap and 3 GB in /var/tmp/tandem-arm64.
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

if [ ! -e "$target/ready" ]; then
    debootstrap --variant=minbase bookworm "$target" http://deb.debian.org/debian
    cat > "$target/prepare.sh" <<'PREPARE'
set -eu
export DEBIAN_FRONTEND=noninteractive
dpkg --add-architecture arm64
apt-get update -qq
packages="g++-aarch64-linux-gnu qemu-user-static libstdc++-12-dev:arm64"
for package in $(sed -n '/^\[build\]/,/^\[components\]/s/^\([a-z0-9][^ ]*\) .*/\1/p' dependencies.txt); do
    # Libraries are for arm64, programs for this machine. Packages of headers alone have no architecture.
    case $package in lib*-dev|catch2) if apt-cache show "$package:arm64" >/dev/null 2>&1; then package=$package:arm64; fi ;; esac
    packages="$packages $package"
done
apt-get install -y -qq --no-install-recommends $packages >/dev/null
PREPARE
    cp "$top/apps/dependencies.txt" "$target/"
    chroot "$target" sh /prepare.sh
    touch "$target/ready"
fi

[ $# -gt 0 ] || set -- test_shm_segment test_shm_ring test_shm_calls test_wire
mkdir -p "$target$top"
export top target
# The mounts end with this process.
exec unshare --mount bash -euc '
    mount --bind "$top" "$target$top"
    mount -t proc proc "$target/proc"
    mount --rbind /dev "$target/dev"
    exec chroot "$target" bash -euc "
        cd \"\$0\"
        cmake --preset arm64 >/dev/null
        cmake --build --preset arm64 --target \"\$@\"
        for test in \"\$@\"; do
            case \$test in test_*) qemu-aarch64-static build/arm64/tests/\$test ;; esac
        done" "$top" "$@"' bash "$@"
