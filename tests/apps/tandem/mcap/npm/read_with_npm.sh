#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# read_with_npm.sh WRITE_SAMPLE FOLDER: installs the format's reference library for JavaScript in FOLDER, and compares what
# it finds in files of ours with what was written. Exit code 77, and the reason, if npm cannot install.
set -euo pipefail
write_sample=$1
folder=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

skip() { echo "skipped: $*"; exit 77; }

reason=$("$here/../../../../../apps/npm_install.sh" "$here/package.json" "$folder") || skip "$reason"
cd "$folder"
cp "$here/read_sample.mjs" .

files=0
for compression in none lz4 zstd; do
    for chunk_size in 0 1000 1048576; do
        "$write_sample" sample.mcap $compression $chunk_size >expected.txt
        for how in indexed stream; do
            # Messages without chunks are in no index.
            if [ $how = indexed ] && [ $chunk_size = 0 ]; then continue; fi
            node read_sample.mjs sample.mcap $how >found.txt
            diff expected.txt found.txt || { echo "$compression, chunks of $chunk_size, $how: differ"; exit 1; }
            files=$((files + 1))
        done
    done
done
echo "$files readings by @mcap/core $(node -p 'require("./package.json").dependencies["@mcap/core"]') find what was written"
