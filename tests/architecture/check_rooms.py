#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that each folder of sources has a README.md and at most 25 of them.   check_rooms.py TREE

The public headers of the two component models are left out: upstream decides which folders and files there are.
"""
import collections
import pathlib
import sys

LARGEST = 25
SOURCES = {".cpp", ".hpp", ".h", ".js", ".mjs", ".py"}
TOP = ("shm", "host", "proxy", "plugins", "apps", "tests", "cmake")


def is_dictated(folder):
    return "include" in folder.parts


def findings(tree):
    count = collections.Counter()
    for top in TOP:
        for file in (tree / top).rglob("*"):
            if file.suffix in SOURCES and file.is_file():
                count[file.parent.relative_to(tree)] += 1
    for folder, files in sorted(count.items()):
        if is_dictated(folder):
            continue
        if files > LARGEST:
            yield f"{folder} holds {files} source files, at most {LARGEST} are expected; make rooms of it"
        if not (tree / folder / "README.md").is_file():
            yield f"{folder} has no README.md; say in it what is there and where to start"


if __name__ == "__main__":
    found = list(findings(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
