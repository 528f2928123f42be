#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks what no compiler checks: clang-format on every file of ours, the arrows between rooms, the ABI numbers, and
# clang-tidy on the files that changed.   tests/lint.sh [--all | --since COMMIT]
# clang-tidy looks at the product files (not the tests) changed since COMMIT (default: the commit before this one, and
# what is not committed); --all at every one, which takes an hour or more.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

since=HEAD~1
all=no
while [ $# -gt 0 ]; do
    case $1 in
        --all) all=yes ;;
        --since) since=${2:?--since needs a commit}; shift ;;
        *) echo "tests/lint.sh: unknown argument $1; expected --all or --since COMMIT" >&2; exit 2 ;;
    esac
    shift
done

install_missing_packages lint
cd "$root"

say "clang-format"
git ls-files '*.cpp' '*.hpp' '*.h' | xargs clang-format --dry-run --Werror

say "includes and ABI numbers"
python3 tests/architecture/check_includes.py .
python3 tests/architecture/abi_number.py .

product=('shm/*.cpp' 'host/*.cpp' 'proxy/*.cpp' 'plugins/*.cpp' 'apps/*.cpp')
files=()
if [ $all = yes ]; then
    mapfile -t files < <(git ls-files "${product[@]}")
elif git rev-parse -q --verify "$since^{commit}" >/dev/null; then
    mapfile -t files < <(git diff --name-only --diff-filter=d "$since" -- "${product[@]}")
fi

# The preset dev compiles each file by itself, so that its compile commands are those of single files. The headers that
# omniidl writes must exist.
if [ ! -f build/dev/build.ninja ]; then cmake --preset dev >/dev/null; fi
known=()
for file in "${files[@]}"; do
    if grep -qF "\"$root/$file\"" build/dev/compile_commands.json; then known+=("$file"); fi
done
say "clang-tidy: ${#known[@]} of ${#files[@]} changed files are part of the build"
if [ ${#known[@]} -gt 0 ]; then
    build_preset dev rtm_idl_headers bench_idl_headers
    printf '%s\0' "${known[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/dev --quiet --warnings-as-errors='*'
fi
