#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install.sh FOLDER TARGET: installs the libraries of the monitor's page with npm in FOLDER, and copies the files that
# the page loads to TARGET. Without npm, the build continues, and the page reports that it has no graph and no plots.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1 target=$2

mkdir -p "$target"
reason=$("$here/../../../npm_install.sh" "$here/package.json" "$folder") ||
    { echo "tandem monitor: no graph and no plots on its page: $reason"; exit 0; }
cd "$folder/node_modules"
cp --update elkjs/lib/elk-api.js elkjs/lib/elk-worker.min.js elkjs/LICENSE.md "$target/"
cp --update uplot/dist/uPlot.esm.js uplot/dist/uPlot.min.css "$target/"
cp --update uplot/LICENSE "$target/uPlot-LICENSE"
