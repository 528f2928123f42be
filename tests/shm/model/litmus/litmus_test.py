#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The patterns of patterns.py under the AArch64 memory model, and the known outcomes of litmus tests that check the model."""
import unittest

from aarch64 import Fence, Load, Store, exchange, executions, fence, fetch_add, load, store
from patterns import PATTERNS


def is_allowed(program, initial, outcome):
    return any(outcome(registers, memory) for registers, memory in executions(program, initial))


def weakened(program):
    """(thread, position) and the program in which that access has no order, or without that fence."""
    for thread, operations in enumerate(program):
        for at, operation in enumerate(operations):
            if not isinstance(operation, Fence) and operation.order == "relaxed":
                continue
            changed = [] if isinstance(operation, Fence) else [operation._replace(order="relaxed")]
            copy = [list(others) for others in program]
            copy[thread][at:at + 1] = changed
            yield (thread, at), copy


class Model(unittest.TestCase):
    """Names and outcomes: Maranget, Sarkar, Sewell, "A Tutorial Introduction to the ARM and POWER Relaxed Memory Models"."""

    def check(self, expected, program, outcome, **initial):
        self.assertEqual(is_allowed(program, {"x": 0, "y": 0, **initial}, outcome), expected)

    def test_message_passing_needs_a_release_and_an_acquire(self):
        for write in ("relaxed", "release"):
            for read in ("relaxed", "acquire"):
                self.check((write, read) != ("release", "acquire"),
                           [[store("x", 1), store("y", 1, write)], [load("a", "y", read), load("b", "x")]],
                           lambda r, m: r["a"] == 1 and r["b"] == 0)

    def test_store_buffering_needs_fences_or_seq_cst(self):
        for orders, expected in (("release acquire", True), ("seq_cst acquire", True), ("seq_cst seq_cst", False)):
            write, read = orders.split()
            self.check(expected, [[store("x", 1, write), load("a", "y", read)], [store("y", 1, write), load("b", "x", read)]],
                       lambda r, m: r["a"] == 0 and r["b"] == 0)
        self.check(False, [[store("x", 1), fence(), load("a", "y")], [store("y", 1), fence(), load("b", "x")]],
                   lambda r, m: r["a"] == 0 and r["b"] == 0)

    def test_load_buffering_is_allowed_without_order(self):
        for order, expected in (("relaxed", True), ("acquire", False)):
            self.check(expected, [[load("a", "x", order), store("y", 1)], [load("b", "y", order), store("x", 1)]],
                       lambda r, m: r["a"] == 1 and r["b"] == 1)

    def test_two_threads_may_write_two_words_in_opposite_orders(self):
        for order, expected in (("relaxed", True), ("release", False)):
            self.check(expected, [[store("x", 1), store("y", 2, order)], [store("y", 1), store("x", 2, order)]],
                       lambda r, m: m["x"] == 1 and m["y"] == 1)

    def test_writes_reach_all_threads_in_one_order(self):
        for order, expected in (("relaxed", True), ("acquire", False)):
            self.check(expected, [[store("x", 1)], [store("y", 1)], [load("a", "x", order), load("b", "y")],
                                  [load("c", "y", order), load("d", "x")]],
                       lambda r, m: r["a"] == 1 and r["b"] == 0 and r["c"] == 1 and r["d"] == 0)

    def test_each_word_is_coherent(self):
        self.check(False, [[store("x", 1)], [load("a", "x"), load("b", "x")]], lambda r, m: r["a"] == 1 and r["b"] == 0)
        self.check(False, [[store("x", 1), load("a", "x")]], lambda r, m: r["a"] == 0)

    def test_updates_are_atomic(self):
        self.check(False, [[fetch_add("a", "x", 1)], [fetch_add("b", "x", 1)]], lambda r, m: r["a"] == r["b"])
        self.check(True, [[fetch_add("a", "x", 1)], [fetch_add("b", "x", 1)]], lambda r, m: m["x"] == 2)

    def test_a_seq_cst_update_is_no_fence_for_relaxed_accesses(self):
        self.check(True, [[store("x", 1), exchange("c", "z", 1, "seq_cst"), load("a", "y")],
                          [store("y", 1), fence(), load("b", "x")]], lambda r, m: r["a"] == 0 and r["b"] == 0, z=0)


class Patterns(unittest.TestCase):
    def test_what_must_not_happen_is_forbidden(self):
        for pattern in PATTERNS:
            with self.subTest(pattern.name):
                self.assertFalse(is_allowed(pattern.program, pattern.initial, pattern.forbidden), pattern.code)

    def test_without_any_order_it_happens(self):
        for pattern in PATTERNS:
            plain = [[op._replace(order="relaxed") for op in operations if not isinstance(op, Fence)] for operations in pattern.program]
            with self.subTest(pattern.name):
                self.assertTrue(is_allowed(plain, pattern.initial, pattern.forbidden), pattern.code)

    def test_each_order_is_needed_that_is_not_named_as_spare(self):
        for pattern in [each for each in PATTERNS if each.spare is not None]:
            spare = {place for place, program in weakened(pattern.program)
                     if not is_allowed(program, pattern.initial, pattern.forbidden)}
            with self.subTest(pattern.name):
                self.assertEqual(spare, set(pattern.spare), pattern.code)


if __name__ == "__main__":
    unittest.main()
