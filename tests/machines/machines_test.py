#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs one case on two machines that are network namespaces.   machines_test.py CASE BUILD

TANDEM_ROUNDS=N repeats what a case repeats N times, TANDEM_NETWORK="DELAY JITTER LOSS" is the network before a cut, or the bad one;
figures of each run are printed. Exit code 77 (skipped) where namespaces are not permitted.
"""
import itertools
import os
import re
import shutil
import signal
import subprocess
import sys
import time

from machines import HERE, PATIENCE, enter_user_namespace, skip, wait_until
from pairs import STALE, Pair, Wheelchair

ROUNDS = int(os.environ.get("TANDEM_ROUNDS", 0))
NETWORK = [float(word) for word in os.environ.get("TANDEM_NETWORK", "").split()]  # cable.py's delay, before each cut


def wheelchair_drives(build, kind=Wheelchair):
    pair = kind(build)
    pair.connect()
    wait_until(pair.drives, "the chair drives")
    pair.check_references(pair.control.records())
    return pair


def wheelchair_stops(build, kind=Wheelchair):
    pair = wheelchair_drives(build, kind)
    stops, ticks, returns = [], [], []
    for number in range(ROUNDS or 2):
        pair.cable.set()
        wait_until(pair.drives, "the chair drives")
        start = pair.control.size() - 20
        if NETWORK:
            pair.cable.set(*NETWORK)
            time.sleep(0.1)
        by_interface = number % 2 == 0
        pair.a.link("down") if by_interface else pair.cable.pull()
        wait_until(lambda: (last := pair.control.records(pair.control.size() - 1)[0])["brake"] == 1
                   and last["references_received"] == 0, "ControlComp has stopped the motors")
        records = pair.control.records(start)
        last = max(i for i, one in enumerate(records) if one["references_received"] > 0)
        stale = next(i for i in range(last, len(records)) if records[i]["state"] == STALE)
        if stale > last:  # on a busy machine it may have been late already
            stops.append(records[stale]["time"] - records[last]["time"])
            ticks.append(stale - last)
        wait_until(lambda: (now := pair.hw.records(pair.hw.size() - 1)[0])["brake"] == 1 and now["volts_left"] == 0,
                   "HWComp has braked")
        time.sleep(number % 7 * 0.4)
        size, again = pair.control.size(), time.monotonic()
        pair.a.link("up") if by_interface else pair.cable.plug()
        wait_until(lambda: any(one["references_received"] > 0 for one in pair.control.records(size)),
                   "references come again")
        returns.append(next(one["at"] for one in pair.control.records(size) if one["references_received"] > 0) - again)
    pair.cable.set()
    wait_until(pair.drives, "the chair drives")
    pair.check_references(pair.control.records(), NETWORK[0] / 1000 if NETWORK else 0)
    print(f"{len(returns)} cuts, {len(stops)} while it drove: ControlComp slows down {min(ticks, default=0)} to "
          f"{max(ticks, default=0)} of its ticks after the last reference, {1e3 * max(stops, default=0):.1f} ms at most; references again {1e3 * min(returns):.0f} to {1e3 * max(returns):.0f} ms "
          f"(median {1e3 * sorted(returns)[len(returns) // 2]:.0f}) after the cable")
    return pair


def wheelchair_bad_network(build):
    pair = Wheelchair(build)
    pair.connect()
    wait_until(pair.drives, "the chair drives")
    for delay, jitter, loss in (NETWORK,) if NETWORK else ((1, 1, 0.0), (5, 5, 0.01), (0, 50, 0.01)):
        pair.cable.set(delay, jitter, loss)
        start = pair.control.size()
        wait_until(lambda: pair.control.size() > start + (ROUNDS * 100 or 300), "ticks", ROUNDS + PATIENCE)
        records = pair.control.records(start)
        received = pair.check_references(records, delay / 1000)
        stale = sum(one["state"] == STALE for one in records)
        halts = sum(one["state"] == STALE != before["state"] for before, one in itertools.pairwise(records))
        print(f"delay {delay} to {delay + jitter} ms, loss {loss:.0%}: {received:.0f} references in {len(records)} ticks, "
              f"{stale} ticks STALE after {halts} late references; {pair.share_of_driving(records):.0%} of the time in which the "
              f"stick was pushed it drove", flush=True)
        assert received > 0
    pair.cable.set()
    wait_until(pair.drives, "the chair drives again")
    pair.check_references(pair.control.records(), 0.005)
    return pair


def wheelchair_killed(build):
    """Each host in turn is killed and started again by tandem run; the script that connected them does it again."""
    pair = Wheelchair(build)
    pair.connect()
    for name, host in (("a", "rtm_host"), ("a", "opros_host"), ("b", "rtm_host"), ("b", "opros_host")):
        wait_until(pair.drives, "the chair drives")
        size, ready = pair.control.size(), pair.log(name).count(f"{host} started")
        pair.kill_child(name, host)
        if (name, host) != ("b", "opros_host"):  # with which ControlComp and HWComp have gone
            wait_until(lambda: any(one["brake"] == 1 and one["references_received"] == 0
                                   for one in pair.control.records(size)), "ControlComp has stopped the motors")
        wait_until(lambda: pair.log(name).count(f"{host} started") > ready, f"{host} is started again")
        wait_until(lambda: pair.connect(check=False).returncode == 0, "connected again")
    wait_until(pair.drives, "the chair drives")
    return pair


CUTS = (3.0, 3.6, 4.0, 4.4)  # s: about those after which the network is back while the sender connects again


def sequence(build, *properties):
    pair = Pair(build)
    pair.start_counting()
    pair.rtm("connect", f"rtcloc://{pair.a.address}/CountOut0:out", f"rtcloc://{pair.b.address}/CountIn0:in", *properties)
    pair.wait_for_more()
    for number in range(ROUNDS or 2):
        cut = CUTS[(number + number // 4) % 4]
        pair.a.link("down") if number % 2 else pair.cable.pull()
        time.sleep(cut)
        pair.a.link("up") if number % 2 else pair.cable.plug()
        pair.wait_for_more()
        pair.hosts["b"].send_signal(signal.SIGSTOP)  # what has come is in its kernel, and is read later
        time.sleep(cut)
        pair.hosts["b"].send_signal(signal.SIGCONT)
        pair.wait_for_more()
    pair.cable.set(0, 20, 0.02)
    pair.wait_for_more(100)
    pair.cable.set()
    pair.wait_for_more()
    received = pair.expect_in_order()
    pair.rtm("deactivate", f"rtcloc://{pair.a.address}/CountOut0")
    longest = int(re.search(r"longest write (\d+)", (pair.folder / "out").read_text())[1]) * 1e-9
    assert longest < CUTS[0] / 2, f"a write took {longest:.1f} s, of a cycle that must not wait for the network"
    print(f"{len(received)} of {received[-1]} numbers in order; the longest write took {1e3 * longest:.2f} ms")
    return pair


def sequence_new(build):
    return sequence(build, "-p", "subscription_type=new")


def overlap(build):
    """Where the newest value counts, a message does not wait for the answer to the one before."""
    pair = Pair(build)
    pair.start_counting()
    pair.rtm("connect", f"rtcloc://{pair.a.address}/CountOut0:out", f"rtcloc://{pair.b.address}/CountIn0:in", "-p",
             "subscription_type=new")
    pair.wait_for_more()
    pair.cable.set(50)  # 100 ms there and back, in which ten messages are written
    pair.wait_for_more(50)  # meanwhile connections are made
    first = len(pair.numbers("in"))
    pair.wait_for_more(100)
    received = pair.expect_in_order()[first:]
    share = len(received) / (received[-1] - received[0] + 1)
    assert share > 0.5, f"{share:.0%} of the messages came: one for each round trip would be 10 %"
    print(f"{share:.0%} of the messages came")
    return pair


def hang(build):
    """A process that hangs for longer than a call waits is lost, and when it continues nothing comes twice or out of order."""
    pair = Pair(build)
    pair.start_counting()
    ends = [f"rtcloc://{pair.a.address}/CountOut0:out", f"rtcloc://{pair.b.address}/CountIn0:in"]
    for lost, subscription in enumerate(("new", "flush"), 1):
        pair.rtm("connect", *ends, "-p", f"subscription_type={subscription}")
        pair.wait_for_more()
        pair.hosts["b"].send_signal(signal.SIGSTOP)
        wait_until(lambda: pair.log("a").count("is gone") == lost, "the connection is lost")
        pair.hosts["b"].send_signal(signal.SIGCONT)
        pair.rtm("connect", *ends)
        pair.wait_for_more()
        pair.rtm("disconnect", *ends)
    received = pair.expect_in_order()
    pair.rtm("deactivate", f"rtcloc://{pair.a.address}/CountOut0")
    longest = int(re.search(r"longest write (\d+)", (pair.folder / "out").read_text())[1]) * 1e-9
    assert longest < CUTS[0] / 2, f"a write took {longest:.1f} s, of a cycle that must not wait for the network"
    print(f"{len(received)} of {received[-1]} numbers in order; the longest write took {1e3 * longest:.2f} ms")
    return pair


def restart(build):
    """An entry of preconnect on one machine makes the connection again, whichever host was killed."""
    pair = Pair(build)
    pair.start_count("CountOut")
    incoming = (f"manager.components.preconnect: CountIn0.in?port=rtcloc://{pair.a.address}/CountOut0.out\n"
                "manager.peer_check_interval: 0.5\n")
    pair.start_count("CountIn", incoming)
    pair.wait_for_more()
    pair.kill("b")
    pair.wait_for_log("a", "is gone")
    pair.start_count("CountIn", incoming)
    pair.wait_for_more()
    pair.expect_in_order()
    pair.kill("a")
    pair.wait_for_log("b", "is gone")
    (pair.folder / "in").write_text("")  # the numbers start again
    pair.start_count("CountOut")
    pair.wait_for_more()
    pair.expect_in_order()
    return pair


def naming(build):
    """Names are back with a name server that has forgotten all, and data do not need it."""
    if not shutil.which("omniNames"):
        skip("omniNames (omniorb-nameserver) is not installed")
    pair = Pair(build)

    def start_name_server(life):
        (pair.folder / f"names{life}").mkdir()
        pair.hosts["names"] = pair.b.start(
            ["omniNames", "-start", "2809", "-logdir", pair.folder / f"names{life}", "-errlog", pair.folder / "names.log",
             "-ORBendPoint", f"giop:tcp:{pair.b.address}:2809"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    lines = (f"naming.enable: YES\ncorba.nameservers: {pair.b.address}:2809\nnaming.formats: %n.rtc\n"
             "naming.update.interval: 0.5\nnaming.update.rebind: YES\n")
    start_name_server(1)
    pair.start_counting(lines, lines)
    server = f"rtcname://{pair.b.address}"
    both = lambda: all(pair.rtm("info", f"{server}/{name}0.rtc", check=False).returncode == 0
                       for name in ("CountOut", "CountIn"))
    wait_until(both, "both have names")
    pair.rtm("connect", f"{server}/CountOut0.rtc:out", f"{server}/CountIn0.rtc:in")
    pair.wait_for_more()
    pair.hosts.pop("names").kill()
    pair.wait_for_more(100)
    start_name_server(2)
    wait_until(both, "both have names again")
    pair.wait_for_more()
    pair.expect_in_order()
    pair.hosts.pop("names").kill()
    return pair


def tcp_ends(machine):
    """Local and remote `ADDRESS:PORT` of each TCP socket of a machine, and whether it listens."""
    lines = machine.run(["ss", "-tanH"]).splitlines()
    return [(words[0] == "LISTEN", words[3], words[4]) for words in map(str.split, lines)]


def ports(build):
    """A firewall may let through one port of each machine alone."""
    if not shutil.which("ss"):
        skip("ss (iproute2) is not installed")
    pair = Pair(build)
    pair.start_counting(endpoints=(f"{pair.a.address}:4001", f"{pair.b.address}:4002"))
    a, b = f"{pair.a.address}:4001", f"{pair.b.address}:4002"
    pair.rtm("connect", f"rtcloc://{a}/CountOut0:out", f"rtcloc://{b}/CountIn0:in")
    pair.wait_for_more()
    for machine, own in ((pair.a, a), (pair.b, b)):
        ends = tcp_ends(machine)
        assert [local for listens, local, _ in ends if listens] == [own], ends
        wrong = [end for end in ends if not end[0] and not {a, b} & set(end[1:])]
        assert not wrong, f"connections that use neither {a} nor {b}: {wrong}"
    return pair


def ipv6(build):
    pair = Pair(build)
    if "fd77::1" not in pair.a.run(["ip", "-6", "addr"]):
        skip("there is no IPv6")
    pair.start_counting(endpoints=(f"[{pair.a.address6}]:2810", f"[{pair.b.address6}]:2810"))
    pair.rtm("connect", f"rtcloc://[{pair.a.address6}]/CountOut0:out", f"rtcloc://[{pair.b.address6}]:2810/CountIn0:in")
    pair.wait_for_more()
    pair.a.link("down")
    time.sleep(1)
    pair.a.link("up")
    pair.wait_for_more()
    pair.expect_in_order()
    return pair


def host_names(build):
    pair = Pair(build)
    names = pair.folder / "hosts"
    names.write_text(f"127.0.0.1 localhost\n{pair.a.address} front\n{pair.b.address} chair\n")
    for machine in (pair.a, pair.b):
        machine.run(["mount", "--bind", names, "/etc/hosts"])
    pair.start_counting(endpoints=("front:2810", "chair:2810"))
    pair.rtm("connect", "rtcloc://front/CountOut0:out", "rtcloc://chair/CountIn0:in")
    pair.wait_for_more()
    pair.expect_in_order()
    return pair


def tools(build):
    """Tools with ports of their own reach components of another machine by --endpoint."""
    pair = Pair(build)
    pair.start_count("CountOut")
    pair.start_count("CountIn")
    here, there = f"rtcloc://{pair.a.address}/CountOut0", f"rtcloc://{pair.b.address}/CountIn0"
    pair.rtm("connect", f"{here}:out", f"{there}:in")
    lines = pair.rtm("cat", f"{there}:out", "-n", "5", "--endpoint", pair.a.address).splitlines()
    assert len(lines) == 5 and all('"data"' in line for line in lines), lines
    pair.rtm("disconnect", f"{here}:out", f"{there}:in")
    pair.rtm("inject", f"{there}:in", "123456789", "--endpoint", pair.a.address)
    wait_until(lambda: pair.numbers("in")[-1][0] == 123456789, "the number that was injected")
    return pair


def rights(build):
    """Another machine can do nothing unless rtc.conf permits it to connect. It then drives components, but neither loads code
    nor ends anything unless rtc.conf permits this, too."""
    def ask(*arguments):
        return pair.a.run([sys.executable, HERE / "send_request.py", pair.b.address, *arguments]).strip()

    pair = Pair(build)
    for permitted in "", "corba.permitted_hosts: 10.77.0.2, 10.78.0.0/16, fd77::/64\n":
        pair.start_count("CountIn", permitted=permitted)
        there = f"rtcloc://{pair.b.address}/CountIn0"
        for command in ("info", "deactivate", "exit"):
            assert pair.rtm(command, there, check=False).returncode != 0, command
        pair.wait_for_log("b", f"it comes from another machine at giop:tcp:{pair.a.address}:")
        pair.kill("b")
    pair.start_count("CountIn")
    there = f"rtcloc://{pair.b.address}/CountIn0"
    pair.rtm("deactivate", there)
    pair.rtm("activate", there)
    for operation, *texts in (("load_module", "/dev/null", ""), ("unload_module", "x"), ("delete_component", "CountIn0"),
                              ("set_configuration", "manager.modules.load_path", "/tmp"), ("restart",), ("shutdown",)):
        assert ask(operation, *texts) == "NO_PERMISSION", operation
    assert ask("create_component", "/tmp/CountIn") == "None" and ask("get_profile") == "None"
    done = pair.rtm("exit", there, check=False)
    assert done.returncode == 1 and "its process does not permit it" in done.stdout, done.stdout
    assert "ACTIVE" in pair.rtm("info", there)
    pair.wait_for_log("b", "refused load_module by another machine")
    pair.kill("b")
    pair.start_count("CountIn", "manager.remote_shutdown: YES\nmanager.modules.remote_load: YES\n")
    assert ask("load_module", "/dev/null", "") == "None"
    pair.rtm("exit", there)
    assert ask("shutdown") == "None"
    assert pair.hosts.pop("b").wait(60) == 0
    return pair


def make_certificates(folder):
    """An authority, and of each name a file with a key and a certificate by it; of `stranger` by another authority."""
    def openssl(*arguments):
        subprocess.run(["openssl", *map(str, arguments)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       cwd=folder)

    for authority, names in (("authority", ("a", "b", "tool")), ("other", ("stranger",))):
        openssl("req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={authority}", "-days", "2", "-keyout",
                f"{authority}.key", "-out", f"{authority}.pem")
        for name in names:
            openssl("req", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={name}", "-keyout", f"{name}.key", "-out",
                    f"{name}.csr")
            openssl("x509", "-req", "-in", f"{name}.csr", "-CA", f"{authority}.pem", "-CAkey", f"{authority}.key",
                    "-CAcreateserial", "-days", "2", "-out", f"{name}.crt")
            (folder / f"{name}.pem").write_text((folder / f"{name}.key").read_text() + (folder / f"{name}.crt").read_text())


def tls(build):
    if not shutil.which("openssl"):
        skip("openssl is not installed")
    pair = Pair(build)
    make_certificates(pair.folder)
    lines = [f"corba.ssl.certificate_authority_file: {pair.folder}/authority.pem\n"
             f"corba.ssl.key_file: {pair.folder}/{name}.pem\n" for name in ("a", "b")]
    pair.start_counting(*lines, permitted="")  # a certificate suffices
    ends = [f"rtcloc://{pair.a.address}/CountOut0:out", f"rtcloc://{pair.b.address}/CountIn0:in"]
    authority = f"--tls-authority={pair.folder}/authority.pem"
    for refused in ([], [f"--tls-authority={pair.folder}/other.pem", f"--tls-key={pair.folder}/stranger.pem"],
                    [authority, f"--tls-key={pair.folder}/stranger.pem"]):
        done = pair.rtm("connect", *ends, *refused, check=False)
        assert done.returncode == 1 and done.stdout.count("\n") == 1, f"{refused}: {done.returncode}\n{done.stdout}"
    assert not pair.numbers("in")
    pair.rtm("connect", *ends, authority, f"--tls-key={pair.folder}/tool.pem")
    pair.wait_for_more()
    pair.a.link("down")
    time.sleep(1)
    pair.a.link("up")
    pair.wait_for_more()
    pair.expect_in_order()
    plain = [end for end in tcp_ends(pair.b) if end[0]] if shutil.which("ss") else []
    assert len(plain) <= 1, plain
    wrong = pair.folder / "wrong.conf"
    wrong.write_text(f"{lines[0]}corba.endpoints: {pair.a.address}:2811, giop:tcp:{pair.a.address}:2812\n")
    done = pair.a.run([pair.build / "bin/rtm_host", "-f", wrong], check=False)
    assert done.returncode == 1 and done.stdout.count("\n") == 1, done.stdout
    assert f"corba.endpoints: giop:tcp:{pair.a.address}:2812" in done.stdout, done.stdout
    wrong.write_text("corba.ssl.certificate_authority_file: /none.pem\ncorba.ssl.key_file: /none.pem\n")
    done = pair.a.run([pair.build / "bin/rtm_host", "-f", wrong], check=False)
    assert done.returncode != 0 and "/none.pem" in done.stdout, done.stdout
    return pair


def latency(build):
    """CORBA between two rtm_hosts beside plain TCP in the same run; not a test of anything but that both are measured."""
    for direct in (True, False):
        pair = Pair(build, direct=direct)
        if not direct:
            pair.cable.set(1)
        pair.start_count("CountIn", settings_more="conf.default.tcp_port: 5001\n")
        pair.start_count("CountOut", settings_more=f"conf.default.tcp_peer: {pair.b.address}:5001\n")
        out, incoming = f"rtcloc://{pair.a.address}/CountOut0", f"rtcloc://{pair.b.address}/CountIn0"
        pair.rtm("connect", f"{out}:out", f"{incoming}:in")
        pair.rtm("connect", f"{incoming}:out", f"{out}:in")
        pair.wait_for_more(1000 if ROUNDS else 50)
        there_and_back = sorted(ns for _, ns in pair.numbers("out"))
        tcp = sorted(int(ns) for ns in re.findall(r"^tcp \d+ (\d+)$", (pair.folder / "out").read_text(), re.M))
        one_way = sorted(ns for _, ns in pair.numbers("in"))
        assert there_and_back and tcp
        p50, p99 = (lambda all: all[len(all) // 2] / 1e3), (lambda all: all[len(all) * 99 // 100] / 1e3)
        print(f"{'a cable' if direct else '1 ms of delay each way'}: there and back p50 / p99 [us]: "
              f"RTM {p50(there_and_back):.0f} / {p99(there_and_back):.0f}, TCP {p50(tcp):.0f} / {p99(tcp):.0f}; "
              f"added each way, p50: {(p50(there_and_back) - p50(tcp)) / 2:.0f}; one way, one clock: "
              f"{p50(one_way):.0f} / {p99(one_way):.0f}")
        if direct:
            pair.stop()
            pair.remove()
    return pair


CASES = {name: case for name, case in globals().items() if callable(case) and getattr(case, "__module__", "") == "__main__"}


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
