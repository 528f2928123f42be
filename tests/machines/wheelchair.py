# SPDX-License-Identifier: Apache-2.0
"""The wheelchair of plugins/wheelchair on two machines, as docs/two_machines.md sets it up."""
import pathlib
import struct

RTC_CONF = """naming.enable: NO
manager.shutdown_auto: NO
manager.shutdown_on_nortcs: NO
corba.endpoints: {endpoints}
manager.modules.preload: InterceptorComp.so
manager.components.precreate: InterceptorComp?link={link}
"""


def component(name, profile, properties):
    lines = "".join(f'<property name="{key}">{value}</property>' for key, value in properties.items())
    return (f"<subcomponent><name>{name}</name><reference>{profile}.xml</reference>"
            f"<properties>{lines}</properties></subcomponent>\n")


def connection(source, source_port, target, target_port):
    return (f'<port_connection port_type="data"><source component_name="{source}" port_name="{source_port}"/>'
            f'<target component_name="{target}" port_name="{target_port}"/></port_connection>\n')


def write_machine(folder, link, endpoints, components, connections=(), more=""):
    """A folder for `tandem run`: OPRoS components, all of them shared as RTCs, and an rtm_host at these end points."""
    folder = pathlib.Path(folder)
    for part in ("opros", "rtm"):
        (folder / part).mkdir(parents=True)
    (folder / "rtm/rtc.conf").write_text(RTC_CONF.format(endpoints=endpoints, link=link) + more)
    xml = component("Adaptor", "AdaptorComp", {"link": link, "share": ", ".join(components)})
    xml += "".join(component(name, name, properties) for name, properties in components.items())
    (folder / "opros/app.xml").write_text(
        '<?xml version="1.0"?>\n<package_profile><name>machine</name>\n<subcomponents>\n' + xml +
        "</subcomponents>\n<port_connections>\n" + "".join(connection(*one) for one in connections) +
        "</port_connections></package_profile>\n")


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
