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
reason=$("$here/../../../../../apps/npm_install.sh" "$here/package.json" "$folder") || skip "$reason"
mkdir -p "$pictures"
cd "$folder"
[ -f "$bin/../share/tandem/monitor/lib/uPlot.esm.js" ] || skip "Tandem was built without its libraries from npm, see the build's output"
cp "$here"/*.mjs .
TANDEM_BIN=$bin TANDEM_PICTURES=$pictures exec timeout 280 node --test-reporter=spec --test-concurrency=1 --test "$@"
