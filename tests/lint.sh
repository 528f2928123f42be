#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks what no compiler checks: clang-format on every C++ file, the includes between rooms, the ABI numbers, and
# clang-tidy on the files that changed.   tests/lint.sh [--all | --since COMMIT]
# clang-tidy checks the product files (not the tests) that changed since COMMIT (default: in the newest commit and since it), and
# one source for each changed .hpp. With --all it checks every source, which takes half an hour.
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

# source_of_header HEADER: prints a source that includes it: the one of the same name, otherwise one that includes it directly or
# by another header. Prints nothing if there is none outside the tests.
source_of_header() {
    local users
    if [ -f "${1%.hpp}.cpp" ]; then echo "${1%.hpp}.cpp"; return; fi
    users=$(git grep -lF "#include \"$1\"" -- '*.cpp' ':!tests' || git grep -lF "#include \"$1\"" -- '*.hpp' ':!tests' || true)
    users=${users%%$'\n'*}
    case $users in *.hpp) source_of_header "$users" ;; ?*) echo "$users" ;; esac
}
product=('*.cpp' '*.hpp' ':!tests')
if [ $all = yes ]; then
    changed=$(git ls-files '*.cpp' ':!tests')
else
    git rev-parse -q --verify "$since^{commit}" >/dev/null ||
        { echo "tests/lint.sh: there is no commit $since to compare with (a shallow clone?); give --since COMMIT or --all" >&2; exit 2; }
    changed=$(git diff --name-only --diff-filter=d "$since" -- "${product[@]}")
fi
files=()
for file in $changed; do
    source=$file
    case $file in *.hpp) source=$(source_of_header "$file") ;; esac
    if [ -n "$source" ]; then files+=("$source"); else say "clang-tidy does not see $file, which no source of the product includes"; fi
done

# clang-tidy reads files of one library together, since their headers take most of its time.
build=build/lint
if [ ! -f $build/build.ninja ]; then cmake --preset dev -B $build -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=32 >/dev/null; fi
cmake --build $build --target rtm_idl_headers bench_idl_headers rtm_public_api opros_public_api >/dev/null # generated headers
mapfile -t compiled < <(sed -n 's/^ *"file": "\(.*\)".*/\1/p' $build/compile_commands.json | grep -vF "$root/$build/tests/")
declare -A unit_of=() # by the source; a unit is what is compiled: a source, or a file of CMake's that includes several
for unit in "${compiled[@]}"; do
    unit_of[$unit]=$unit
    while read -r source; do unit_of[$source]=$unit; done < <(sed -n 's/^#include "\(.*\.cpp\)"$/\1/p' "$unit")
done
declare -A units=()
for file in "${files[@]}"; do
    unit=${unit_of[$root/$file]:-}
    if [ -n "$unit" ]; then units[$unit]=1; else say "clang-tidy does not see $file, which is no part of this build"; fi
done
say "clang-tidy: ${#files[@]} changed files, in ${#units[@]} units"
if [ ${#units[@]} -gt 0 ]; then
    printf '%s\0' "${!units[@]}" |
        xargs -0 -n 1 -P "$(nproc)" clang-tidy -p $build --quiet --checks=-bugprone-suspicious-include --warnings-as-errors='*' \
            --extra-arg=-Qunused-arguments --extra-arg=-Wno-ignored-optimization-argument # of g++ alone
fi
