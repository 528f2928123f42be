#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# npm_install.sh PACKAGE_JSON FOLDER: installs the packages of PACKAGE_JSON in FOLDER/node_modules, unless they are
# installed. On failure, prints the reason in one line and exits with 1. Without a registry this takes seconds, not
# npm's minutes.
set -euo pipefail
package_json=$(realpath "$1") folder=$2

command -v npm >/dev/null || { echo "there is no npm (Debian packages nodejs npm)"; exit 1; }
mkdir -p "$folder"
cd "$folder"
if cmp -s "$package_json" installed.json; then exit 0; fi
cp "$package_json" package.json
# No lock file, because it would contain the registry of its author. The versions are exact.
timeout 120 npm install --no-package-lock --no-audit --no-fund --ignore-scripts \
    --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-retry-maxtimeout=2000 --fetch-timeout=20000 >npm.log 2>&1 ||
    { echo "npm cannot install: $(grep -m 1 -i error npm.log || echo "it took more than 120 s")"; exit 1; }
cp package.json installed.json
