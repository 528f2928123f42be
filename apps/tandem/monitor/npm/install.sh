#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install.sh FOLDER TARGET: installs the libraries of the monitor's page with npm in FOLDER, and puts the files that the
# page loads into TARGET. Without npm the build goes on: the page says that there is no graph then.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1 target=$2

missing() { echo "tandem monitor: no graph on its page: $1"; exit 0; }

mkdir -p "$folder" "$target"
if cmp -s "$here/package.json" "$folder/package.json" && [ -f "$target/elk-worker.min.js" ]; then exit 0; fi
command -v npm >/dev/null || missing "there is no npm (Debian packages nodejs npm)"
cd "$folder"
mkdir -p new
cp "$here/package.json" new/
(cd new && timeout 120 npm install --no-package-lock --no-audit --no-fund --ignore-scripts >../npm.log 2>&1) ||
    missing "npm cannot install elkjs: $(grep -m 1 -i error npm.log || echo "it took more than 120 s")"
cp new/node_modules/elkjs/lib/elk-api.js new/node_modules/elkjs/lib/elk-worker.min.js new/node_modules/elkjs/LICENSE.md "$target/"
cp "$here/package.json" package.json
