#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What check_rooms.py refuses."""
import pathlib
import tempfile
import unittest

import check_rooms


class Rooms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, *paths):
        for path in paths:
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            (self.root / path).touch()

    def test_a_folder_with_a_readme_and_25_sources_is_accepted(self):
        self.write("shm/ring/README.md", *(f"shm/ring/{n}.cpp" for n in range(25)))
        self.assertEqual(list(check_rooms.findings(self.root)), [])

    def test_a_folder_of_26_sources_is_named(self):
        self.write("shm/ring/README.md", *(f"shm/ring/{n}.cpp" for n in range(26)))
        self.assertIn("shm/ring holds 26 source files", *check_rooms.findings(self.root))

    def test_a_folder_without_a_readme_is_named(self):
        self.write("apps/tandem/mcap/read/file.cpp")
        self.assertIn("apps/tandem/mcap/read has no README.md", *check_rooms.findings(self.root))

    def test_public_headers_are_left_out(self):
        self.write(*(f"host/rtm/include/rtm/{n}.h" for n in range(80)))
        self.assertEqual(list(check_rooms.findings(self.root)), [])


if __name__ == "__main__":
    unittest.main()
