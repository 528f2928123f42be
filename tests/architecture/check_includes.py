#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the arrows of the architecture: which room may include which. Usage: check_includes.py ROOT"""
import pathlib
import re
import sys

ALLOWED = {
    "shm": {"shm/os"},
    "shm/os": set(),
    "host/process": {"shm/os"},
    "host/plugin": {"host/process"},
    "host/rt": {"host/process"},
    "host/opros": {"host/plugin", "host/process", "host/rt"},
    "host/rtm": {"host/plugin", "host/process", "host/rt"},
    "proxy/wire": set(),
    "proxy/link": {"host/process", "proxy/wire", "shm", "shm/os"},
    "proxy/adaptor": {"proxy/link", "proxy/wire"},
    "proxy/interceptor": {"proxy/link", "proxy/wire"},
    "plugins": set(),
}
ROOMS = sorted(ALLOWED, key=len, reverse=True)
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
SOURCES = {".hpp", ".cpp", ".h", ".hh", ".cc"}
# The two component models' API headers: a room of one model must not see the other's.
FOREIGN = {
    "host/opros": ("rtm/", "coil/"), "proxy/adaptor": ("rtm/", "coil/"),
    "host/rtm": ("archive/opros", "Component.h"), "proxy/interceptor": ("archive/opros", "Component.h"),
    "proxy/link": ("rtm/", "coil/", "Component.h"), "proxy/wire": ("rtm/", "coil/", "Component.h"),
    "shm": ("rtm/", "coil/", "Component.h"),
}


def room_of(path):
    return next((room for room in ROOMS if path == room or path.startswith(room + "/")), None)


def faults(root):
    files = [p for room in ALLOWED for p in (root / room).rglob("*") if p.suffix in SOURCES]
    for file in sorted(set(files)):
        room = room_of(file.relative_to(root).as_posix())
        for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
            found = re.match(r'^\s*#\s*include\s*["<]([^">]+)[">]', line)
            if not found:
                continue
            header = found.group(1)
            place = f"{file.relative_to(root)}:{number}"
            if header.startswith(FOREIGN.get(room, ())):
                yield f"{place}: {room} includes {header} of the other component model"
            target = room_of(header) if INCLUDE.match(line) else None
            if target and target != room and target not in ALLOWED[room]:
                yield f"{place}: {room} must not include {target} ({header})"


def main():
    found = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found) if found else "all includes follow the architecture")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
