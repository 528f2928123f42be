#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the arrows of docs/architecture.md: which room may include which, and which headers are a room's private ones.
Usage: check_includes.py ROOT"""
import pathlib
import posixpath
import re
import sys

# Room: the rooms that it may include. A file belongs to the room with the longest matching name. "A/*" stands for A and
# every room in it.
ALLOWED = {
    "shm/os": [],
    "shm/segment": ["shm/os"],
    "shm/wait": ["shm/os", "shm/segment"],
    "shm/ring": ["shm/os", "shm/segment", "shm/wait"],
    "shm/call": ["shm/os", "shm/segment", "shm/wait"],
    "shm": ["shm/os", "shm/segment", "shm/wait", "shm/ring", "shm/call"],
    "shm/inspect": ["shm", "shm/os", "shm/segment", "shm/wait", "shm/ring", "shm/call"],
    "host/process": ["shm/os"],
    "host/crash": [],
    "host/call": [],
    "host/local": ["host/process", "shm/os"],
    "host/text": [],
    "host/log": ["host/text", "shm/os"],
    "host/plugin": ["host/process"],
    "host/rt": ["host/process", "host/crash", "shm/os"],
    "host/options": ["host/plugin", "host/rt", "host/process", "host/text"],
    "host/opros/runtime/archive": [],
    "host/opros/runtime/port": ["host/opros/runtime/archive", "host/rt"],
    "host/opros/runtime/component": ["host/opros/runtime/archive", "host/rt"],
    "host/opros/engine/profile": ["host/text"],
    "host/opros/engine/node": ["host/opros/engine/profile", "host/text", "shm/os"],
    "host/opros/engine/load": ["host/opros/engine/profile", "host/opros/runtime/component", "host/plugin", "host/process",
                               "host/text", "host/log"],
    "host/opros/engine/execute": ["host/opros/engine/profile", "host/opros/engine/load", "host/crash", "host/plugin",
                                  "host/process", "host/rt", "host/log"],
    "host/opros/engine/connect": ["host/opros/engine/profile", "host/opros/engine/load", "host/opros/engine/execute",
                                  "host/crash", "host/process", "host/rt", "host/log"],
    "host/opros/engine": ["host/opros/engine/*", "host/crash", "host/plugin", "host/process", "host/rt", "host/text", "host/log"],
    "host/opros/control": ["host/opros/engine/*", "host/crash", "host/local", "host/process", "host/text", "host/log"],
    "host/opros/program": ["host/opros/engine/*", "host/opros/control", "host/options", "host/crash", "host/local", "host/plugin",
                           "host/process", "host/rt", "host/text", "shm/segment", "host/log"],
    "host/rtm/runtime": [],
    "host/rtm/runtime/coil": ["host/process"],
    "host/rtm/runtime/configuration": ["host/process", "host/text"],
    "host/rtm/runtime/naming": ["host/rtm/runtime/network", "host/local"],
    "host/rtm/runtime/network": ["host/local", "host/process"],
    "host/rtm/runtime/sdo": ["host/process", "host/rtm/runtime/configuration", "host/rtm/runtime/naming", "host/rtm/runtime/upcall"],
    "host/rtm/runtime/transport": ["host/process", "host/rtm/runtime/network", "host/rtm/runtime/upcall", "host/rt",
                                   "shm", "shm/call", "shm/os", "shm/ring", "shm/segment"],
    "host/rtm/runtime/upcall": ["host/crash"],
    "host/rtm/runtime/workarounds": [],
    "host/rtm/runtime/manager": ["host/rtm/runtime/configuration", "host/rtm/runtime/naming", "host/rtm/runtime/network",
                                 "host/rtm/runtime/sdo", "host/rtm/runtime/upcall", "host/crash", "host/local", "host/plugin", "host/process",
                                 "host/rt", "host/text"],
    "host/rtm/runtime/logging": ["host/rtm/runtime/manager", "host/process", "host/text", "host/log"],
    "host/rtm/runtime/port": ["host/process", "host/rt", "host/rtm/runtime/manager", "host/rtm/runtime/naming",
                              "host/rtm/runtime/transport", "host/rtm/runtime/upcall"],
    "host/rtm/runtime/execution": ["host/process", "host/rtm/runtime/manager", "host/rtm/runtime/naming", "host/crash", "host/rt"],
    "host/rtm/runtime/component": ["host/rtm/runtime/execution", "host/rtm/runtime/naming", "host/rtm/runtime/network", "host/rtm/runtime/sdo",
                                   "host/rtm/runtime/upcall", "host/crash", "host/process", "host/rt"],
    "host/rtm/program": ["host/rtm/runtime/*", "host/options", "host/plugin", "host/process", "host/rt",
                         "host/text", "shm/segment", "host/log"],
    "proxy/wire": [],
    "proxy/link/protocol": ["proxy/wire", "shm/*"],
    "proxy/link/session": ["proxy/link/protocol", "proxy/wire", "shm/*", "host/call", "host/process", "host/rt", "host/log"],
    "proxy/link/channel": ["proxy/link/session", "proxy/link/protocol", "proxy/wire", "shm/*", "host/process", "host/rt", "host/log"],
    "proxy/link": ["proxy/link/*", "proxy/wire", "shm/*", "host/call", "host/process", "host/rt", "host/log"],
    "proxy/adaptor/archive": ["proxy/link/protocol", "proxy/wire"],
    "proxy/adaptor/data": ["proxy/adaptor/archive", "proxy/link/*", "proxy/wire", "host/process", "host/log", "host/rt"],
    "proxy/adaptor/engine": ["host/log"],
    "proxy/adaptor/event": ["proxy/adaptor/archive", "proxy/adaptor/engine", "proxy/adaptor/names", "proxy/link/*", "proxy/wire",
                            "host/process", "host/log"],
    "proxy/adaptor/service": ["proxy/adaptor/archive", "proxy/adaptor/names", "proxy/link/*", "proxy/wire",
                              "host/process", "host/log"],
    "proxy/adaptor/names": ["host/text"],
    "proxy/adaptor/share": ["proxy/adaptor/archive", "proxy/adaptor/names", "proxy/adaptor/data", "proxy/adaptor/event",
                            "proxy/adaptor/service", "proxy/link/*",
                            "proxy/wire", "host/process", "host/log"],
    "proxy/adaptor/typed": ["proxy/adaptor/archive", "proxy/adaptor/engine", "proxy/adaptor/event", "proxy/adaptor/names",
                            "proxy/adaptor/service", "proxy/link/*", "proxy/wire", "host/process", "host/log"],
    "proxy/adaptor": ["proxy/adaptor/*", "proxy/link/*", "proxy/wire", "host/process", "host/log", "host/text"],
    "proxy/interceptor/engine": ["host/log"],
    "proxy/interceptor/corba": ["proxy/wire"],
    "proxy/interceptor/data": ["proxy/interceptor/corba", "proxy/interceptor/engine", "proxy/link/*", "proxy/wire", "host/process", "host/log", "host/rt"],
    "proxy/interceptor/service": ["proxy/interceptor/corba", "proxy/interceptor/engine", "proxy/link/*", "proxy/wire", "host/process", "host/rt", "host/log"],
    "proxy/interceptor/manage": ["proxy/interceptor/engine", "proxy/link/*", "proxy/wire"],
    "proxy/interceptor/drive": ["proxy/interceptor/engine", "proxy/link/*", "host/log"],
    "proxy/interceptor/remote": ["proxy/interceptor/drive", "proxy/interceptor/engine", "proxy/link/*", "host/process", "host/log"],
    "proxy/interceptor/opros": ["proxy/interceptor/data", "proxy/interceptor/engine", "proxy/interceptor/service",
                                "proxy/interceptor/corba",
                                "proxy/link/*", "proxy/wire", "host/process", "host/log"],
    "proxy/interceptor": ["proxy/interceptor/*", "proxy/link/*", "proxy/wire", "host/process", "host/log"],
    "plugins": [],
    "apps/tandem/mcap": ["host/process"],
    "apps": ["apps/tandem/mcap", "shm/*", "host/options", "host/local", "host/process", "host/plugin", "host/rt", "host/text", "proxy/wire", "proxy/link/*", "plugins", "apps", "host/log"],
}
# Headers of the hosts' rooms that programs may include.
PUBLIC_TO_APPS = {
    "host/opros/control/describe_port.hpp",
    "host/opros/engine/application.hpp",
    "host/opros/engine/connect/make_connection.hpp",
    "host/opros/engine/execute/component_host.hpp",
    "host/opros/engine/load/absent_properties.hpp",
    "host/opros/engine/load/load_component.hpp",
    "host/opros/engine/profile/flatten_composites.hpp",
    "host/opros/engine/profile/application_profile.hpp",
    "host/opros/engine/profile/component_profile.hpp",
    "host/opros/engine/node/node_adaptor.hpp",
    "host/opros/engine/node/node_part.hpp",
    "host/opros/engine/profile/profile_kind.hpp",
    "host/opros/engine/profile/setup_error.hpp",
    "host/opros/engine/profile/start_order.hpp",
    "host/opros/engine/profile/type_profile.hpp",
    "host/opros/engine/profile/xml_file.hpp",
    "host/rtm/runtime/configuration/component_arguments.hpp",
    "host/rtm/runtime/configuration/conf_check.hpp",
    "host/rtm/runtime/configuration/conf_file.hpp",
    "host/rtm/runtime/configuration/conf_keys.hpp",
    "host/rtm/runtime/configuration/manager_settings.hpp",
    "host/rtm/runtime/configuration/manager_start.hpp",
    "host/rtm/runtime/configuration/openrtm_modules.hpp",
    "host/rtm/runtime/manager/manager_options.hpp",
    "host/rtm/runtime/naming/remote_names.hpp",
    "host/rtm/runtime/network/tls.hpp",
    "host/rtm/runtime/port/custom_serializer.hpp",
    "host/rtm/runtime/port/refusal_reason.hpp",
    "proxy/adaptor/archive/type_check.hpp",
    "proxy/adaptor/model.hpp",
    "proxy/adaptor/property_check.hpp",
    "proxy/interceptor/corba/generic_call.hpp",
    "proxy/interceptor/corba/transcoder.hpp",
    "proxy/interceptor/model.hpp",
    "proxy/interceptor/rtc_port.hpp",
}
# The two component models' API headers: a room of one model must not see the other's.
FOREIGN = {
    "host/opros": ("rtm/", "coil/"), "proxy/adaptor": ("rtm/", "coil/"),
    "host/rtm": ("archive/opros", "Component.h"), "proxy/interceptor": ("archive/opros", "Component.h"),
    "proxy/link": ("rtm/", "coil/", "Component.h"), "proxy/wire": ("rtm/", "coil/", "Component.h"),
    "shm": ("rtm/", "coil/", "Component.h"),
}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')
SOURCES = {".hpp", ".cpp", ".h", ".hh", ".cc"}


def matches(path, room):
    room = room.removesuffix("/*")
    return path == room or path.startswith(room + "/")


ROOMS = sorted(ALLOWED, key=lambda room: len(room.removesuffix("/*")), reverse=True)


def room_of(path):
    return next((room for room in ROOMS if matches(path, room)), None)


def arrow(room, target):
    """Whether the table has an arrow from the room to the other one."""
    return any(target == allowed or (allowed.endswith("/*") and matches(target.removesuffix("/*"), allowed))
               for allowed in ALLOWED[room])


def may_include(room, header):
    """Whether a file of the room may include this header of the tree."""
    target = room_of(header)
    return target is None or target == room or (room == "apps" and header in PUBLIC_TO_APPS) or arrow(room, target)


def in_tree(path, header):
    """The header that a file includes, from the root of the tree: it may be written from the file's own folder."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(path), header)) if header.startswith(".") else header


def faults_of(root, file):
    path = file.relative_to(root).as_posix()
    room = room_of(path)
    if room is None:
        yield f"{path}: its room has no line in tests/architecture/check_includes.py"
        return
    for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
        found = INCLUDE.match(line)
        if not found:
            continue
        header = in_tree(path, found[1])
        for owner, foreign in FOREIGN.items():
            if matches(path, owner) and header.startswith(foreign):
                yield f"{path}:{number}: {owner} includes {header} of the other component model"
        if not may_include(room, header):
            yield f"{path}:{number}: {room} must not include {room_of(header)} ({header})"


def faults(root):
    tops = sorted({room.split("/")[0] for room in ALLOWED})
    files = (file for top in tops for file in sorted((root / top).rglob("*")) if file.suffix in SOURCES)
    for file in files:
        path = file.relative_to(root).as_posix()
        if "/include/" not in path:
            yield from faults_of(root, file)


ROW = re.compile(r"^\| `([^`]+)`[^|]*\|[^|]*\| ([^|]*) \|$", re.MULTILINE)


def absent_rooms(page):
    """Yields each room that no row of the table of rooms in docs/architecture.md covers."""
    rows = [room for room, _ in ROW.findall(page)]
    for room in ALLOWED:
        if not any(matches(room, row) for row in rows):
            yield f"docs/architecture.md: the table has no row for {room}"


def table_faults(page):
    """Yields each arrow that the table of rooms in docs/architecture.md lacks. A cell that begins with "all" has every arrow."""
    for room, cell in ROW.findall(page):
        named = re.findall(r"`([^`]+)`", cell)
        for source, targets in ALLOWED.items():
            for target in targets if matches(source, room) and not cell.startswith("all") else []:
                if not any(matches(target.removesuffix("/*"), name) for name in [room, *named]):
                    yield f"docs/architecture.md: {room} may include {target}, which the table lacks"


def main():
    root = pathlib.Path(sys.argv[1])
    page = (root / "docs/architecture.md").read_text()
    found = [*faults(root), *absent_rooms(page), *table_faults(page)]
    print("\n".join(found) if found else "all includes follow the architecture")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
