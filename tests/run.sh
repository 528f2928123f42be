#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds, runs all tests.   tests/run.sh [--build-only] [--preset NAME] [ctest options]
# TANDEM_STRESS=N multiplies the sizes of the stress tests (default 1, short).
# Tests run side by side, two per processor, because they wait more than they compute; those that measure time run alone. Some
# tests limit waits for threads that other tests can delay on a busy machine: tests that fail run once more, one by one, and are
# named.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

preset=release
build_only=no
while [ $# -gt 0 ]; do
    case $1 in
        --build-only) build_only=yes ;;
        --preset) preset=${2:?--preset needs a name}; shift ;;
        *) break ;;
    esac
    shift
done

install_missing_packages
install_missing_packages packages
(install_missing_packages machines) || say "no iproute2 or openssl: tests of two machines are skipped"
command -v npm >/dev/null || install_missing_packages npm
command -v chromium >/dev/null || (install_missing_packages browser) || say "no Chromium: the tests in a browser are skipped"
cd "$root"
build_preset "$preset"
if [ $build_only = yes ]; then exit 0; fi
say "running the tests of preset $preset"
failed=build/$preset/Testing/Temporary/LastTestsFailed.log
rm -f "$failed"
if ctest --preset "$preset" --parallel "$((2 * $(nproc)))" "$@"; then exit 0; fi
if [ ! -s "$failed" ]; then exit 1; fi
say "these have failed beside others and run again, one by one:"
cat "$failed"
ctest --preset "$preset" --rerun-failed
