#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Goes through every command of the pages: a test runs it (pages.py), or its program, sub-command and options are looked up in the
program's help and it is named as not run (pages.py), or it is named here as not run. Anything else is an error.
Usage: check_commands.py ROOT BIN"""
import collections
import functools
import json
import pathlib
import re
import shlex
import subprocess
import sys

from page import NOT_RUN, blocks
from pages import LOOKED_UP, RUN, is_run, pages

OURS = {"tandem", "opros_host", "rtm_host", "wheelchair", "tandem-bench", "rtm-naming"}
# Programs of others, and why no test runs what the pages say of them.
NOT_RUN_HERE = {
    "changes the system": ["apt", "adduser", "sudo", "systemctl", "systemd-escape", "journalctl", "runuser", "modprobe", "sysctl", "usermod", "udevadm",
                           "lintian", "cpupower", "chrt", "setcap"],
    "needs a docker daemon": ["docker"],
    "measures for minutes, and has a test of its own (tests/apps/bench/interface_types_test.cpp)": ["apps/bench/interface_types/measure.py"],
    "draws what a reader has measured": ["apps/bench/report.py"],
    "needs another machine": ["ssh", "connect.sh"],
    "builds or tests the whole tree, as whoever runs this test has done": ["cmake", "ctest", "cpack", "tests/run.sh", "tests/lint.sh", "tests/arm64.sh",
                                                                       "apps/run-wheelchair.sh", "apps/bench/run.sh", ".ci/run",
                                                                       "clang-format", "git"],
    "is about a component of the reader's": ["gdb", "addr2line", "ln"],
    "belongs to the reader's shell": ["cd", "export", "taskset", "echo", "kill", "seq", "gnuplot"],
}
REASON = {program: reason for reason, programs in NOT_RUN_HERE.items() for program in programs}
# Scripts that give options of a program of ours to it.
PASSED_ON = {"apps/run-wheelchair.sh": "wheelchair", "apps/bench/run.sh": "tandem-bench"}
PUNCTUATION = set("();<>|&")
WORDS_OF_THE_SHELL = {"until", "while", "if", "then", "do", "done", "fi", "else", "!", "time"}


def simple_commands(text):
    """The simple commands of a line, each a list of words. `a|b|c` without blanks are alternatives, of which the first counts."""
    text = re.sub(r"(?<=\w)(\|\w+)+", "", text)
    lexer = shlex.shlex(text, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    commands, words, redirected = [], [], False
    for word in lexer:
        if set(word) <= PUNCTUATION:
            redirected = "<" in word or ">" in word
            if not redirected:
                commands.append(words)
                words = []
        elif redirected:
            redirected = False
        elif not (not words and (word in WORDS_OF_THE_SHELL or re.match(r"\w+=", word))):
            words.append(word)
    return [words for words in commands + [words] if words]


def joined_lines(lines):
    """The lines of a block, joined where one ends in a backslash, each with the index of its first line."""
    joined, first = "", 0
    for offset, line in enumerate(lines):
        first = offset if not joined else first
        joined += line.removesuffix("\\")
        if not line.endswith("\\"):
            yield first, joined
            joined = ""


class Programs:
    def __init__(self, root, bin_dir):
        self.root, self.bin_dir = pathlib.Path(root), pathlib.Path(bin_dir)

    @functools.cache
    def help(self, *command):
        result = subprocess.run([self.bin_dir / command[0], *command[1:], "--help"], capture_output=True, text=True, timeout=20,
                                stdin=subprocess.DEVNULL)
        return result.stdout if result.returncode == 0 else ""

    @functools.cache
    def subcommands(self, *command):
        _, found, names = self.help(*command).partition("Subcommands:\n")
        return re.findall(r"^  (\S+)", names.split("\n\n")[0], re.M) if found else []

    def error(self, words, may_be_part):
        """What is wrong with a command of ours; "" if its sub-command and options exist."""
        command, rest = [words[0]], list(words[1:])
        while known := self.subcommands(*command):
            if not rest or rest[0].startswith("-"):
                break
            # `shm list, info` in a sentence; names in capitals stand for any.
            name = rest.pop(0).rstrip(",.")
            if name not in known and f"Usage: {' '.join(command)} {name}" not in self.help(*command, name): # hidden ones
                return f"{' '.join(command)} has no sub-command {name}, but: {', '.join(known)}"
            command.append(name)
        if not may_be_part and self.subcommands(*command) and not rest:
            return f"{' '.join(command)} needs a sub-command"
        text = self.help(*command).partition("\nExamples:\n")[0]
        if not text: # a script without options
            return "" if not rest and (self.bin_dir / command[0]).is_file() else f"{' '.join(command)} --help fails"
        for word in rest:
            option = re.match(r"--?[a-zA-Z][\w-]*", word)
            if word.startswith("-") and option and not re.search(rf"(?<![\w-]){re.escape(option[0])}(?![\w-])", text):
                return f"{' '.join(command)} has no option {option[0]}"
        return ""

    def script_error(self, words):
        script = self.root / words[0]
        if not script.is_file():
            return f"there is no {words[0]}"
        known = script.read_text() + (self.help(PASSED_ON[words[0]]) if words[0] in PASSED_ON else "")
        lost = [word for word in words[1:] if word.startswith("--") and word.split("=")[0] not in known]
        return f"{words[0]} has no option {lost[0]}" if lost else ""

    def preset_error(self, words):
        presets = json.loads((self.root / "CMakePresets.json").read_text())
        names = {each["name"] for kind in presets.values() if isinstance(kind, list) for each in kind}
        lost = [value for flag, value in zip(words, words[1:]) if flag == "--preset" and value not in names]
        return f"there is no preset {lost[0]}" if lost else ""


def is_program_of_ours(words):
    return words[0].removeprefix("./").removeprefix("build/release/bin/") in OURS


class Check:
    def __init__(self, root, bin_dir):
        self.programs = Programs(root, bin_dir)
        self.count, self.not_run, self.errors = collections.Counter(), collections.defaultdict(set), []
        self.named = collections.defaultdict(list)

    def command(self, where, words, runs, may_be_part=False):
        program = words[0].removeprefix("./").removeprefix("build/release/bin/")
        error = ""
        if program in OURS:
            error = self.programs.error([program] + words[1:], may_be_part)
        elif runs:
            pass # what others' programs say is checked by running them
        elif program in REASON:
            if "/" in program:
                error = self.programs.script_error([program] + words[1:])
            elif program in ("cmake", "ctest"):
                error = self.programs.preset_error(words)
            self.not_run[REASON[program]].add(program)
        else:
            error = f"{program} is neither run nor named as not run (tests/documentation)"
        if error:
            self.errors.append(f"{where}: {error}: {' '.join(words)}")
        self.count["run" if runs else "only parsed" if program in OURS else "not run"] += 1

    def marked(self, block, lines, reason):
        for _, line in joined_lines(lines):
            for words in simple_commands(line):
                if words[0] in OURS:
                    self.command(block.where(), words, False)
                else:
                    self.count["not run"] += 1
        if lines:
            self.not_run[f"{reason} ({block.where()})"].add("the block")

    def block(self, block):
        # Blocks without a language are output, but for what is behind `$ `; indented ones may be anything.
        is_shell = block.language == "sh"
        lines, marked, reason = block.split()
        for offset, line in joined_lines(block.lines):
            if offset >= len(lines) or NOT_RUN.search(line):
                break
            if line.startswith("$ "):
                text = line[2:]
            elif is_shell or (block.language == "indented" and re.match(r"(build/release/bin/|apps/|tests/)?[\w./-]+( |$)", line) and
                              line.split()[0].split("/")[-1] in OURS | {"run.sh"}):
                text = line
            else:
                continue
            if re.search(r"(^|\s)%\d", text): # an interactive bash forgets the number of a job that has ended
                self.errors.append(f"{block.where(offset)}: a job's number, where $! was to be kept: {text}")
            for words in simple_commands(text):
                self.command(block.where(offset), words, is_run(block, line))
                if is_program_of_ours(words) and not is_run(block, line):
                    self.named[block.page].append(f"{block.where(offset)}: {' '.join(words)}")
        self.marked(block, marked, reason)

    def name_not_run(self):
        """Prints the commands of blocks that are only looked up, with the reason, which each such page must have, and no other."""
        for page, commands in self.named.items():
            if page not in LOOKED_UP:
                self.errors += [f"{command}: neither run nor named as not run (LOOKED_UP in tests/documentation/pages.py)" for command in commands]
            print("\n".join(f"not run, {LOOKED_UP.get(page, 'without a reason')}: {command}" for command in commands))
        self.errors += [f"{page} is named as not run, but has no such command" for page in LOOKED_UP if page not in self.named]

    def sentences(self, root, page):
        """Commands of ours in backquotes in the text, in tables and lists too."""
        text, fence = [], False
        for line in (pathlib.Path(root) / page).read_text().splitlines():
            fence ^= line.lstrip().startswith("```")
            text.append("" if fence or line.startswith("    ") or line.lstrip().startswith("```") else line)
        for found in re.finditer(r"`([^`]+)`", "\n".join(text)):
            code = " ".join(found[1].split()).replace("...", "")
            if code.split()[:1] and code.split()[0] in OURS:
                line = "\n".join(text)[:found.start()].count("\n") + 1
                for words in simple_commands(code)[:1]:
                    self.command(f"{page}:{line}", words, False, may_be_part=True)


def commands_below(programs, *command):
    """All sub-commands that have none themselves."""
    below = programs.subcommands(*command)
    return [leaf for name in below for leaf in commands_below(programs, *command, name)] if below else [command]


def examples_in(text):
    """The examples of a help."""
    return re.findall(r"^  \$ (.*)", text.partition("\nExamples:\n")[2], re.M)


def example_errors(programs):
    """What is wrong with the help of tandem's commands, its examples, and which commands have none."""
    for command in commands_below(programs, "tandem"):
        name, examples = " ".join(command), examples_in(programs.help(*command))
        if not any(name in example for example in examples):
            yield f"{name} --help has no example"
        # CLI11 2.4 ends a program that gives an argument a name like NAME=VALUE; 2.1 does not.
        arguments, _, _ = programs.help(*command).partition("\nPositionals:\n")[2].partition("\n\n")
        for argument in re.findall(r"^  (\S+)", arguments, re.M):
            if not re.fullmatch(r"[A-Z_]+", argument):
                yield f"{name} --help: the argument {argument} has a name that CLI11 2.4 refuses; capitals and _ are safe"
        for words in (words for example in examples for words in simple_commands(example) if words[0] == "tandem"):
            if error := programs.error(words, False):
                yield f"{name} --help: {error}: {' '.join(words)}"
        # Those of options in the text, too, and of options that are passed on.
        for option in re.findall(r"--host-option=(--[\w-]+)", programs.help(*command)):
            for host in ("opros_host", "rtm_host"):
                if not re.search(rf"(?<![\w-]){option}(?![\w-])", programs.help(host)):
                    yield f"{name} --help: {host} has no option {option}"


def main(root, bin_dir):
    check = Check(root, bin_dir)
    check.errors += example_errors(check.programs)
    tests = (pathlib.Path(root) / "tests/documentation/CMakeLists.txt").read_text()
    check.errors += [f"{page} is to be run, but tests/documentation/CMakeLists.txt does not" for page in RUN if page not in tests]
    for page in pages(root):
        before = check.count.copy()
        for block in blocks(root, page):
            check.block(block)
        check.sentences(root, page)
        counted = check.count - before
        print(f"{page}: " + ", ".join(f"{counted[kind]} {kind}" for kind in ("run", "only parsed", "not run")))
    print("all: " + ", ".join(f"{check.count[kind]} {kind}" for kind in ("run", "only parsed", "not run")))
    for reason, programs in sorted(check.not_run.items()):
        print(f"not run, {reason}: {', '.join(sorted(programs))}")
    check.name_not_run()
    print("\n".join(check.errors))
    return 1 if check.errors else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
