#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What run_page.py and check_commands.py refuse.   documentation_test.py BIN"""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import check_commands
import check_tests
import pages
import run_page

BIN = ""


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "docs").mkdir()
        (self.root / "tests/documentation").mkdir(parents=True)
        (self.root / "tests/documentation/CMakeLists.txt").write_text("docs/page.md\n")
        for patched in (mock.patch.object(pages, "ROOMS", []), mock.patch.dict(pages.RUN, clear=True),
                        mock.patch.dict(pages.LOOKED_UP, clear=True)):
            patched.start()
            self.addCleanup(patched.stop)

        patched = mock.patch.object(check_commands, "example_errors", lambda programs: [])
        patched.start() # of the program; tested below
        self.addCleanup(patched.stop)

    def page(self, text, mode=None):
        (self.root / "docs/page.md").write_text(text)
        if mode:
            pages.RUN["docs/page.md"] = mode

    def printed(self, function, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as output:
            code = function(self.root, *arguments)
        return code, output.getvalue()

    def run_page(self, seconds="20"):
        return self.printed(run_page.main, "docs/page.md", BIN, seconds)

    def check(self):
        return self.printed(check_commands.main, BIN)

    def test_a_page_whose_output_comes_is_accepted(self):
        self.page("```sh\necho one  two\nprintf 'a\\nb 17 c\\n'\n# not run by the test: no reason\nfalse\n```\n"
                  "```\none two\nb ... c\n```\n", "sh")
        code, output = self.run_page()
        self.assertEqual(code, 0, output)
        self.assertIn("docs/page.md:2: not run, no reason: false", output)
        self.assertIn("1 blocks were run", output)

    def test_a_page_without_a_command_that_is_to_be_run_is_refused(self):
        self.page("```sh\necho one\n```\n", "lines echo two")
        code, output = self.run_page()
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md: has no command of those that", output)

    def test_output_that_does_not_come_is_named(self):
        self.page("```sh\necho one\n```\n\n```\none\ntwo\n```\n", "sh")
        code, output = self.run_page()
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:7: not printed: two", output)

    def test_output_in_another_order_is_refused(self):
        self.page("```sh\necho two; echo one\n```\n```\none\ntwo\n```\n", "sh")
        self.assertEqual(self.run_page()[0], 1)

    def test_a_command_that_fails_is_named(self):
        self.page("```sh\necho one\nls nowhere | cat\necho two\n```\n", "sh")
        code, output = self.run_page()
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:2: a command failed", output)

    def test_a_command_that_hangs_is_bounded_and_its_jobs_are_ended(self):
        self.page("```sh\nsleep 1000 &\nsleep 1000\n```\n", "sh")
        code, output = self.run_page("1")
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:2: the page ended here with exit code none within 1.0 s", output)

    def test_commands_with_their_output_in_one_block_are_run(self):
        self.page("```\n$ echo one\none\n$ echo two\nthree\n```\n", "console")
        code, output = self.run_page()
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:5: not printed: three", output)

    def test_commands_that_exist_are_accepted_and_counted(self):
        self.page("`tandem shm list, info` and `tandem`\n```sh\ntandem shm list --json | tandem opros info X.xml && docker run x\n"
                  "wheelchair --config opros|rtm --lockstep\n# not run by the test: no reason\nfrobnicate \\\n  --all\n```\n")
        pages.LOOKED_UP["docs/page.md"] = "no time"
        code, output = self.check()
        self.assertEqual(code, 0, output)
        self.assertIn("not run, no time: docs/page.md:3: tandem shm list --json\n", output)
        self.assertIn("docs/page.md: 0 run, 5 only parsed, 2 not run", output)

    def test_a_command_that_is_only_looked_up_has_a_reason(self):
        self.page("text\n```sh\ntandem shm list\n```\n")
        self.assertIn("docs/page.md:3: tandem shm list: neither run nor named as not run", self.check()[1])
        self.page("`tandem shm list`\n")
        pages.LOOKED_UP["docs/page.md"] = "no time"
        code, output = self.check()
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md is named as not run, but has no such command", output)

    def test_each_unknown_part_of_a_command_is_named(self):
        for command, error in (("tandem shm lost", "tandem shm has no sub-command lost"),
                               ("tandem shm list --jsonx", "tandem shm list has no option --jsonx"),
                               ("tandem opros build A --jso", "tandem opros build has no option --jso"),
                               ("tandem shm", "tandem shm needs a sub-command"), ("frobnicate --all", "frobnicate is neither run nor"),
                               ("tests/gone.sh", "tests/gone.sh is neither run nor"), ("tests/run.sh", "there is no tests/run.sh"),
                               ("echo a && opros_host --no-such", "opros_host has no option --no-such")):
            self.page(f"text\n```sh\n{command}\n```\n")
            code, output = self.check()
            self.assertEqual(code, 1, command)
            self.assertIn(f"docs/page.md:3: {error}", output)

    def test_a_job_of_the_shell_is_named_by_its_process_id(self):
        self.page("```sh\nsleep 1 &\nwait %1\n```\n", "sh")
        self.assertIn("docs/page.md:3: a job's number, where $! was to be kept: wait %1", self.check()[1])

    def test_a_command_in_a_sentence_is_looked_up(self):
        self.page("text\nuse `tandem\nlink chek DIR` for that\n")
        code, output = self.check()
        self.assertEqual(code, 1)
        self.assertIn("docs/page.md:2: tandem link has no sub-command chek", output)

    def test_a_page_that_is_to_be_run_has_a_test(self):
        self.page("")
        pages.RUN["docs/other.md"] = "sh"
        self.assertIn("docs/other.md is to be run, but", self.check()[1])


class Examples(unittest.TestCase):
    def errors_of(self, example):
        class Programs(check_commands.Programs):
            def help(self, *command):
                return {("tandem",): "Subcommands:\n  run   Runs\n\n", ("tandem", "run"): f"Usage\n  --wait --host-option\n\nExamples:\n{example}\n",
                        ("opros_host",): "  --lock\n", ("rtm_host",): "  --lock\n"}.get(command, "")
        return list(check_commands.example_errors(Programs("", "")))

    def test_examples_with_options_that_exist_are_accepted(self):
        self.assertEqual(self.errors_of("  $ tandem run robot --wait 3 --host-option=--lock"), [])

    def test_a_missing_or_wrong_example_is_named(self):
        self.assertEqual(self.errors_of("none"), ["tandem run --help has no example"])
        self.assertIn("tandem run has no option --wiat", self.errors_of("  $ tandem run robot --wiat 3")[0])
        self.assertIn("tandem run --help: opros_host has no option --fifo", self.errors_of("  $ tandem run --host-option=--fifo"))


class NamedTests(unittest.TestCase):
    def faults_of(self, page):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "tests").mkdir()
            (root / "tests/a_test.cpp").write_text('TEST_CASE(\n    "one, "\n    "two") {}\nTEST_CASE_METHOD(F, "three") {}\nCHECK("four");\n')
            (root / "tests/CMakeLists.txt").write_text('add(x "a sentence")\n')
            (root / "SECURITY.md").write_text(page)
            return list(check_tests.faults(root, "SECURITY.md", "| actor |"))

    def test_tests_that_exist_are_accepted(self):
        self.assertEqual(self.faults_of("| actor | tests |\n|---|---|\n| a | [one, two](tests/a_test.cpp), [three](tests/a_test.cpp) |\n"
                                        "| b | [a sentence](tests/CMakeLists.txt) |\n\n| c |\n"), [])

    def test_a_missing_test_file_or_name_is_named(self):
        self.assertEqual(self.faults_of("[four](tests/a_test.cpp)\n[x](tests/b_test.cpp)\n| actor |\n|---|\n| a |\n"),
                         ["SECURITY.md:1: tests/a_test.cpp has no test 'four'", "SECURITY.md:2: there is no tests/b_test.cpp",
                          "SECURITY.md:5: this row names no test"])


if __name__ == "__main__":
    BIN = sys.argv.pop()
    unittest.main()
