#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What check_processors.py refuses."""
import pathlib
import tempfile
import unittest

import check_processors


class Processors(unittest.TestCase):
    def findings(self, path, text):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / path).parent.mkdir(parents=True)
            (root / path).write_text(text)
            return list(check_processors.findings(root, [path]))

    def test_an_instruction_of_one_processor_is_named_with_its_line(self):
        found = self.findings("host/rt/tick.cpp", "void f() {\n    _mm_pause();\n}\n")
        self.assertEqual(found, ["host/rt/tick.cpp:2: names a processor; move it to shm/os/processor.hpp"])

    def test_each_way_to_name_a_processor_is_refused(self):
        for line in ("__builtin_ia32_rdtsc();", "#if defined(__x86_64__)", "#ifdef __aarch64__", "#ifdef __ARM_NEON__",
                     '__asm__ volatile("lfence");', 'asm("yield");', "__builtin_ia32_pause();", "#include <immintrin.h>", "#ifdef __amd64"):
            self.assertEqual(len(self.findings("proxy/wire/a.cpp", line)), 1, line)

    def test_a_page_of_4096_bytes_is_refused(self):
        for line in ("constexpr std::size_t page_bytes = 4096;", "constexpr auto page = 4096u;", "std::size_t page_size{4 * 1024};",
                     "mmap(nullptr, 4096, PROT_READ, 0, f, 0);", "munmap(p, 0x1000);"):
            self.assertEqual(len(self.findings("host/a.cpp", line)), 1, line)

    def test_another_4096_is_accepted(self):
        for line in ("char answer[4096];", "constexpr int max_messages = 4096;",
                     '__asm__(".pushsection x");', 'asm volatile("" ::: "memory");'):
            self.assertEqual(self.findings("host/a.cpp", line), [], line)

    def test_the_named_files_are_accepted(self):
        self.assertEqual(self.findings("shm/os/processor.hpp", "_mm_pause();"), [])
        self.assertEqual(self.findings("shm/segment/layout.hpp", "constexpr std::size_t page = 4096;"), [])


if __name__ == "__main__":
    unittest.main()
