// SPDX-License-Identifier: Apache-2.0
// A model checker for the lock-free code of shm/. The ring, the call queue and the doorbell are templates over
// the struct that touches shared memory (shm/os/atomics.hpp). Here they are instantiated with ModelAtomics, so
// that the very lines that ship run as threads of a *scenario* on one OS thread: every access is a step of the
// checker's scheduler, and what a load returns is the checker's choice among all values that the C++ memory
// model allows. explore() runs every execution of a scenario, or many random ones from a seed; a failure comes
// with the list of its steps.
//
//   checker/
//     fiber           a thread of a scenario
//     memory          which stores a load may read
//     operation       one step, and which steps depend on each other
//     execution       the threads; it consists of scheduler and access
//     choices         the path through a search
//     reduction       what a search may leave out
//     search          explore()
//     model_atomics   the policy for the code under test
//   scenarios/
//     case, explore_cases                       scenarios with a name
//     ring_world, call_world, doorbell_world    what the scenarios of each share
//   mutation/
//     mutation                                  one damage done on purpose, to see it caught
//     mutants, mutation_check                   all of them, one at a time
//
// The rules
// - Each word has a modification order, which is the order in which its stores are executed. A load reads any
//   store that is not older than one that the thread knows of: by its own accesses (coherence) or by
//   happens-before. A read-modify-write reads the newest, a compare-exchange that fails any readable store that
//   differs.
// - Release and acquire hand over all that a thread knows; a release sequence goes on through read-modify-writes
//   only (C++20). Relaxed loads and stores hand it over at a later and from an earlier fence.
// - seq_cst accesses and fences are in one total order, that of execution. A seq_cst load, and any load that
//   follows a fence, does not read a store older than one that an earlier seq_cst access of the same word or any
//   access before an earlier fence has written or read. (C++20, [atomics.order].) Fences are seq_cst; there are
//   no weaker ones.
// - Plain copies (copy_plain_from_shared, copy_plain_to_shared) must be ordered with all other accesses: a data
//   race is a failure.
// - Stores become visible in the end: the same old store is read at most Settings::max_stale_reads times in a row, and
//   from the third round of a polling loop on only the newest is read.
// - futex_wait compares and enqueues in one step and reads the word as a seq_cst load does; a wake-up makes what
//   the waker knows of that word visible to the sleeper. Sleepers are woken in the order of their threads. All
//   asleep for ever is a failure.
// - pause() waits until something changes that was read since the last pause, or until time is up.
// - Time is handed over with every store. It passes when no thread can run, and Settings::lapses times per thread
//   at any call of now(), in any pause and anywhere in a sleep that has a deadline.
// - A mortal thread dies, with all threads of its process, before any store, read-modify-write, wake or sleep;
//   then what it had done is visible to a thread that asks lives(), as the kernel's locks make it.
//
// What is not explored
// - Loads that read stores which come later in the program order of all threads (load buffering, values out of
//   thin air), and stores put into the modification order before ones already executed (2+2W). x86-64 does
//   neither. For arm64, which does both, litmus/ has the core patterns. Against the first, a scenario can demand that
//   what was read happens before every later store (settle()).
// - Compilers: a scenario sees the order of accesses as written, so compiler reordering only as far as the rules
//   above allow it. Plain data that the code under test keeps outside of `A` is not seen at all.
// - Mixed sizes, torn words: a word is read and written whole. Early returns of futex_wait.
// - What the words hold: positions are small and sequence numbers start at 0; nothing wraps around.
// - A search is complete for its scenario and settings only. Those that are marked small are complete in the
//   default size of a test; TANDEM_STRESS raises the bound of the others, TANDEM_MODEL_SIZES=1 prints how far
//   each came.
#pragma once
#include "tests/shm/model/checker/model_atomics.hpp"
#include "tests/shm/model/checker/search.hpp"
