#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Line coverage of shm/ by its own tests: per file and in total.   tests/coverage.sh [--at-least PERCENT]
# Builds preset coverage and runs the tests of shm and fault, and fuzz_segment. Exits 1 below 95 percent, or what was asked.
# A process that is killed loses its counts: lines that only such processes run count as missed.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

least=95
while [ $# -gt 0 ]; do
    case $1 in
        --at-least) least=${2:?--at-least needs a number}; shift ;;
        *) echo "tests/coverage.sh: unknown argument $1; expected --at-least PERCENT" >&2; exit 2 ;;
    esac
    shift
done

cd "$root"
say "configuring and building preset coverage"
cmake --preset coverage >/dev/null
targets=$(ninja -C build/coverage -t targets all | sed -n 's/^\(test_shm_[^:/]*\|test_fault_[^:/]*\|fuzz_segment\): .*/\1/p')
# shellcheck disable=SC2086 # one target a word
cmake --build --preset coverage --target $targets | { grep -v '^ninja: no work' || true; } | tail -n 1
find build/coverage -name '*.gcda' -delete
say "running $(echo "$targets" | wc -w) test programs"
for target in $targets; do
    arguments=() # the mutation tests run the same lines over and over
    if [ "$target" = test_shm_model ]; then arguments=('~Each weakened order*'); fi
    "build/coverage/tests/$target" "${arguments[@]}" >build/coverage/coverage.log 2>&1 ||
        { tail -n 30 build/coverage/coverage.log >&2; echo "$target fails in preset coverage; mend that first" >&2; exit 1; }
done

say "counting"
python3 - "$root" "$least" <<'PYTHON'
"""Adds up what gcov says: a line of a header is covered if any program that includes it runs it."""
import collections, json, pathlib, subprocess, sys

root, least = pathlib.Path(sys.argv[1]), float(sys.argv[2])
lines = collections.defaultdict(lambda: collections.defaultdict(int))
for notes in (root / "build/coverage").rglob("*.gcno"):
    if not any(part in str(notes) for part in ("/shm/", "/tests/fault/", "/tests/fuzz/")):
        continue
    out = subprocess.run(["gcov", "--json-format", "--stdout", str(notes)], stdout=subprocess.PIPE, text=True, check=True,
                         cwd=root / "build/coverage").stdout
    for text in filter(None, out.splitlines()):
        unit = json.loads(text)
        for file in unit["files"]:
            path = pathlib.Path(unit["current_working_directory"], file["file"]).resolve()
            if root / "shm" not in path.parents:
                continue
            for line in file["lines"]:
                lines[str(path.relative_to(root))][line["line_number"]] += line["count"]
total = covered = 0
for name in sorted(lines):
    hit = sum(1 for count in lines[name].values() if count)
    missed = sorted(number for number, count in lines[name].items() if not count)
    total, covered = total + len(lines[name]), covered + hit
    print(f"{name:36} {hit:5} of {len(lines[name]):5} lines {100 * hit / len(lines[name]):6.1f} %",
          "  missed:" + " ".join(map(str, missed)) if missed else "")
missing = {str(file.relative_to(root)) for file in (root / "shm").rglob("*.cpp")} - lines.keys()
if missing:
    sys.exit("gcov has counted no line of " + ", ".join(sorted(missing)))
if total == 0:
    sys.exit("gcov has counted nothing; is gcov of the compiler's version installed?")
percent = 100 * covered / total
print(f"{'shm/':36} {covered:5} of {total:5} lines {percent:6.1f} %")
if percent < least:
    sys.exit(f"line coverage of shm/ is {percent:.1f} %, at least {least:g} % expected; add tests for the lines named above")
PYTHON
