#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs check_dependencies.py on a small tree that includes a library that is not listed, and lists one that is not included."""
import pathlib
import subprocess
import sys
import tempfile

CHECK = pathlib.Path(__file__).parent / "check_dependencies.py"

with tempfile.TemporaryDirectory() as folder:
    root = pathlib.Path(folder)
    (root / "apps").mkdir()
    (root / "shm").mkdir()
    (root / "apps/dependencies.txt").write_text("[build]\nbuild-essential  compiler\nlibfmt-dev  text\n")
    (root / "shm/a.cpp").write_text("#include <pugixml.hpp>\n#include <vector>\n")
    subprocess.run(["git", "init", "--quiet", folder], check=True)
    subprocess.run(["git", "-C", folder, "add", "."], check=True)
    result = subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True)
    expected = ["shm/a.cpp: includes <pugixml.hpp> of libpugixml-dev, which apps/dependencies.txt does not list",
                "apps/dependencies.txt: lists libfmt-dev, of which no file includes a header"]
    if result.returncode != 1 or result.stdout.splitlines() != expected:
        sys.exit(f"expected {expected}, got {result.returncode}: {result.stdout}{result.stderr}")
