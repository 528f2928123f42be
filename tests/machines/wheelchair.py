# SPDX-License-Identifier: Apache-2.0
"""The wheelchair of plugins/wheelchair on two machines, as docs/two_machines.md sets it up: the files of apps/wheelchair/two_machines."""
import pathlib
import re
import shutil
import struct

NETWORK = "10.77.0.0/24"  # of machines.Machine
APPS = pathlib.Path(__file__).resolve().parents[2] / "apps/wheelchair"
EXAMPLE, NODES = APPS / "two_machines", APPS / "two_nodes"


def add_properties(application, properties):
    """The text of an application profile with more properties, which are by component."""
    for component, values in properties.items():
        more = "".join(f'<property name="{name}">{value}</property>' for name, value in values.items())
        application, found = re.subn(rf"(<name>{component}</name>.*?<properties>)", rf"\1{more}", application, count=1,
                                     flags=re.S)
        assert found == 1
    return application


def copy_machine(example, folder, address, properties):
    """The example's folder for `tandem run`, with another address and more properties, which are by component."""
    shutil.copytree(EXAMPLE / example, folder)
    conf = folder / "rtm/rtc.conf"
    text = conf.read_text()
    for key, value in ("endpoints", f"{address}:2810"), ("permitted_hosts", NETWORK):
        text, found = re.subn(rf"(?m)^corba.{key}: .*", f"corba.{key}: {value}", text)
        assert found == 1
    conf.write_text(text)
    application = folder / f"opros/{example}.xml"
    application.write_text(add_properties(application.read_text(), properties))


def stick_that_drives_again(path, seconds):
    """A stick that is released for 2 s of each 6 s: after a safe stop the chair drives again only then."""
    lines = ["t,jx,jy,estop"]
    for t in range(0, seconds, 6):
        lines += [f"{t},0,0,0", f"{t + 2},0,1000,0"]
    path.write_text("\n".join(lines) + "\n")


class Trace:
    """What a component has recorded, tick by tick: see plugins/wheelchair/core/record/trace.hpp."""

    def __init__(self, path):
        self.path = pathlib.Path(path)

    def size(self):
        try:
            with self.path.open("rb") as file:
                header = file.read(24)
        except FileNotFoundError:
            return 0
        return struct.unpack("=8sIIQ", header)[3] if len(header) == 24 else 0

    def records(self, first=0):
        """Dictionaries from record number `first` on."""
        size = self.size()
        if size <= first:
            return []
        with self.path.open("rb") as file:
            columns = struct.unpack("=8sIIQ", file.read(24))[2]
            names = [file.read(24).rstrip(b"\0").decode() for _ in range(columns)]
            file.seek(4096 + first * columns * 8)
            data = file.read((size - first) * columns * 8)
        return [dict(zip(names, one)) for one in struct.iter_unpack(f"={columns}d", data)]
