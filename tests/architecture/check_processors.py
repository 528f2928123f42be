#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that only named files depend on a processor, or on pages of 4096 bytes.   check_processors.py ROOT

A line breaks the second rule if it gives 4096 to a name with `page` in it, or to a function that maps memory.
"""
import pathlib
import re
import subprocess
import sys

SEARCHED = [".cpp", ".hpp", ".h", ".inc", ".cmake", ".txt", ".sh", ".py"]
BENCHMARKS = ["apps/bench/", "tests/apps/bench/"]
PROCESSOR = re.compile(r"\b_mm\w*_|rdtsc|x86_64|aarch64|\b__amd64|\b__(i386|arm|ARM|SSE|AVX)\w*__|"
                       r"__builtin_ia32_|\w*intrin\.h|arm_neon\.h|"
                       r'\b(__)?asm(__)?\s*(__)?(volatile)?(__)?\s*\(\s*"[^".]')  # an instruction, not a directive
PROCESSOR_FILES = [
    "shm/os/processor.hpp",
    "host/crash/stack_trace.cpp",  # the program counter of a crashed thread
    "cmake/toolchains/",
    "tests/arm64.sh",
    "tests/cross_compile.sh",
    "tests/shm/model/litmus/",  # arm64's memory model
    "apps/dependencies.txt",
    "tests/architecture/check_processors",
    "apps/tandem/build/packages/header_packages.txt",  # names of files in Debian's packages
    "apps/tandem/build/packages/write_table.py",
] + BENCHMARKS
BYTES = r"\b(4'?096|0x1000|4 \* 1024|1 << 12)[uUlL]*\b"
PAGE = re.compile(rf"[Pp]age\w*(\s*=\s*|\{{){BYTES}|\b(mmap|munmap|mprotect|madvise|msync|mincore)\(.*{BYTES}")
PAGE_FILES = [
    "shm/segment/layout.hpp",  # the unit of a segment's arenas, whatever pages the kernel has
    "tests/architecture/check_processors",
] + BENCHMARKS


def findings(root, names):
    for name in names:
        if pathlib.Path(name).suffix not in SEARCHED:
            continue
        rules = [(word, rule) for word, rule, files in (
            (PROCESSOR, "names a processor; move it to shm/os/processor.hpp", PROCESSOR_FILES),
            (PAGE, "takes a page for 4096 bytes; ask sysconf(_SC_PAGESIZE)", PAGE_FILES)) if not name.startswith(tuple(files))]
        for number, line in enumerate((root / name).read_text(errors="replace").splitlines(), 1):
            for word, rule in rules:
                if word.search(line):
                    yield f"{name}:{number}: {rule}"


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    listed = subprocess.run(["git", "-C", str(root), "ls-files"], capture_output=True, text=True, check=True).stdout
    found = list(findings(root, listed.splitlines()))
    print("\n".join(found))
    sys.exit(1 if found else 0)
