#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the Debian packages of a built tree and checks them.   check_packages.py BUILD FOLDER

Exit code 77 (skipped) where a program that packages need is not installed.
"""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys

PACKAGES = {"libtandem-opros", "libtandem-rtm", "tandem-bench", "tandem-opros-dev", "tandem-rtm-dev", "tandem-runtime",
            "tandem-tools"}
# What a package must depend on besides what dpkg-shlibdeps finds. Own packages fit the same version only.
NEEDS = {
    "libtandem-opros": ["libstdc++6 (>= "],
    "libtandem-rtm": ["libomniorb4-"],
    "tandem-bench": ["tandem-tools (= VERSION)"],
    "tandem-runtime": ["libtandem-opros (= VERSION)", "libtandem-rtm (= VERSION)", "libpugixml1v5", "adduser", "acl"],
    "tandem-tools": ["tandem-runtime (= VERSION)", "libsystemd0"],
    "tandem-opros-dev": ["libtandem-opros (= VERSION)", "tandem-tools (= VERSION)", "g++", "cmake", "make"],
    "tandem-rtm-dev": ["libtandem-rtm (= VERSION)", "tandem-tools (= VERSION)", "libomniorb4-dev", "omniidl", "python3"],
}
HIDDEN = {"tandem rtm requests"}  # for the monitor; no help names it
problems = []


def expect(holds, what):
    if not holds:
        problems.append(what)


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                          stdin=subprocess.DEVNULL, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def make_packages(build, folder):
    for program in ("help2man", "file", "dpkg-shlibdeps", "dpkg-deb"):
        if not shutil.which(program):
            print(f"skipped: {program} is not installed (group [packages] of apps/dependencies.txt)")
            sys.exit(77)
    shutil.rmtree(folder, ignore_errors=True)
    run("cpack", "-G", "DEB", "-B", str(folder), "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", cwd=build)
    packages = {run("dpkg-deb", "-f", deb, "Package").strip(): deb for deb in folder.glob("*.deb")}
    for name, deb in packages.items():
        expect(deb.name.startswith("tandem"), f"{name} is in {deb.name}, which `apt install ./tandem*.deb` does not find")
    return packages


def check_dependencies(name, deb):
    version = run("dpkg-deb", "-f", deb, "Version").strip()
    depends = run("dpkg-deb", "-f", deb, "Depends").strip().split(", ")
    for need in NEEDS[name]:
        need = need.replace("VERSION", version)
        expect(any(one.startswith(need) for one in depends), f"{name} does not depend on {need}, only on {depends}")


def check_pages(name, files):
    for program in (file for file in files if file.startswith("usr/bin/")):
        page = f"usr/share/man/man1/{pathlib.Path(program).name}.1.gz"
        expect(page in files, f"{name} has {program} without {page}")


def check_tree(root):
    """All packages unpacked into one folder."""
    for file in [*(root / "usr/bin").iterdir(), *(root / "usr/lib").rglob("*.so")]:
        with open(file, "rb") as opened:
            if opened.read(4) != b"\x7fELF":
                continue
        dynamic = run("readelf", "-d", file)
        expect("RUNPATH" not in dynamic and "RPATH" not in dynamic, f"{file} has a run path")
    pages = root / "usr/share/man/man1"
    completion = (root / "usr/share/bash-completion/completions/tandem").read_text(encoding="utf-8")
    commands = re.findall(r"^        '(tandem[^']*)'\) options=", completion, re.MULTILINE)
    expect(len(commands) > 30, f"the completion knows only {commands}")
    for command in set(commands) - HIDDEN:
        page = command.replace(" ", "-")
        text = gzip.open(pages / f"{page}.1.gz", "rt", encoding="utf-8").read() if (pages / f"{page}.1.gz").exists() else ""
        expect(f"{page} ".replace("-", "\\-") + "\\- " in text, f"{command} has no man page whose NAME is {page}")
        has_commands = any(other.startswith(command + " ") for other in commands)
        expect(has_commands or command in HIDDEN or ".SH EXAMPLES" in text, f"the man page of {command} has no examples")
        expect("part of Tandem" not in text, f"the man page of {command} has no summary")
    for program in ("opros_host", "rtm_host", "wheelchair"):
        text = gzip.open(pages / f"{program}.1.gz", "rt", encoding="utf-8").read()
        expect(".SH EXAMPLES" in text, f"the man page of {program} has no examples")
    for script in root.glob("*.control/*"):
        if script.name in ("postinst", "postrm", "prerm"):
            run("sh", "-n", script)


def check_documentation(root):
    """Pages that programs and other pages name are there."""
    pages = root / "usr/share/doc/tandem"
    expect((pages / "docs/tutorial.md").exists(), "the documentation is not installed")
    for text in (root / "usr/share/man/man1").glob("tandem*.1.gz"):
        named = gzip.open(text, "rt", encoding="utf-8").read().replace("\\-", "-")
        for page in re.findall(r"\bshare/doc/tandem/([\w./-]+\w)", named):
            expect((pages / page).exists(), f"the man page {text.name} names {page}, which is not installed")
    for page in ("README.md", "SECURITY.md", *(f"docs/{each.name}" for each in (pages / "docs").glob("*.md"))):
        text = (pages / page).read_text(encoding="utf-8") if (pages / page).exists() else ""
        for link in re.findall(r"\]\(([^)\s#]+)", text):
            file = (pages / page).parent / link
            if "://" not in link and file.suffix in (".md", ".svg", ".png", ".csv"): # others are in the source tree
                expect(file.exists(), f"{page} links to {link}, which is not installed")


def check_unit(root):
    if not shutil.which("systemd-analyze"):
        print("systemd-analyze is not installed: the service is not checked")
        return
    unit = root / "lib/systemd/system/tandem@.service"
    text = unit.read_text(encoding="utf-8")
    expect("\nUser=tandem\n" in text, "the service does not run as the user tandem")
    head, service = text.split("\n[Service]\n")
    expect("\nStartLimitIntervalSec=0\n" in head, "systemd gives up a service that has failed five times")
    expect(int(re.search(r"^RestartSec=(\d+)$", service, re.MULTILINE)[1]) >= 5, "a service that fails is started too often")
    unit.write_text(text.replace("ExecStart=/usr", f"ExecStart={root}/usr"), encoding="utf-8")
    said = run("systemd-analyze", "verify", "--man=no", "--recursive-errors=no", unit)
    expect("tandem@" not in said, said)


def check_run(root):
    environment = {**os.environ, "LD_LIBRARY_PATH": f"{root}/usr/lib", "PATH": f"{root}/usr/bin:{os.environ['PATH']}"}
    said = run("timeout", "100", "wheelchair", "--lockstep", env=environment, cwd=root)
    expect("mixed step20: 1001 ticks" in said, f"the wheelchair of the packages: {said}")


def check_lintian(debs):
    if int(os.environ.get("TANDEM_STRESS") or 1) < 2 or not shutil.which("lintian"):
        print("lintian, which takes as long as all the rest, runs with TANDEM_STRESS=2 where it is installed")
        return
    done = subprocess.run(["lintian", "--allow-root", "--fail-on", "error,warning", *debs], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, check=False)
    expect(done.returncode == 0, f"lintian: {done.stdout}")


def main():
    build, folder = map(pathlib.Path, sys.argv[1:])
    debs = make_packages(build, folder)
    expect(set(debs) == PACKAGES, f"packages: {sorted(debs)}")
    owner = {}
    root = folder / "root"
    for name, deb in sorted(debs.items()):
        check_dependencies(name, deb)
        run("dpkg-deb", "-x", deb, root)
        run("dpkg-deb", "-e", deb, root / f"{name}.control")
        listed = (line.split()[5] for line in run("dpkg-deb", "-c", deb).splitlines() if not line.startswith("d"))
        files = {file.removeprefix("./") for file in listed}
        check_pages(name, files)
        for file in files:
            expect(file not in owner, f"{file} is in {name} and in {owner.get(file)}")
            owner[file] = name
    check_tree(root)
    check_documentation(root)
    check_run(root)
    check_unit(root)
    check_lintian(debs.values())
    print("\n".join(problems))
    shutil.rmtree(root)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
