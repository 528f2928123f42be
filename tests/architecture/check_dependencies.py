#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks apps/dependencies.txt against what the tree includes: each header in <> belongs to a listed package or to one that such
a package depends on, and each listed library has a header that is included. Needs dpkg.
Usage: check_dependencies.py ROOT"""
import pathlib
import re
import shutil
import subprocess
import sys

FOLDERS = ["shm", "host", "proxy", "plugins", "apps", "tests"]
SEARCHED = ["/usr/include", "/usr/include/eigen3", *map(str, pathlib.Path("/usr/include").glob("*-linux-gnu"))]
# Headers of libraries that only an optional benchmark peer needs (apps/bench/peers/peers.txt).
PEERS = "apps/bench/peers/"
# Libraries of which no header is included in C++, and why they are listed.
WITHOUT_HEADER = {"libboost-filesystem-dev": "components that use Boost.DLL link it"}


def lines(*command):
    return subprocess.run(command, capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout.splitlines()


def listed_packages(root):
    packages, group = [], ""
    for line in (root / "apps/dependencies.txt").read_text().splitlines():
        if line.startswith("["):
            group = line
        elif line and line[0] != "#" and group != "[components]":  # what components of users may include
            packages.append(line.split()[0])
    return packages


def included_headers(root):
    """Header -> a file that includes it."""
    files = lines("git", "-C", str(root), "ls-files", *FOLDERS)
    found = {}
    for name in files:
        if not name.endswith((".cpp", ".hpp", ".h")) or name.startswith(PEERS):
            continue
        for header in re.findall(r'^\s*#\s*include\s*<([^>]+)>', (root / name).read_text(), re.M):
            found.setdefault(header, name)
    return found


def package_of_headers(headers):
    """Header -> the Debian package that it comes from. Headers of the tree and of the compiler's own folders have none."""
    paths = {}
    for header in headers:
        for folder in SEARCHED:
            path = pathlib.Path(folder) / header
            if path.is_file():
                paths[str(path.resolve())] = paths.get(str(path.resolve()), header)
                paths[str(path)] = header
                break
    packages = {}
    for line in lines("dpkg-query", "--search", *paths):
        owners, path = line.rsplit(": ", 1)
        if path in paths:
            packages[paths[path]] = owners.split(", ")[0].split(":")[0]
    return packages


def with_dependencies(package, known):
    """The package and all that it depends on, as far as it is installed."""
    todo, seen = [package], set()
    while todo:
        name = todo.pop()
        if name in seen:
            continue
        seen.add(name)
        if name not in known:
            fields = lines("dpkg-query", "--show", "--showformat=${Depends}, ${Pre-Depends}", name)
            known[name] = [re.split(r"[ :(]", each.strip())[0] for each in re.split(r"[,|]", " ".join(fields)) if each.strip()]
        todo += known[name]
    return seen


def main():
    if shutil.which("dpkg-query") is None:
        sys.exit("check_dependencies.py: no dpkg-query; this check needs a Debian system")
    root = pathlib.Path(sys.argv[1])
    listed = listed_packages(root)
    headers = included_headers(root)
    packages = package_of_headers(headers)
    known = {}
    covered = {package: with_dependencies(package, known) for package in listed}
    errors = []
    for header, package in sorted(packages.items()):
        if not any(package in covers for covers in covered.values()):
            errors.append(f"{headers[header]}: includes <{header}> of {package}, which apps/dependencies.txt does not list")
    used = set(packages.values())
    for package in listed:
        is_library = package == "catch2" or (package.startswith("lib") and package.endswith("-dev"))
        if is_library and package not in WITHOUT_HEADER and not used & direct(package, known):
            errors.append(f"apps/dependencies.txt: lists {package}, of which no file includes a header")
    print("\n".join(errors) or f"{len(packages)} headers of {len(used)} packages are covered")
    sys.exit(1 if errors else 0)


def direct(package, known):
    """The package and what it depends on directly: libboost-dev has no header of its own."""
    return {package, *known.get(package, [])}


main()
