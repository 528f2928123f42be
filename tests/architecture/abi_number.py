#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the ABI numbers of both component APIs are those of their public headers, which components are compiled
against: each number stands beside a digest of them. --record gives what has changed its next number and new digest.
Usage: abi_number.py ROOT [--record]"""
import hashlib
import pathlib
import re
import sys

# Where the number is; the headers, with the IDL that some are generated from.
MODELS = {
    "host/opros/include/TandemAbi.h": ["host/opros/include/**/*", "host/call/include/**/*"],
    "host/rtm/include/rtm/TandemAbi.h": ["host/rtm/include/**/*", "host/rtm/idl/**/*.idl", "host/call/include/**/*"],
}
NUMBER = re.compile(r"^(#define TANDEM_\w+_ABI )(\d+) // headers: (\w+)$", re.MULTILINE)
TOKEN = re.compile(r"""(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<end>\n)|(?P<blank>\s+)
    |R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|\w+|.""", re.DOTALL | re.VERBOSE)


def tokens(text):
    """What a compiler sees: without comments and white space, except for the end of a preprocessor directive."""
    first_in_line, in_directive = True, False
    for found in TOKEN.finditer(text.replace("\\\n", " ")):
        if found["end"]:
            if in_directive:
                yield "\n"
            first_in_line, in_directive = True, False
        elif not found["comment"] and not found["blank"]:
            in_directive = in_directive or (first_in_line and found[0] == "#")
            first_in_line = False
            yield found[0]


def digest(root, patterns):
    files = sorted({file for pattern in patterns for file in root.glob(pattern)
                    if file.is_file() and file.suffix != ".md"})  # a README is not compiled
    whole = hashlib.sha256()
    for file in files:
        parts = [file.relative_to(root).as_posix(), *tokens(file.read_text())]
        whole.update("\0".join(parts).encode() + b"\0\0")
    return whole.hexdigest()[:16]


def record(root, place, patterns):
    text = (root / place).read_text()
    found = NUMBER.search(text)
    if not found:
        return fault(root, place, patterns)

    def write(new):
        (root / place).write_text(text.replace(found[0], f"{found[1]}{int(found[2]) + 1} // headers: {new}"))
    write(found[3])
    write(digest(root, patterns))  # the number is among what it digests
    return f"{place}: the number is {int(found[2]) + 1} now"


def fault(root, place, patterns):
    found = NUMBER.search((root / place).read_text())
    if not found:
        return f"{place}: no line '#define TANDEM_..._ABI NUMBER // headers: DIGEST'"
    now = digest(root, patterns)
    if now == found[3]:
        return None
    return (f"{place}: the public headers are {now}, not those of ABI number {found[2]} ({found[3]}), so that components "
            f"built before would be loaded; give them the next number: "
            f"python3 tests/architecture/abi_number.py . --record")


def main():
    root = pathlib.Path(sys.argv[1])
    faults = {place: line for place, patterns in MODELS.items() if (line := fault(root, place, patterns))}
    if "--record" in sys.argv[2:]:
        print("\n".join(record(root, place, MODELS[place]) for place in faults) or "nothing has changed")
        return 0
    print("\n".join(faults.values()) or "the ABI numbers are those of the public headers")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
