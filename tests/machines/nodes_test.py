#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs one case of an OPRoS application with two nodes, on two machines that are network namespaces.   nodes_test.py CASE BUILD

Exit code 77 (skipped) where namespaces are not permitted.
"""
import re
import shutil
import sys
import time

import machines_test
from machines import enter_user_namespace, skip, wait_until
from pairs import Pair, Wheelchair
from wheelchair import NODES, add_properties

COMPONENT = """<component_profile><name>{0}</name>
<execution_environment><library_name>{0}.so</library_name></execution_environment>
<execution_semantics><type>periodic</type><period>10</period></execution_semantics></component_profile>
"""


class Nodes(Pair):
    """NodeSource on machine a, NodeSink on machine b, by one folder for both."""

    def __init__(self, build):
        super().__init__(build)
        self.application = self.folder / "app"
        opros = self.application / "opros"
        opros.mkdir(parents=True)
        for name in ("NodeSource", "NodeSink"):
            (opros / f"{name}.xml").write_text(COMPONENT.format(name))
        components = "".join(
            f"<subcomponent><name>{name}</name><node_id>{node}</node_id><reference>{name}.xml</reference><properties>"
            f'<property name="file">{self.folder}/{node}</property></properties></subcomponent>'
            for name, node in (("NodeSource", "out"), ("NodeSink", "in")))
        connections = "".join(
            f'<port_connection port_type="{kind}"><source component_name="NodeSource" port_name="{source}"/>'
            f'<target component_name="NodeSink" port_name="{target}"/></port_connection>'
            for kind, source, target in (("data", "numbers", "numbers"), ("data", "poses", "poses"),
                                         ("event", "news", "news"), ("service", "math", "sums")))
        nodes = "".join(f'<node id="{node}"><prop name="ip.addr">{machine.address}</prop></node>'
                        for node, machine in (("out", self.a), ("in", self.b)))
        (opros / "app.xml").write_text(
            f"<package_profile><name>app</name><subcomponents>{components}</subcomponents><node_map>{nodes}</node_map>"
            f"<port_connections>{connections}</port_connections></package_profile>")

    def start_node(self, name, *more):
        machine, node = (self.a, "out") if name == "a" else (self.b, "in")
        self.start(machine, name, [self.tandem, "run", "--restart", "3", "--node", node, "--plugin-path",
                                   self.build / "tests/machines/plugins", *more, self.application])

    def lines(self, node, pattern):
        """The first group of each line that the component of a node has written."""
        path = self.folder / node
        return re.findall(f"(?m)^{pattern}$", path.read_text()) if path.exists() else []

    def wait_for_more_of_all(self, count=20):
        wanted = (("in", r"number (\d+)"), ("in", r"pose frame (\d+)"), ("in", r"event tick (\d+)"),
                  ("out", r"answer (\d+) [\d.]+ turned frame \d+"))
        before = [len(self.lines(*each)) for each in wanted]
        for each, size in zip(wanted, before):
            wait_until(lambda: len(self.lines(*each)) >= size + count, f"{count} lines more than {size} of {each}")

    def check_order(self):
        for pattern in (r"number (\d+)", r"pose frame (\d+)", r"event tick (\d+)"):
            numbers = list(map(int, self.lines("in", pattern)))
            wrong = [(x, y) for x, y in zip(numbers, numbers[1:]) if y <= x]
            assert not wrong, f"{pattern}: repeated or out of order: {wrong[:5]}"
        for cycle, total, frame in re.findall(r"(?m)^answer (\d+) ([\d.]+) turned frame (\d+)$", (self.folder / "out").read_text()):
            assert float(total) == int(cycle) + 0.5 and cycle == frame, (cycle, total, frame)


def nodes(build):
    """Data, events and services cross between nodes without a command, in either order of start and after a cut."""
    pair = Nodes(build)
    refused = pair.a.run([pair.tandem, "run", pair.application], check=False)
    assert refused.returncode == 1 and refused.stdout.count("\n") == 1, refused.stdout
    assert "several nodes (in, out)" in refused.stdout and "--node ID" in refused.stdout, refused.stdout
    pair.start_node("a")
    pair.wait_for_log("a", "NodeSource did not start and will be tried again")
    pair.start_node("b")
    pair.wait_for_log("a", "component NodeSource has started")
    pair.wait_for_more_of_all()
    for cut in ("cable", "interface"):
        pair.cable.pull() if cut == "cable" else pair.a.link("down")
        time.sleep(3)
        pair.cable.plug() if cut == "cable" else pair.a.link("up")
        pair.wait_for_more_of_all()
    pair.check_order()
    attempts = pair.log("a").count("onStart failed")
    assert attempts <= 2, f"{attempts} lines about the same failure:\n{pair.log('a')}"
    return pair


def nodes_restart(build):
    """A host that was killed is started again by tandem run, and the connections are made again by themselves."""
    pair = Nodes(build)
    pair.start_node("b")
    pair.start_node("a")
    pair.wait_for_more_of_all()
    for name, host in (("b", "rtm_host"), ("b", "opros_host"), ("a", "rtm_host")):
        started = pair.log(name).count(f"{host} started")
        pair.kill_child(name, host)
        wait_until(lambda: pair.log(name).count(f"{host} started") > started, f"{host} is started again")
        pair.wait_for_more_of_all()
    pair.check_order()
    return pair


class WheelchairNodes(Wheelchair):
    """The wheelchair as one application: JoystickComp on node joystick, ControlComp and HWComp on node chair."""

    def start_hosts(self):
        folder = self.folder / "app"
        shutil.copytree(NODES, folder)
        application = folder / "opros/wheelchair.xml"
        text = application.read_text()
        for node, machine in (("joystick", self.a), ("chair", self.b)):
            text, found = re.subn(rf'(<node id="{node}"><prop name="ip.addr">)[^<]*', rf"\g<1>{machine.address}", text)
            assert found == 1
        application.write_text(add_properties(text, self.properties("JoystickComp", "HWComp", "ControlComp")))
        for machine, name, node in ((self.a, "a", "joystick"), (self.b, "b", "chair")):
            self.start(machine, name, [self.tandem, "run", "--restart", "3", "--node", node, folder])

    def connect(self, check=True):
        pass


def wheelchair_stops(build):
    return machines_test.wheelchair_stops(build, WheelchairNodes)


CASES = {case.__name__: case for case in (nodes, nodes_restart, wheelchair_stops)}


def main():
    enter_user_namespace()
    if not shutil.which("ip"):
        skip("ip is not installed (iproute2, group [machines] of apps/dependencies.txt)")
    pair = CASES[sys.argv[1]](sys.argv[2])
    pair.stop()
    pair.remove()
    print(f"{sys.argv[1]}: as expected")


if __name__ == "__main__":
    main()
