#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of a page of documentation that pages.py names, in order, in one bash in an empty folder, and compares what
each block prints with what the page shows behind it: each line must come, in this order; `...` stands for anything.
Usage: run_page.py ROOT PAGE BIN [SECONDS]"""
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import tempfile

from page import Block, blocks
from pages import console_parts, is_run, is_whole

MARK = "@@block "


def script_of(parts):
    # -m: jobs as in a terminal, so that kill -INT is what Ctrl-C is. No command may fail unless the page says so.
    lines = ["set -emE -o pipefail", "trap 'echo \"@@failed: $BASH_COMMAND\"' ERR"]
    for number, (block, _) in enumerate(parts):
        lines += [f"echo '{MARK}{number}'"] + block.split()[0]
    return "\n".join(lines) + "\necho '" + MARK + "end'\n"


def until_shown(command, expected):
    """A host runs until the page's last line of its output has come, then gets Ctrl-C."""
    last = [line for _, line in expected if line.strip()][-1]
    return [f"{command} &> host.log &", "pid=$!", "for i in {1..300}; do grep -qF -- " + shlex.quote(last) +
            " host.log && break; sleep 0.1; done", "kill -INT $pid", "wait $pid", "cat host.log"]


def parts_of(root, page):
    """Each block of commands that is to be run, with the lines that the page shows of its output."""
    found = []
    for block in blocks(root, page):
        if any(line.startswith("$ ") and is_run(block, line) for line in block.lines):
            for number, command, expected in console_parts(block):
                lines = until_shown(command, expected) if command.split()[0] in ("opros_host", "rtm_host") else [command]
                found.append((Block(page, number, "sh", lines), expected))
        elif block.language == "sh" and any(is_run(block, line) for line in block.lines):
            lines = block.lines if is_whole(block) else [line for line in block.lines if is_run(block, line)]
            found.append((Block(page, block.line, "sh", lines), []))
        elif block.language == "" and found and not found[-1][1] and not block.lines[0].startswith("$ "):
            found[-1][1].extend(enumerate(block.lines, block.line))
    return found


def matches(expected, line):
    """Runs of blanks count as one: columns are as wide as their widest cell."""
    parts = " ".join(expected.split()).split("...")
    return re.fullmatch(".*".join(re.escape(part) for part in parts), " ".join(line.split())) is not None


def missing(expected, output):
    """The first expected line that did not come, and its number; None if all came."""
    rest = iter(output)
    for number, line in expected:
        if line.strip() in ("", "..."):
            continue
        if not any(matches(line, each) for each in rest):
            return number, line
    return None


def run(script, folder, bin_dir, seconds):
    environment = dict(os.environ, PATH=f"{bin_dir}:{os.environ['PATH']}", LC_ALL="C.UTF-8")
    output = pathlib.Path(folder).parent / "output"
    with open(output, "w") as out:
        shell = subprocess.Popen(["bash", "--norc", "-c", script], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                 stdout=out, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            code = shell.wait(seconds)
        except subprocess.TimeoutExpired:
            code = f"none within {seconds} s"
        end_session(shell.pid)
        shell.wait()
    return code, output.read_text(errors="replace")


def end_session(session):
    """Jobs have process groups of their own, but the session is theirs and nobody else's."""
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and os.getsid(int(entry.name)) == session:
                os.kill(int(entry.name), signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            continue


def check(parts, code, text):
    outputs = {int(part.split("\n", 1)[0]): part.split("\n")[1:] for part in text.split(MARK)[1:] if part[0].isdigit()}
    for number, (block, expected) in enumerate(parts):
        output = outputs.get(number)
        if output is None:
            return f"{block.where()}: not reached"
        if failed := [line for line in output if line.startswith("@@failed")]:
            return f"{block.where()}: a command failed{failed[0][8:]}\n" + "\n".join(output)
        if number == max(outputs) and code != 0:
            return f"{block.where()}: the page ended here with exit code {code}\n" + "\n".join(output)
        if lost := missing(expected, output):
            return f"{block.page}:{lost[0]}: not printed: {lost[1]}\n" + "\n".join(output)
    return ""


def main(root, page, bin_dir, seconds="240"):
    parts = parts_of(root, page)
    if not parts:
        print(f"{page}: has no command of those that tests/documentation/pages.py says to run")
        return 1
    with tempfile.TemporaryDirectory(prefix="tandem-page-") as scratch:
        folder = pathlib.Path(scratch) / "here"
        folder.mkdir()
        code, text = run(script_of(parts), folder, bin_dir, float(seconds))
    for block, _ in parts:
        _, left, reason = block.split()
        if left:
            print(f"{block.where()}: not run, {reason}: {'; '.join(left)}")
    error = check(parts, code, text)
    print(error or f"{page}: {len(parts)} blocks were run")
    return 1 if error else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
