#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles for arm64 what needs no libraries for arm64: shared memory, processes, ticks, crash reports and texts of hosts, and
# the wire format. Takes half a minute.   tests/cross_compile.sh
# tests/arm64.sh compiles with libraries, and runs tests.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install_missing_packages arm64
cd "$root"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/include"
# The headers of these libraries are the same for each processor. Those of libc in /usr/include are not.
for library in boost fmt libiberty; do ln -s "/usr/include/$library" "$scratch/include/"; done
for room in shm host/crash host/process host/rt host/text proxy/wire; do
    say "compiling $room for arm64"
    git ls-files "$room/*.cpp" | sed 's/.*/#include "&"/' > "$scratch/room.cpp"
    [ -s "$scratch/room.cpp" ] || { echo "tests/cross_compile.sh: $room has no source; name the rooms as they are" >&2; exit 1; }
    aarch64-linux-gnu-g++ -std=c++20 -O1 -Wall -Wextra -Werror -I . -isystem "$scratch/include" -c -o "$scratch/room.o" \
        "$scratch/room.cpp"
done
