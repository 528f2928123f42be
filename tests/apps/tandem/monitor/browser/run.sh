#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh BIN FOLDER PICTURES TEST...: runs tests of this folder with the programs in BIN; npm installs in FOLDER. Exit code
# 77, and the reason, if there is no npm, or no browser for a test that needs one.
set -euo pipefail
bin=$1 folder=$2 pictures=$3
shift 3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

skip() { echo "skipped: $*"; exit 77; }

[[ "$*" = foxglove*_test.mjs ]] || command -v chromium >/dev/null || skip "there is no Chromium (Debian package chromium)"
command -v npm >/dev/null || skip "there is no npm (Debian packages nodejs npm)"
mkdir -p "$folder" "$pictures"
cd "$folder"
# No lock file: it would name the registry of whoever made it. The versions are exact.
if ! cmp -s "$here/package.json" installed.json; then
    cp "$here/package.json" package.json
    timeout 120 npm install --no-package-lock --no-audit --no-fund --ignore-scripts >npm.log 2>&1 ||
        skip "npm cannot install: $(grep -m 1 -i error npm.log || echo "it took more than 120 s")"
    cp package.json installed.json
fi
[ -f "$bin/../share/tandem/monitor/lib/elk-worker.min.js" ] || skip "Tandem was built without elkjs, see the build's output"
cp "$here"/*.mjs .
TANDEM_BIN=$bin TANDEM_PICTURES=$pictures exec timeout 280 node --test-reporter=spec --test-concurrency=1 --test "$@"
