#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sourced by apps/run-wheelchair.sh and tests/run.sh: installs the Debian packages of dependencies.txt that are
# missing, and builds a preset. Says what it does; does nothing when nothing is to be done.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '== %s\n' "$*"; }

install_missing_packages() {
    local missing=() package
    while read -r package _; do
        case "$package" in ''|'#'*) continue ;; esac
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done < "$root/apps/dependencies.txt"
    if [ ${#missing[@]} -eq 0 ]; then return; fi
    local sudo=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "cannot install ${missing[*]}: neither root nor sudo; install them, then run this again" >&2; exit 1; }
        sudo=(sudo)
    fi
    say "installing ${missing[*]}"
    "${sudo[@]}" apt-get update -qq
    "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

build_preset() {
    local preset=$1
    cd "$root"
    if [ ! -f "build/$preset/build.ninja" ]; then
        say "configuring preset $preset"
        cmake --preset "$preset" >/dev/null
    fi
    say "building preset $preset"
    cmake --build --preset "$preset" | { grep -v '^ninja: no work' || true; } | tail -n 3
}
