#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs missing packages, builds only the targets that the run needs, and drives the wheelchair. The joystick is an
# RT-Component; control and hardware are OPRoS components in a second process. Prints the latency table and draws the
# run.
#   apps/run-wheelchair.sh [--build-only] [--out FOLDER] [options of build/release/bin/wheelchair]
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

build_only=no
out=
arguments=()
while [ $# -gt 0 ]; do
    case $1 in
        --build-only) build_only=yes ;;
        --out) out=$(realpath -m "${2:?--out needs a folder}"); shift ;;
        *) arguments+=("$1") ;;
    esac
    shift
done
out=${out:-$root/build/wheelchair}
called_from=$PWD

install_missing_packages
# Only for a new build folder. Compiling several files at once reduces the time to a third. Files of a test share local names and
# cannot be compiled together.
cmake_options=(-DTANDEM_BUILD_TESTS=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=32)
# Without options, the run is mixed and needs fewer components.
if [ ${#arguments[@]} -eq 0 ]; then build_preset release wheelchair_demo; else build_preset release wheelchair_all; fi
if [ $build_only = yes ]; then exit 0; fi

mkdir -p "$out"
cd "$called_from"
say "driving; log, figure and figures as JSON go to $out"
exec "$root/build/release/bin/wheelchair" --csv "$out/run.csv" --plot "$out/run.svg" --json "$out/run.json" "${arguments[@]}"
