#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that each test that a page names exists, and that each row of the page's table names one.   check_tests.py ROOT"""
import pathlib
import re
import sys

PAGES = {"SECURITY.md": "| actor |", "docs/monitoring.md": "| case |"}  # with the heading of the table
LINK = re.compile(r"\[([^\]]+)\]\(((?:\.\./)*tests/[^)#]+)\)")


def names_in(file):
    """The names of a file's tests: those of Catch2, or the sentences of a CMakeLists.txt."""
    text = re.sub(r'"\s*\n\s*"', "", file.read_text())  # a long name is several strings
    if file.name == "CMakeLists.txt":
        return set(re.findall(r'"([^"\n]+)"', text))
    return set(re.findall(r'TEST_CASE(?:_METHOD)?\((?:\s*\w+,)?\s*"([^"\n]+)"', text))


def faults(root, page, heading):
    in_table = has_table = False
    for number, line in enumerate((root / page).read_text().splitlines(), 1):
        in_table = line.startswith(heading) or (in_table and line.startswith("|"))
        has_table = has_table or in_table
        links = LINK.findall(line)
        if in_table and not links and not line.startswith((heading, "|---")):
            yield f"{page}:{number}: this row names no test"
        for name, path in links:
            file = (root / page).parent / path
            if not file.is_file():
                yield f"{page}:{number}: there is no {path}"
            elif name not in names_in(file):
                yield f"{page}:{number}: {path} has no test '{name}'"
    if not has_table:
        yield f"{page}: there is no table '{heading}'"


def main(root):
    found = [fault for page, heading in PAGES.items() for fault in faults(pathlib.Path(root), page, heading)]
    print("\n".join(found) or f"every test that {' and '.join(PAGES)} name exists")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
