#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install.sh FOLDER TARGET: installs the libraries of the monitor's page with npm in FOLDER, and copies the files that
# the page loads to TARGET. Without npm, the build continues, and the page reports that it has no graph.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1 target=$2

mkdir -p "$target"
reason=$("$here/../../../npm_install.sh" "$here/package.json" "$folder") ||
    { echo "tandem monitor: no graph on its page: $reason"; exit 0; }
cd "$folder/node_modules/elkjs"
cp --update lib/elk-api.js lib/elk-worker.min.js LICENSE.md "$target/"
