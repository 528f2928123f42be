#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A header's change asks for another ABI number; a comment's and white space's do not. Usage: abi_number_test.py ROOT"""
import pathlib
import shutil
import sys
import tempfile
import unittest

import abi_number

ROOT = pathlib.Path(sys.argv.pop())


class Number(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for tree in ("host/call/include", "host/opros/include", "host/rtm/include", "host/rtm/idl"):
            shutil.copytree(ROOT / tree, self.root / tree)

    def faults(self):
        return [place for place, patterns in abi_number.MODELS.items()
                if abi_number.fault(self.root, place, patterns)]

    def change(self, file, old, new):
        text = (self.root / file).read_text()
        self.assertIn(old, text)
        (self.root / file).write_text(text.replace(old, new, 1))

    def test_what_no_compiler_sees_needs_no_number(self):
        self.change("host/opros/include/Component.h", "virtual ~Component();",
                    "virtual  ~Component( ); // gone\n/* and\n more */")
        self.change("host/rtm/idl/RTC.idl", "//", "// another word,")
        self.assertEqual(self.faults(), [])

    def test_a_member_needs_one_of_its_own_model_only(self):
        self.change("host/opros/include/Component.h", "std::string m_compId;", "std::string m_compId; int m_more;")
        self.assertEqual(self.faults(), ["host/opros/include/TandemAbi.h"])

    def test_idl_needs_one(self):
        self.change("host/rtm/idl/BasicDataType.idl", "double", "float")
        self.assertEqual(self.faults(), ["host/rtm/include/rtm/TandemAbi.h"])

    def test_a_macro_and_a_new_header_need_one(self):
        self.change("host/opros/include/OPRoSTypes.h", "DEFAULT_QUEUE_LIMIT 15", "DEFAULT_QUEUE_LIMIT 16")
        (self.root / "host/rtm/include/coil/New.h").write_text("struct New {};\n")
        self.assertEqual(len(self.faults()), 2)

    def test_recording_counts_up_by_one(self):
        place, patterns = next(iter(abi_number.MODELS.items()))
        before = int(abi_number.NUMBER.search((self.root / place).read_text())[2])
        self.change("host/opros/include/Component.h", "std::string m_compId;", "int m_compId;")
        abi_number.record(self.root, place, patterns)
        self.assertEqual(self.faults(), [])
        self.assertEqual(int(abi_number.NUMBER.search((self.root / place).read_text())[2]), before + 1)


if __name__ == "__main__":
    unittest.main()
