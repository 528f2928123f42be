#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sourced by apps/run-wheelchair.sh, apps/bench/run.sh and scripts in tests/. Installs missing Debian packages of
# dependencies.txt, and builds targets of a preset. Prints its steps.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '== %s\n' "$*"; }

# describe_distribution [OS_RELEASE]
# Prints one line if this is a distribution on which nobody runs the tests. OS_RELEASE: a file as os-release(5).
describe_distribution() ( # in a subshell: the file sets many variables
    ID='' VERSION_ID='' PRETTY_NAME='this system'
    . "${1:-/etc/os-release}"
    case $ID-$VERSION_ID in debian-12|debian-13) exit 0 ;; esac
    say "Tandem is not tested on $PRETTY_NAME; docs/platforms.md says what is known"
)

# install_missing_packages [GROUP]
# Installs the packages of a group in dependencies.txt (default: [build]). Exits with one line if a package is missing
# and neither root nor sudo can install it, and returns 1 if apt-get fails, even where a caller's `||` switches off `set -e`.
install_missing_packages() {
    local missing=() package group= listed=no
    command -v apt-get >/dev/null ||
        { echo "apps/setup.sh: no apt-get on this system; docs/platforms.md says what is known of systems other than Debian" >&2; exit 1; }
    while read -r package _; do
        case "$package" in ''|'#'*) continue ;; '['*) group=$package; continue ;; esac
        [ "$group" = "[${1:-build}]" ] || continue
        listed=yes
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done < "$root/apps/dependencies.txt"
    [ $listed = yes ] || { echo "apps/setup.sh: apps/dependencies.txt has no group [${1:-build}]" >&2; exit 1; }
    if [ ${#missing[@]} -eq 0 ]; then return; fi
    local sudo=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "cannot install ${missing[*]}: neither root nor sudo; install them, then run this again" >&2; exit 1; }
        sudo=(sudo)
    fi
    local start=$SECONDS
    describe_distribution
    say "installing ${#missing[@]} packages: ${missing[*]}"
    "${sudo[@]}" apt-get update -qq || return 1
    "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
        return 1
    say "installed them in $((SECONDS - start)) s"
}

# print_progress [SECONDS]
# Reads ninja's output. Prints lines that are not steps (warnings, errors), and the number of finished steps: at most every
# SECONDS (5), and also if no step has finished meanwhile, because one file may compile for a minute. On a terminal, prints
# each step at once.
print_progress() {
    local interval=${1:-5} line part= status start=$SECONDS printed=$SECONDS steps=
    while :; do
        # read keeps the beginning of a line in `line` when its time is over.
        if IFS= read -r -t "$interval" line; then status=0; else status=$?; fi
        part+=$line
        if [ $status -le 128 ]; then
            if [ $status -ne 0 ] && [ -z "$part" ]; then break; fi
            if [[ $part =~ ^\[([0-9]+)/([0-9]+)\]\  ]]; then
                steps="${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} steps"
                if [ -t 1 ]; then print_steps "$steps, $((SECONDS - start)) s"; fi
            elif [[ $part != 'ninja: no work'* && $part != 'ninja: Entering'* ]]; then
                printf '%s\n' "$part"
            fi
            part=
            if [ $status -ne 0 ]; then break; fi
        fi
        if [ $((SECONDS - printed)) -lt "$interval" ]; then continue; fi
        print_steps "${steps:-no step finished yet}, $((SECONDS - start)) s"
        printed=$SECONDS
    done
    if [ -z "$steps" ]; then return; fi
    print_steps "$steps, $((SECONDS - start)) s"
    if [ -t 1 ]; then printf '\n'; fi
}

print_steps() { if [ -t 1 ]; then printf '\r   %s ' "$1"; else printf '   %s\n' "$1"; fi; }

# build_preset PRESET [TARGET ...]
# Configures build/PRESET if it is new, with the options in the array `cmake_options`, and builds the targets (default: all).
# Without options, each file is compiled separately and tests are targets, even in a folder that run-wheelchair.sh configured.
cmake_options=()
build_preset() {
    local preset=$1
    shift
    cd "$root"
    export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root} # ccache then finds what another clone has compiled
    if [ ! -f "build/$preset/build.ninja" ]; then
        say "configuring preset $preset"
        cmake --preset "$preset" "${cmake_options[@]}" >/dev/null
    elif [ ${#cmake_options[@]} -eq 0 ] && grep -q '^CMAKE_UNITY_BUILD:.*=ON' "build/$preset/CMakeCache.txt"; then
        say "compiling each file by itself: run-wheelchair.sh compiled several at once"
        cmake --preset "$preset" -DCMAKE_UNITY_BUILD=OFF -DTANDEM_BUILD_TESTS=ON >/dev/null
    fi
    say "building preset $preset${*:+: $*}"
    NINJA_STATUS='[%f/%t] ' cmake --build --preset "$preset" ${1:+--target "$@"} | print_progress
}
