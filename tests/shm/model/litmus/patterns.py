# SPDX-License-Identifier: Apache-2.0
"""The core patterns of the rings, the doorbell, the call queue and the short mutex, each with an outcome that must not happen.

An access is written as in the code that the pattern names. `spare`: accesses (thread, position) each of which may lose its order
in this pattern: the others suffice, or the code has the order for another pattern. None: the test does not look for them.
"""
import collections

from aarch64 import compare_exchange, exchange, fence, fetch_add, load, store

Pattern = collections.namedtuple("Pattern", "name code initial program forbidden spare")


def pattern(name, code, program, forbidden, spare=(), **initial):
    locations = {op.location: 0 for thread in program for op in thread if hasattr(op, "location")}
    return Pattern(name, code, {**locations, **initial}, program, forbidden, spare)


RING = [
    pattern("a record whose commit word was read is whole",
            "RingProducer::publish(), RingConsumer::read()",
            [[store("payload", 1, "release"), store("stamp", 1, "release"), store("commit", 1, "release")],
             [load("commit_read", "commit", "acquire"), load("payload_read", "payload", "acquire"),
              load("stamp_read", "stamp", "acquire")]],
            lambda r, m: r["commit_read"] == 1 and (r["payload_read"] == 0 or r["stamp_read"] == 0),
            spare=[(0, 0), (0, 1), (1, 1), (1, 2)]),
    pattern("the place behind a record that was read is clear",
            "RingProducer::clear_commit_word()",
            [[store("next", 0, "release"), store("commit", 1, "release")],
             [load("commit_read", "commit", "acquire"), load("next_read", "next", "acquire")]],
            lambda r, m: r["commit_read"] == 1 and r["next_read"] == 7,
            spare=[(0, 0), (1, 1)], next=7),
    # The tail is 1 until the record at 1 is taken or dropped.
    pattern("a record that the reader could take was not overwritten while it was copied",
            "ring_producer.hpp, the SOFI protocol",
            [[compare_exchange("dropped", "tail", 1, 2, "acq_rel"), store("first", 9, "release"), store("second", 9, "release")],
             [load("tail_read", "tail", "acquire"), load("first_read", "first", "acquire"),
              load("second_read", "second", "acquire"), compare_exchange("taken", "tail", 1, 3, "acq_rel")]],
            lambda r, m: r["taken"] == 1 and 9 in (r["first_read"], r["second_read"]),
            spare=[(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (1, 3)], tail=1),
    pattern("room that the reader has freed is not written before the reader has copied it",
            "RingConsumer::move_tail(), RingProducer::fits()",
            [[load("tail_read", "tail", "acquire"), store("payload", 9, "release")],
             [load("payload_read", "payload", "acquire"), compare_exchange("taken", "tail", 1, 2, "acq_rel")]],
            lambda r, m: r["tail_read"] == 2 and r["payload_read"] == 9,
            spare=[(0, 0), (0, 1), (1, 0), (1, 1)], tail=1),
    pattern("a chunk that the reader has given back is not written before the reader has read it",
            "ChunkLease::give_back(), ChunkPool::is_free()",
            [[load("returned_read", "returned", "acquire"), store("content", 9)],
             [load("content_read", "content"), store("returned", 1, "release")]],
            lambda r, m: r["returned_read"] == 1 and r["content_read"] == 9),
    pattern("an observer notices that a chunk was refilled while it copied the content",
            "RingProducer::claim_chunk(), RingFollower::copy_chunk()",
            [[store("filled_for", 2), fence("release"), store("content", 9)],
             [load("content_read", "content"), fence("acquire"), load("filled_for_read", "filled_for")]],
            lambda r, m: r["content_read"] == 9 and r["filled_for_read"] == 1, filled_for=1),
]

# The word of a cell is 1 while its value is to be read. The writer drops it by 2, the reader takes it by 3.
CELLS = [
    pattern("a value whose word was read is whole",
            "BasicCellRing::publish_content(), take()",
            [[store("bytes", 1), store("word", 1, "release")],
             [load("word_read", "word", "acquire"), load("bytes_read", "bytes")]],
            lambda r, m: r["word_read"] == 1 and r["bytes_read"] == 0),
    pattern("a short value that the reader could take was not overwritten while it was copied",
            "BasicCellRing::make_room(), try_take()",
            [[exchange("before", "word", 2, "acq_rel"), store("bytes", 9)],
             [load("bytes_read", "bytes"), compare_exchange("taken", "word", 1, 3, "release")]],
            lambda r, m: r["taken"] == 1 and r["bytes_read"] == 9, word=1),
    pattern("a reader that sees that a value was dropped sees the newer one",
            "BasicCellRing::publish_content(), catch_up()",
            [[store("newer", 1, "release"), exchange("before", "word", 2, "acq_rel")],
             [load("word_read", "word", "acquire"), load("newer_read", "newer", "acquire")]],
            lambda r, m: r["word_read"] == 2 and r["newer_read"] == 0, spare=[(0, 0), (1, 1)], word=1),
    pattern("a cell that was read is not filled before the reader has copied it",
            "BasicCellRing::make_room(), try_take()",
            [[load("word_read", "word", "acquire"), store("bytes", 9)],
             [load("bytes_read", "bytes"), compare_exchange("taken", "word", 1, 3, "release")]],
            lambda r, m: r["word_read"] == 3 and r["bytes_read"] == 9, word=1),
]

AWAKE, POLLING, ASLEEP = 0, 1, 2
DOORBELL = [
    pattern("an owner that falls asleep sees the message, or its sender sees that the owner is asleep",
            "BasicDoorbell::ring(), sleep_until_done()",
            [[store("commit", 1, "release"), fetch_add("bits", "ready", 1, "seq_cst"), load("owner_read", "owner", "seq_cst")],
             [store("owner", ASLEEP), fence(), load("commit_read", "commit", "acquire"), load("ready_read", "ready")]],
            lambda r, m: r["owner_read"] == AWAKE and r["commit_read"] == 0 and r["ready_read"] == 0,
            spare=[(0, 0), (0, 1), (0, 2), (1, 2)]),
    pattern("an owner that polled and falls asleep sees the message, or its sender sees that the owner is asleep",
            "BasicDoorbell::ring(), sleep_until_done()",
            [[store("commit", 1, "release"), fence(), load("owner_read", "owner")],
             [store("owner", ASLEEP), fence(), load("commit_read", "commit", "acquire")]],
            lambda r, m: r["owner_read"] == POLLING and r["commit_read"] == 0,
            spare=[(0, 0), (1, 2)], owner=POLLING),
    pattern("an owner that takes a bit sees the message, even if the bit was set before",
            "BasicDoorbell::set(), take_all()",
            [[store("commit", 1, "release"), exchange("old", "ready", 1, "seq_cst")],
             [exchange("bits", "ready", 0, "acquire"), load("commit_read", "commit", "acquire"), load("ready_read", "ready")]],
            lambda r, m: r["old"] == 1 and m["ready"] == 0 and r["bits"] == 1 and r["commit_read"] == 0,
            spare=[(0, 0), (1, 1)], ready=1),
    # Load buffering: neither access of the owner may move before its barrier.
    pattern("an owner does not take the bit of a message that its sender rings after the owner has left",
            "BasicDoorbell::take_all(), sleep_until_done()",
            [[load("owner_read", "owner", "seq_cst"), fetch_add("old", "ready", 1, "seq_cst")],
             [exchange("bits", "ready", 0, "acquire"), store("owner", ASLEEP)]],
            lambda r, m: r["owner_read"] == ASLEEP and r["bits"] == 1, spare=[(0, 0), (0, 1)]),
]

SUBMITTED, CANCELLED = 1, 2
CALLS = [
    pattern("a worker that finds a call reads its arguments",
            "CallCaller::begin(), CallWorker::waits(), claim()",
            [[store("arguments", 1), store("deadline", 1), store("request", SUBMITTED, "seq_cst")],
             [load("request_read", "request", "seq_cst"), load("arguments_read", "arguments"), load("deadline_read", "deadline")]],
            lambda r, m: r["request_read"] == SUBMITTED and (r["arguments_read"] == 0 or r["deadline_read"] == 0)),
    pattern("a caller that sees the reply reads its results",
            "CallWorker::answer(), CallCaller::replied()",
            [[store("results", 1), store("reply", 1, "seq_cst")],
             [load("reply_read", "reply", "seq_cst"), load("results_read", "results")]],
            lambda r, m: r["reply_read"] == 1 and r["results_read"] == 0),
    pattern("the arguments of the next call are not written before the worker has read those of this call",
            "CallWorker::answer(), CallCaller::begin()",
            [[load("arguments_read", "arguments"), store("reply", 1, "seq_cst")],
             [load("reply_read", "reply", "seq_cst"), store("arguments", 9)]],
            lambda r, m: r["reply_read"] == 1 and r["arguments_read"] == 9),
    pattern("a caller that gives up sees the claim, or the worker sees that the caller has given up",
            "CallCaller::withdraw(), CallWorker::claim()",
            [[store("request", CANCELLED, "seq_cst"), load("claim_read", "claim", "seq_cst")],
             [load("found", "request"), store("claim", 1), fence(), load("request_read", "request")]],
            lambda r, m: r["found"] == SUBMITTED and r["claim_read"] == 0 and r["request_read"] == SUBMITTED, request=SUBMITTED),
    pattern("a worker that falls asleep sees the call, or its caller sees the sleeper",
            "CallCaller::begin(), CallWorker::sleep()",
            [[store("request", SUBMITTED, "seq_cst"), load("asleep_read", "workers_asleep", "seq_cst")],
             [fetch_add("others", "workers_asleep", 1, "seq_cst"), load("request_read", "request", "seq_cst")]],
            lambda r, m: r["asleep_read"] == 0 and r["request_read"] == 0),
    pattern("a caller that falls asleep sees the reply, or its worker sees the sleeper",
            "sleep_until(), wake_sleeper()",
            [[store("reply", 1, "seq_cst"), load("asleep_read", "caller_asleep", "seq_cst")],
             [store("caller_asleep", 1, "seq_cst"), load("reply_read", "reply", "seq_cst")]],
            lambda r, m: r["asleep_read"] == 0 and r["reply_read"] == 0),
    pattern("a call that begins after the end of its server sees the end, or the server sees the call",
            "CallCaller::begin(), CallWorker::close()",
            [[store("request", SUBMITTED, "seq_cst"), load("closed_read", "closed", "seq_cst")],
             [store("closed", 1, "seq_cst"), load("request_read", "request", "seq_cst")]],
            lambda r, m: r["closed_read"] == 0 and r["request_read"] == 0),
    pattern("a worker that looks at the slots in use sees a call in a new slot",
            "CallCaller::show_to_workers(), CallWorker::any_submitted()",
            [[fetch_add("old", "slots_used", 1, "seq_cst"), store("request", SUBMITTED, "seq_cst"),
              load("asleep_read", "workers_asleep", "seq_cst")],
             [fetch_add("others", "workers_asleep", 1, "seq_cst"), load("used_read", "slots_used", "seq_cst")]],
            lambda r, m: r["asleep_read"] == 0 and r["used_read"] == 0, spare=[(0, 0), (0, 1)]),
    pattern("a worker that enters a slot sees what the last one has left there",
            "CallWorker::take(), answer()",
            [[store("copy", 1), store("busy", 0, "release")],
             [exchange("busy_before", "busy", 1, "acquire"), load("copy_read", "copy")]],
            lambda r, m: r["busy_before"] == 0 and r["copy_read"] == 0, busy=1),
]


def owner_and_visitor(barrier_at):
    """The membarrier of ShortMutex: the kernel makes the owner pass a barrier, here before its access `barrier_at`, between the
    begin and the end of the visitor's system call."""
    owner = [store("inside", 1), load("asked_read", "asked", "acquire")]
    owner[barrier_at:barrier_at] = [load("begun", "begin", "acquire"), fence(), store("end", 1, "release")]
    visitor = [store("asked", 1, "seq_cst"), fence(), store("begin", 1, "release"), load("ended", "end", "acquire"), fence(),
               load("inside_read", "inside", "acquire")]
    return [owner, visitor]


MUTEX = [
    pattern(f"the owner of a short mutex and a visitor are not both inside, with the barrier before access {barrier_at}",
            "ShortMutex::lock_if_owner(), tell_owner_to_stay_out()",
            owner_and_visitor(barrier_at),
            lambda r, m: r["begun"] == 1 and r["ended"] == 1 and r["asked_read"] == 0 and r["inside_read"] == 0,
            spare=None)
    for barrier_at in range(3)
] + [
    pattern("a visitor of a short mutex sees what its owner has written",
            "ShortMutex::unlock(), owner_is_inside()",
            [[store("data", 1), store("inside", 0, "release")], [load("inside_read", "inside", "acquire"), load("data_read", "data")]],
            lambda r, m: r["inside_read"] == 0 and r["data_read"] == 0, inside=1),
    pattern("the owner of a short mutex sees what a visitor has written",
            "ShortMutex::unlock_usual_way(), lock_if_owner()",
            [[store("data", 1), store("asked", 0, "release")], [load("asked_read", "asked", "acquire"), load("data_read", "data")]],
            lambda r, m: r["asked_read"] == 0 and r["data_read"] == 0, asked=1),
    pattern("a visitor of a short mutex writes nothing that the owner reads before it leaves",
            "ShortMutex::unlock(), owner_is_inside()",
            [[load("data_read", "data"), store("inside", 0, "release")], [load("inside_read", "inside", "acquire"), store("data", 9)]],
            lambda r, m: r["inside_read"] == 0 and r["data_read"] == 9, inside=1),
    pattern("threads that lock a short mutex the usual way see what the last one has written",
            "ShortMutex::lock_usual_way(), unlock_usual_way()",
            [[store("data", 1), exchange("before", "state", 0, "release")],
             [compare_exchange("state_read", "state", 0, 1, "acquire"), load("data_read", "data")]],
            lambda r, m: r["state_read"] == 0 and r["data_read"] == 0, state=1),
]

PATTERNS = RING + CELLS + DOORBELL + CALLS + MUTEX
