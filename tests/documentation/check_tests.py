#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that each test that SECURITY.md names exists, and that each row of its table names one.   check_tests.py ROOT"""
import pathlib
import re
import sys

PAGE = "SECURITY.md"
HEADING = "| actor |"
LINK = re.compile(r"\[([^\]]+)\]\((tests/[^)#]+)\)")


def names_in(file):
    """The names of a file's tests: those of Catch2, or the sentences of a CMakeLists.txt."""
    text = re.sub(r'"\s*\n\s*"', "", file.read_text())  # a long name is several strings
    if file.name == "CMakeLists.txt":
        return set(re.findall(r'"([^"\n]+)"', text))
    return set(re.findall(r'TEST_CASE(?:_METHOD)?\((?:\s*\w+,)?\s*"([^"\n]+)"', text))


def faults(root):
    in_table = False
    for number, line in enumerate((root / PAGE).read_text().splitlines(), 1):
        in_table = line.startswith(HEADING) or (in_table and line.startswith("|"))
        links = LINK.findall(line)
        if in_table and not links and not line.startswith((HEADING, "|---")):
            yield f"{PAGE}:{number}: this row names no test"
        for name, path in links:
            file = root / path
            if not file.is_file():
                yield f"{PAGE}:{number}: there is no {path}"
            elif name not in names_in(file):
                yield f"{PAGE}:{number}: {path} has no test '{name}'"


def main(root):
    found = list(faults(pathlib.Path(root)))
    print("\n".join(found) or f"every test that {PAGE} names exists")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
