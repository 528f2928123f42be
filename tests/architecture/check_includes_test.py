#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What check_includes.py refuses. Usage: check_includes_test.py ROOT"""
import pathlib
import sys
import tempfile
import unittest

import check_includes

ROOT = pathlib.Path(sys.argv.pop())


class Includes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def faults(self, file, header):
        path = self.root / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#include {header}\n")
        return list(check_includes.faults(self.root))

    def test_an_arrow_of_the_architecture_is_accepted(self):
        self.assertEqual(self.faults("proxy/link/link.cpp", '"shm/ring/ring.hpp"'), [])
        self.assertEqual(self.faults("shm/ring/ring.cpp", '"shm/os/futex.hpp"'), [])

    def test_an_arrow_against_the_architecture_names_file_and_line(self):
        self.assertEqual(self.faults("shm/ring/ring.cpp", '"proxy/link/link.hpp"'),
                         ["shm/ring/ring.cpp:1: shm/ring must not include proxy/link (proxy/link/link.hpp)"])

    def test_each_way_to_write_an_include_is_seen(self):
        for header in ("<proxy/link/link.hpp>", '"../../proxy/link/link.hpp"'):
            self.assertEqual(self.faults("shm/ring/ring.cpp", header),
                             ["shm/ring/ring.cpp:1: shm/ring must not include proxy/link (proxy/link/link.hpp)"])
        self.assertEqual(self.faults("shm/ring/ring.cpp", '"./ring.hpp"'), [])

    def test_a_room_that_the_architecture_does_not_list_is_named(self):
        self.assertEqual(self.faults("host/new_room/a.cpp", '"proxy/link/link.hpp"'),
                         ["host/new_room/a.cpp: its room has no line in tests/architecture/check_includes.py"])

    def test_a_room_is_closed_to_the_rooms_below_it(self):
        self.assertEqual(len(self.faults("shm/os/futex.cpp", '"shm/ring/ring.hpp"')), 1)

    def test_a_host_does_not_know_shared_memory_or_the_proxy(self):
        self.assertEqual(len(self.faults("host/opros/engine/application.cpp", '"shm/segment.hpp"')), 1)
        self.assertEqual(len(self.faults("host/rtm/runtime/port/port_base.cpp", '"proxy/wire/cdr.hpp"')), 2)

    def test_a_program_sees_the_public_face_of_a_host_only(self):
        self.assertEqual(self.faults("apps/tandem/a.cpp", '"host/opros/engine/profile/component_profile.hpp"'), [])
        self.assertEqual(len(self.faults("apps/tandem/b.cpp", '"host/opros/engine/profile/duplicate_connections.hpp"')), 1)

    def test_one_model_does_not_see_the_other(self):
        self.assertEqual(len(self.faults("proxy/adaptor/a.cpp", "<rtm/RTObject.h>")), 1)

    def test_a_component_does_not_stand_below_the_context_that_runs_it(self):
        header = '"host/rtm/runtime/component/a.hpp"'
        self.assertEqual(len(self.faults("host/rtm/runtime/execution/execution_cycle.cpp", header)), 1)
        self.assertEqual(len(self.faults("host/rtm/runtime/new_room/a.cpp", header)), 2)

    def test_the_table_of_the_page_lacks_no_room_that_may_be_included(self):
        page = "| `host/log` | the log of a host | `host/text`, `shm/os` |\n"
        self.assertEqual(list(check_includes.table_faults(page)), [])
        self.assertEqual(list(check_includes.table_faults(page.replace("`host/text`, ", ""))),
                         ["docs/architecture.md: host/log may include host/text, which the table lacks"])

    def test_a_room_without_a_row_in_the_table_of_the_page_is_named(self):
        page = (ROOT / "docs/architecture.md").read_text()
        self.assertEqual(list(check_includes.absent_rooms(page)), [])
        self.assertIn("docs/architecture.md: the table has no row for host/log",
                      check_includes.absent_rooms(page.replace("| `host/log` |", "| the log |")))

    def test_no_room_reaches_itself_over_others(self):
        for start in check_includes.ALLOWED:
            reached, open_rooms = set(), [start]
            while open_rooms:
                room = open_rooms.pop()
                further = {other for other in check_includes.ALLOWED
                           if other != room and check_includes.arrow(room, other)} - reached
                reached |= further
                open_rooms += further
            self.assertNotIn(start, reached)

    def test_every_public_header_exists(self):
        for header in check_includes.PUBLIC_TO_APPS:
            self.assertTrue((ROOT / header).is_file(), header)


if __name__ == "__main__":
    unittest.main()
