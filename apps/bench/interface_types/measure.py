#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures a connection of each interface type between two RTCs, and the bridge: in rtm_host, and with --openrtm also in the manager
of an OpenRTM-aist 2.x that is installed at PREFIX, in turn. Writes the rows as CSV. See README.md."""
import argparse
import csv
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
TYPES = ["direct_read", "direct", "corba_cdr_read", "corba_cdr", "shared_memory", "data_service"]
# OpenRTM-aist 2.1.0 ends when its shared memory object has to grow for 6 MiB.
LARGE_OBJECT = ["-p", "shem_default_size=8M"]
FIELDS = ["engine", "interface_type", "round", "bytes", "samples", "lost", "p50_us", "p99_us"]


def fail(message):
    sys.exit(f"measure.py: {message}")


def options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", default="build/release", type=pathlib.Path, help="build folder of Tandem (build/release)")
    parser.add_argument("--openrtm", metavar="PREFIX", type=pathlib.Path, help="an installed OpenRTM-aist 2.x, measured in turn with ours")
    parser.add_argument("--types", default=",".join(TYPES + ["bridge"]), help="comma-separated (all): direct_read, direct ... data_service, bridge")
    parser.add_argument("--messages", default=5000, type=int, help="at most so many of each size (5000)")
    parser.add_argument("--seconds", default=1.0, type=float, help="at most so long for each size (1)")
    parser.add_argument("--rounds", default=3, type=int, help="how often all of it is measured (3)")
    parser.add_argument("--output", default="interface_types.csv", type=pathlib.Path, help="the CSV file (interface_types.csv)")
    chosen = parser.parse_args()
    chosen.types = chosen.types.split(",")
    for name in chosen.types:
        if name not in TYPES + ["bridge"]:
            parser.error(f"interface type {name}: expected some of {', '.join(TYPES)}, bridge")
    return chosen


class Engine:
    """The manager's program and where its component library is."""

    def __init__(self, name, program, plugins, environment):
        self.name, self.program, self.plugins, self.environment = name, program, plugins, environment


def our_engine(build):
    if not (build / "bin/rtm_host").exists():
        fail(f"{build}/bin/rtm_host does not exist: build Tandem, or name its build folder with --build")
    return Engine("Tandem", build / "bin/rtm_host", build / "plugins/rtm", {})


def other_engine(prefix, folder):
    """Builds the pair for the OpenRTM-aist at PREFIX. Its manager has the libraries that the pair needs."""
    programs = [prefix / "bin" / name for name in ("rtcd2", "rtcd")]
    configs = [prefix / "bin" / name for name in ("rtm2-config", "rtm-config")]
    program = next((p for p in programs if p.exists()), None)
    config = next((c for c in configs if c.exists()), None)
    if not program or not config:
        fail(f"{prefix} has no OpenRTM-aist 2.x: expected bin/rtcd2 and bin/rtm2-config")
    flags = subprocess.run([config, "--cflags"], check=True, capture_output=True, text=True).stdout.split()
    command = ["g++", "-std=c++17", "-O2", "-fPIC", "-shared", "-w", *flags, HERE / "InterfaceTypes.cpp", "-o", folder / "InterfaceTypes.so"]
    if subprocess.run(command).returncode != 0:
        fail(f"InterfaceTypes.cpp does not compile with {config} --cflags")
    libraries = f"{prefix}/lib:{os.environ.get('LD_LIBRARY_PATH', '')}".rstrip(":")
    # omniORB refuses messages above 2 MB unless told otherwise; rtm_host does so by itself.
    return Engine("OpenRTM-aist", program, folder, {"LD_LIBRARY_PATH": libraries, "ORBgiopMaxMsgSize": "67108864"})


class Processes:
    """Those of one measurement, ended at its end whatever happens."""

    def __init__(self, folder):
        self.folder, self.running = folder, []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.running:
            process.send_signal(signal.SIGINT)
        for process in self.running:
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def start(self, command, environment=None):
        log = open(self.folder / f"{len(self.running)}.log", "wb")
        self.running.append(subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL, cwd=self.folder,
                                             env={**os.environ, **(environment or {})}))
        log.close()

    def logs(self):
        return "".join((self.folder / f"{i}.log").read_text(errors="replace") for i in range(len(self.running)))[-2000:]

    def wait_for(self, what, condition, seconds):
        end = time.monotonic() + seconds
        while not condition():
            if any(process.poll() is not None for process in self.running):
                fail(f"{what}: a host has ended\n{self.logs()}")
            if time.monotonic() > end:
                fail(f"{what}: not within {seconds:.0f} s\n{self.logs()}")
            time.sleep(0.05)


def free_ports():
    """Two TCP ports that nobody uses now, for the two managers."""
    with socket.socket() as one, socket.socket() as two:
        for each in (one, two):
            each.bind(("127.0.0.1", 0))
        return one.getsockname()[1], two.getsockname()[1]


def write_rtc_conf(file, engine, port, components, further_plugins=()):
    libraries = ["InterfaceTypes.so"] + [f"{plugin.name}" for plugin in further_plugins]
    file.write_text(f"""naming.enable: NO
logger.enable: NO
manager.shutdown_auto: NO
manager.shutdown_on_nortcs: NO
corba.endpoints: 127.0.0.1:{port}
exec_cxt.periodic.rate: 100
manager.modules.load_path: {", ".join(str(path) for path in [engine.plugins] + [plugin.parent for plugin in further_plugins])}
manager.modules.abs_path_allowed: YES
manager.modules.preload: {", ".join(libraries)}
manager.components.precreate: {", ".join(components)}
""")


def write_application(file, build, link):
    shutil.copy(build / "plugins/opros/InterfaceTypesMirror.xml", file.parent)
    shutil.copy(build / "plugins/opros/AdaptorComp.xml", file.parent)

    def component(name, profile, properties=""):
        return f"<subcomponent><name>{name}</name><reference>{profile}.xml</reference><properties>{properties}</properties></subcomponent>\n"

    def connection(source, target, port):
        return (f'<port_connection port_type="data"><source component_name="{source}" port_name="{port}"/>'
                f'<target component_name="{target}" port_name="{port}"/></port_connection>\n')

    file.write_text('<?xml version="1.0"?>\n<package_profile><name>interface_types</name>\n<subcomponents>\n' +
                    component("Mirror", "InterfaceTypesMirror") +
                    component("Adaptor", "AdaptorComp", f'<property name="link">{link}</property><property name="wait">30</property>') +
                    "</subcomponents>\n<port_connections>\n" + connection("Adaptor", "Mirror", "ping") +
                    connection("Mirror", "Adaptor", "pong") + "</port_connections></package_profile>\n")


def tandem_rtm(build, *arguments):
    """One call of `tandem rtm`: whether it did what it was asked for."""
    done = subprocess.run([build / "bin/tandem", "rtm", *arguments], capture_output=True, text=True)
    return done.returncode == 0, done.stderr.strip()


def measure(build, engine, kind, chosen):
    """The rows of one engine and one interface type: bytes, samples, lost, p50 and p99 in us."""
    with tempfile.TemporaryDirectory(prefix="interface-types-") as name, Processes(pathlib.Path(name)) as processes:
        folder = pathlib.Path(name)
        results = folder / "results"
        ports = free_ports()
        ping = "InterfaceTypesPing?" + "&".join(f"conf.default.{key}={value}" for key, value in {
            "file": results, "messages": chosen.messages, "seconds": chosen.seconds,
            "read": {"direct_read": "alone", "corba_cdr_read": "yes"}.get(kind, "no")}.items())
        pong = "InterfaceTypesPong?conf.default.read=" + ("yes" if kind == "corba_cdr_read" else "no")
        what = f"{engine.name}, {kind}"
        pong_port = ports[0] if kind == "direct" else ports[1]
        where = [f"rtcloc://127.0.0.1:{ports[0]}/InterfaceTypesPing0", f"rtcloc://127.0.0.1:{pong_port}/InterfaceTypesPong0"]
        if kind == "bridge":
            write_application(folder / "app.xml", build, folder.name)
            write_rtc_conf(folder / "0.conf", engine, ports[0], [ping, f"InterceptorComp?link={folder.name}&rtc=InterfaceTypesPing0"],
                           [build / "plugins/rtm/InterceptorComp.so"])
            processes.start([build / "bin/opros_host", folder / "app.xml"])
        elif kind == "direct_read":
            where[1] = where[0]
            write_rtc_conf(folder / "0.conf", engine, ports[0], [ping])
        elif kind == "direct":
            write_rtc_conf(folder / "0.conf", engine, ports[0], [ping, pong])
        else:
            write_rtc_conf(folder / "0.conf", engine, ports[0], [ping])
            write_rtc_conf(folder / "1.conf", engine, ports[1], [pong])
        for conf in sorted(folder.glob("?.conf")):
            processes.start([engine.program, "-f", conf], engine.environment)

        waiting = where[:1] if kind in ("bridge", "direct_read") else where
        for rtc in waiting:
            processes.wait_for(f"{what}: {rtc}", lambda rtc=rtc: tandem_rtm(build, "info", rtc)[0], 20)
        if kind == "bridge":
            processes.wait_for(f"{what}: the link", lambda: "mirrored" in processes.logs(), 20)
        else:
            ping_rtc, pong_rtc = where
            pairs = {f"{ping_rtc}:ping": f"{pong_rtc}:ping", f"{pong_rtc}:pong": f"{ping_rtc}:pong"}
            if kind == "direct_read":
                pairs = {f"{ping_rtc}:ping": f"{ping_rtc}:pong"}
            for source, target in pairs.items():
                done, error = tandem_rtm(build, "connect", source, target, "-p", f"interface_type={kind.removesuffix('_read')}",
                                           *(LARGE_OBJECT if kind == "shared_memory" else []))
                if not done:
                    fail(f"{what}: {error}")
        # Pong first: its listener answers whatever its state, but so is the order of a system.
        for rtc in waiting[::-1]:
            done, error = tandem_rtm(build, "activate", rtc)
            if not done:
                fail(f"{what}: {error}")
        processes.wait_for(what, results.exists, 30 + 7 * (chosen.seconds + 10))
        return [line.split() for line in results.read_text().splitlines()]


def main():
    chosen = options()
    build = chosen.build.resolve()
    with tempfile.TemporaryDirectory(prefix="interface-types-plugin-") as plugin_folder:
        engines = [our_engine(build)]
        if chosen.openrtm:
            engines.append(other_engine(chosen.openrtm.resolve(), pathlib.Path(plugin_folder)))
        with open(chosen.output, "w", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(FIELDS)
            for number in range(1, chosen.rounds + 1):
                for kind in chosen.types:
                    for engine in engines:
                        if kind == "bridge" and engine is not engines[0]:
                            continue
                        rows = measure(build, engine, kind, chosen)
                        table.writerows([engine.name, kind, number, *row] for row in rows)
                        file.flush()
                        print(f"round {number}, {engine.name}, {kind}: " +
                              ", ".join(f"{row[0]} B {float(row[3]):.1f} us" for row in rows), flush=True)


main()
