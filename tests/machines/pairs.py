# SPDX-License-Identifier: Apache-2.0
"""Two machines with hosts on them: of a test's own RTCs, or of the wheelchair's."""
import itertools
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile

from machines import Cable, Machine, skip, wait_until
from wheelchair import EXAMPLE, NETWORK, Trace, copy_machine, stick_that_drives_again

PERMITTED = f"corba.permitted_hosts: {NETWORK}, fd77::/64\n"
STALE_SECONDS = 0.05  # docs/wheelchair.md, 6.5
RUN, STALE, FAULT = 0, 1, 3


class Pair:
    """Two machines, the programs of a build, and a folder."""

    def __init__(self, build, clock=0, direct=False):
        self.build = pathlib.Path(build).resolve()
        self.tandem = self.build / "bin/tandem"
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tandem-machines-"))
        self.a, self.b = Machine(1, clock), Machine(2)
        self.cable = Cable(self.a, self.b, direct)
        self.hosts, self.environment = {}, []
        print(f"{self.folder}: logs, which stay when the case fails")

    def start(self, machine, name, command):
        log = (self.folder / f"{name}.log").open("a")
        self.hosts[name] = machine.start(["env", *self.environment, *command], stdout=log, stderr=subprocess.STDOUT)

    def start_rtm_host(self, machine, name, lines, endpoints=None, permitted=PERMITTED):
        """An rtm_host with the test's own RTCs."""
        conf = self.folder / f"{name}.conf"
        conf.write_text("naming.enable: NO\nmanager.shutdown_auto: NO\nmanager.shutdown_on_nortcs: NO\n"
                        f"corba.endpoints: {endpoints or machine.address + ':2810'}\n{permitted}"
                        "manager.modules.preload: SequenceRtcs.so\nexec_cxt.periodic.rate: 100\n" + lines)
        (self.folder / f"{name}.log").write_text("")
        self.start(machine, name, [self.build / "bin/rtm_host", "-f", conf, "--plugin-path",
                                   self.build / "tests/machines/plugins"])
        self.wait_for_log(name, "ready")

    def log(self, name):
        return (self.folder / f"{name}.log").read_text()

    def wait_for_log(self, name, text):
        wait_until(lambda: text in self.log(name) or self.hosts[name].poll() is not None, f"{text} in the log of {name}")
        assert text in self.log(name), f"{name} has ended:\n{self.log(name)}"

    def rtm(self, *arguments, check=True):
        return self.a.run(["env", *self.environment, self.tandem, "rtm", *arguments], check=check)

    def numbers(self, name):
        """What CountIn or CountOut has written down: pairs of number and nanoseconds."""
        path = self.folder / name
        lines = path.read_text().splitlines() if path.exists() else []
        return [tuple(map(int, line.split())) for line in lines if re.fullmatch(r"\d+ -?\d+", line)]

    def start_count(self, name, more="", endpoints=None, settings_more="", permitted=PERMITTED):
        """CountOut on machine a, or CountIn on machine b, ACTIVE."""
        machine, host = (self.a, "a") if name == "CountOut" else (self.b, "b")
        settings = self.folder / f"{name}.conf"
        settings.write_text(f"conf.default.file: {self.folder}/{name[5:].lower()}\n{settings_more}")
        self.start_rtm_host(machine, host, f"manager.components.precreate: {name}\n"
                            f"manager.components.preactivation: {name}0\ntest.{name}0.config_file: {settings}\n{more}", endpoints, permitted)

    def start_counting(self, out="", incoming="", endpoints=(None, None), permitted=PERMITTED):
        self.start_count("CountOut", out, endpoints[0], permitted=permitted)
        self.start_count("CountIn", incoming, endpoints[1], permitted=permitted)

    def wait_for_more(self, count=20):
        """Until so many more numbers have come to CountIn."""
        before = len(self.numbers("in"))
        wait_until(lambda: len(self.numbers("in")) >= before + count, f"{count} numbers more than {before}")

    def expect_in_order(self):
        received = [number for number, _ in self.numbers("in")]
        wrong = [(x, y) for x, y in zip(received, received[1:]) if y <= x]
        assert not wrong, f"repeated or out of order: {wrong[:5]}"
        return received

    def kill(self, name):
        self.hosts[name].kill()  # nsenter has become the host
        self.hosts.pop(name).wait()

    def kill_child(self, name, program):
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                parent = (process / "stat").read_text().rsplit(")", 1)[1].split()[1]
                if int(parent) == self.hosts[name].pid and (process / "comm").read_text().strip() == program:
                    os.kill(int(process.name), signal.SIGKILL)
                    return
            except FileNotFoundError:
                continue
        raise AssertionError(f"{name} has no {program}")

    def stop(self):
        for host in self.hosts.values():
            host.terminate()
        for name, host in self.hosts.items():
            assert host.wait(60) == 0, f"{name} ended with {host.returncode}:\n{self.log(name)}"

    def remove(self):
        shutil.rmtree(self.folder, ignore_errors=True)


class Wheelchair(Pair):
    """JoystickComp on machine a, ControlComp and HWComp on machine b, connected by `tandem rtm connect` alone."""

    def __init__(self, build, clock=1000):
        super().__init__(build, clock)
        stick_that_drives_again(self.folder / "stick.csv", 7200)
        self.start_hosts()
        for name in ("a", "b"):
            self.wait_for_log(name, "all hosts are ready")
        self.control, self.hw = Trace(self.folder / "ControlComp.trace"), Trace(self.folder / "HWComp.trace")
        self.joystick, self.joystick_clock = Trace(self.folder / "JoystickComp.trace"), clock

    def start_hosts(self):
        copy_machine("joystick", self.folder / "a", self.a.address, self.properties("JoystickComp"))
        copy_machine("chair", self.folder / "b", self.b.address, self.properties("HWComp", "ControlComp"))
        for machine, name in ((self.a, "a"), (self.b, "b")):
            self.start(machine, name, [self.tandem, "run", "--restart", "3", self.folder / name])

    def properties(self, *components):
        return {name: {"trace": self.folder / f"{name}.trace", "joystick_file": self.folder / "stick.csv"}
                for name in components}

    def connect(self, check=True):
        wait_until(lambda: all(self.rtm("info", f"rtcloc://{machine.address}/{name}", check=False).returncode == 0
                               for machine, name in ((self.a, "JoystickComp"), (self.b, "HWComp"), (self.b, "ControlComp"))),
                   "the components are RTCs")
        command = ["env", f"TANDEM={self.tandem}", EXAMPLE / "connect.sh", self.a.address, self.b.address]
        done = self.a.run(command, check=False)
        assert not check or done.returncode == 0, done.stdout
        return done

    def drives(self):
        last = self.control.records(max(0, self.control.size() - 20))
        self.skip_if_late(last)
        return any(one["state"] == RUN and one["volts_left"] > 1 for one in last)

    def skip_if_late(self, records):
        """ControlComp stays in FAULT after a wheel speed of 50 ms ago, which comes from its own machine: where one of both has lost
        some of its ticks, that was late, and not the network."""
        if all(one["state"] != FAULT or one["time"] - one["wheel_stamp"] <= STALE_SECONDS for one in records):
            return
        pause = self.longest_pause()
        if pause > 0.8 * STALE_SECONDS:
            skip(f"this machine was late by {1e3 * pause:.0f} ms, for which ControlComp stops the chair for good")

    def longest_pause(self):
        """Between two ticks of a component [s]: by how much the machine was late, and its period."""
        return max(after["at"] - before["at"] for trace in (self.control, self.hw)
                   for before, after in itertools.pairwise(trace.records()))

    def check_references(self, records, delay=0.0):
        """What ControlComp's own law promises of each tick, and what the network must keep. Returns the references' number. delay: of
        the network, at least [s]."""
        sent = {one["tick"]: one["stamp"] - self.joystick_clock for one in self.joystick.records()}
        received, newest = 0, None
        late = 0.04 + self.longest_pause()  # the cable is a process of this machine, too
        for one in records:
            self.skip_if_late([one])
            assert one["state"] in (RUN, STALE), f"ControlComp is in state {one['state']} at tick {one['tick']}"
            if one["references_received"] > 0:
                if newest is not None:
                    fresh = one["reference_sequence"] - newest
                    assert fresh >= one["references_received"], f"repeated or out of order at tick {one['tick']}"
                newest = one["reference_sequence"]
                received += one["references_received"]
            if newest is None or one["state"] == STALE:
                continue
            # As ControlComp counts it, and as it was: it knows the quickest of the last messages, not how long that took.
            counted, age = one["time"] - one["reference_stamp"], one["time"] - sent[newest]
            assert counted <= STALE_SECONDS + 1e-6, f"drives on a reference that counts as {counted:.3f} s old"
            assert age <= STALE_SECONDS + delay + late, f"drives on a reference of {age:.3f} s ago"
        return received

    def share_of_driving(self, records):
        """Of the ticks at which stick_that_drives_again() was pushed, by the number of the newest reference. After a late reference the
        chair stands still until the stick was released."""
        speed = {one["tick"]: one["speed"] for one in self.joystick.records()}
        pushed = [one for one in records if speed.get(one["reference_sequence"], 0) > 0]
        return sum(one["state"] == RUN for one in pushed) / max(1, len(pushed))
