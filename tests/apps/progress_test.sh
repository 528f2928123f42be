#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# print_progress of apps/setup.sh.   progress_test.sh ROOT
set -euo pipefail
. "$1/apps/setup.sh"

fail() { echo "progress_test.sh: $1" >&2; exit 1; }

# expect TEXT: reads lines of the progress until one contains TEXT; at most 60 s between two lines.
expect() {
    local line
    while IFS= read -r -t 60 line <&"${progress[0]}"; do
        case $line in *"$1"*) return ;; esac
    done
    fail "no line contains '$1'"
}

coproc progress { print_progress 1; }
progress_pid=$!
expect 'no step finished yet, '
printf '[1/3] Building a.cpp.o\n' >&"${progress[1]}"
expect '1 of 3 steps, '
expect '1 of 3 steps, ' # while the next file compiles
printf '[2/3] Buil' >&"${progress[1]}"
expect '1 of 3 steps, ' # a part of a line is no step
printf 'ding b.cpp.o\nb.cpp:1: warning: unused\n[3/3] Linking\n' >&"${progress[1]}"
expect 'b.cpp:1: warning: unused'
exec {end}>&"${progress[1]}"
exec {end}>&- {progress[1]}>&-
expect '3 of 3 steps, '
wait "$progress_pid"

[ -z "$(printf 'ninja: no work to do.\n' | print_progress)" ] || fail "a build without a step is not silent"
[ "$(printf 'ninja: error: no newline' | print_progress)" = 'ninja: error: no newline' ] || fail "the last line is lost"
