#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, the peers of apps/bench/peers/peers.txt too if it can, builds, measures, writes the report.
#   apps/bench/run.sh [--out FOLDER] [options of build/release/bin/tandem-bench]
# FOLDER (build/bench) gets report.json and pictures (SVG). With --acceptance the exit code is 1 if a limit is
# not met, a case of Tandem has failed, or no limit could be checked.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../setup.sh"

out=$root/build/bench
arguments=()
while [ $# -gt 0 ]; do
    case $1 in
        --out) out=$(realpath -m "${2:?--out needs a folder}"); shift ;;
        *) arguments+=("$1") ;;
    esac
    shift
done
called_from=$PWD

# Peers are optional: each is installed on its own, and one that cannot be installed is named and left out.
install_peers() {
    local sudo=() package updated=no
    if [ "$(id -u)" -ne 0 ]; then sudo=(sudo -n); fi
    while read -r package _; do
        case "$package" in ''|'#'*) continue ;; esac
        if dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then continue; fi
        if [ $updated = no ]; then "${sudo[@]}" apt-get update -qq || true; updated=yes; fi
        if "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y -qq --no-install-recommends "$package" >/dev/null 2>&1; then
            say "installed the peer $package"
        else
            say "without the peer $package: it could not be installed"
        fi
    done < "$root/apps/bench/peers/peers.txt"
}

install_missing_packages
install_peers
cd "$root"
cmake --preset release >/dev/null # looks for the peers again
build_preset release tandem-bench

mkdir -p "$out"
cd "$called_from"
say "measuring; report.json and pictures go to $out"
result=0
"$root/build/release/bin/tandem-bench" --json "$out/report.json" "${arguments[@]}" || result=$?
if [ -f "$out/report.json" ]; then "$root/apps/bench/report.py" plot "$out/report.json" "$out"; fi
exit $result
