# SPDX-License-Identifier: Apache-2.0
"""Two machines on this one: each with a network, a /dev/shm and a monotonic clock of its own, joined by a cable. Both have the
same host name, as two boards with one image have."""
import atexit
import ctypes
import os
import pathlib
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
SKIPPED = 77
os.environ.pop("XDG_RUNTIME_DIR", None)  # the folder of this machine
PATIENCE = float(os.environ.get("TANDEM_PATIENCE", 120))  # s; nothing that works takes nearly as long
libc = ctypes.CDLL(None)


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def die_with_parent():
    libc.prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def enter_user_namespace():
    """Root of a user namespace may make network namespaces; others may not."""
    if os.geteuid() == 0:
        return
    if os.environ.get("TANDEM_MACHINES_INSIDE") or subprocess.run(["unshare", "-r", "true"], check=False,
                                                                  stderr=subprocess.DEVNULL).returncode != 0:
        skip("this user may not make user and network namespaces")
    os.environ["TANDEM_MACHINES_INSIDE"] = "1"
    os.execvp("unshare", ["unshare", "-r", sys.executable, "-B", *sys.argv])


def wait_until(condition, what, seconds=None):
    deadline = time.monotonic() + (seconds or PATIENCE)
    while time.monotonic() < deadline:
        found = condition()
        if found:
            return found
        time.sleep(0.02)
    raise AssertionError(f"not within {seconds or PATIENCE:g} s: {what}")


class Namespace:
    """Kept by a process that sleeps. clock: seconds by which CLOCK_MONOTONIC is ahead of this machine's."""

    def __init__(self, clock=0):
        # Not --kill-child: it would be this process's child that is killed, not the namespace's.
        time_namespace = ["--time", "--monotonic", str(clock), "--boottime", str(clock)] if clock else []
        self.holder = subprocess.Popen(
            ["unshare", "-n", "-m", *time_namespace, "--fork", "--kill-child", "sh", "-c",
             "mount -t tmpfs -o mode=1777 tmpfs /dev/shm && if [ -d /run/user ]; then mount -t tmpfs tmpfs /run/user; fi && ip link set lo up && echo $$ && exec sleep 100000"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=die_with_parent)
        self.pid = self.holder.stdout.readline().strip()
        if not self.pid:
            skip("network namespaces are not permitted: " + self.holder.stderr.readline().strip())
        self.enter = ["nsenter", "-t", self.pid, "-n", "-m"] + (["-T"] if clock else [])
        atexit.register(self.holder.kill)

    def start(self, command, **options):
        return subprocess.Popen([*self.enter, *map(str, command)], text=True, preexec_fn=die_with_parent, **options)

    def run(self, command, check=True):
        done = subprocess.run([*self.enter, *map(str, command)], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False, timeout=PATIENCE)
        if check and done.returncode != 0:
            raise AssertionError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}")
        return done.stdout if check else done


class Machine(Namespace):
    """Has the interface eth0 with the addresses 10.77.0.NUMBER and fd77::NUMBER."""

    def __init__(self, number, clock=0):
        super().__init__(clock)
        self.address, self.address6 = f"10.77.0.{number}", f"fd77::{number}"

    def configure(self):
        run = self.run
        # Addresses of IPv6 go with the link otherwise, and their check for duplicates takes a second.
        for setting in ("keep_addr_on_down=1", "accept_dad=0", "dad_transmits=0"):
            name, value = setting.split("=")
            run(["sh", "-c", f"echo {value} > /proc/sys/net/ipv6/conf/eth0/{name} || true"])
        run([sys.executable, HERE / "no_offload.py", "eth0"])
        run(["ip", "addr", "add", f"{self.address}/24", "dev", "eth0"])
        run(["ip", "addr", "add", f"{self.address6}/64", "dev", "eth0"], check=False)
        run(["ip", "link", "set", "eth0", "up"])

    def link(self, state):
        """What `ip link set down` and `up` do to the network interface."""
        self.run(["ip", "link", "set", "eth0", state])


class Cable:
    """Joins two machines, with two interfaces of a network in between, or directly."""

    def __init__(self, one, other, direct=False):
        self.process = None
        if direct:
            one.run(["ip", "link", "add", "eth0", "type", "veth", "peer", "name", "eth0", "netns", other.pid])
        else:
            self.wire = Namespace()
            for machine, end in ((one, "left"), (other, "right")):
                self.wire.run(["ip", "link", "add", end, "type", "veth", "peer", "name", "eth0", "netns", machine.pid])
                self.wire.run([sys.executable, HERE / "no_offload.py", end])
                self.wire.run(["ip", "link", "set", end, "up"])
            self.process = self.wire.start([sys.executable, HERE / "cable.py", "left", "right"],
                                           stdin=subprocess.PIPE, stdout=subprocess.PIPE)
            atexit.register(self.process.kill)
            self.process.stdout.readline()
        for machine in (one, other):
            machine.configure()

    def tell(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        self.process.stdout.readline()

    def set(self, delay_ms=0.0, jitter_ms=0.0, loss=0.0):
        self.tell(f"delay {delay_ms} {jitter_ms} {loss}")

    def pull(self):
        self.tell("down")

    def plug(self):
        self.tell("up")
