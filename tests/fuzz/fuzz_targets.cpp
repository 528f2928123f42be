// SPDX-License-Identifier: Apache-2.0
#include "fuzz_targets.hpp"

#include "shm/call/call_caller.hpp"
#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/call/call_worker.hpp"
#include "shm/inspect/call_follower.hpp"
#include "shm/inspect/observer.hpp"
#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/inspect/ring_follower.hpp"
#include "tests/shm/view_as.hpp"

#include <cstdio>
#include <cstdlib>

namespace tandem::shm::fuzz {
namespace {

using namespace std::chrono_literals;
using test::view_as;

constexpr std::size_t max_record = 100, chunk_bytes = 4096, max_call = 200, max_operations = 64;
constexpr std::size_t arena_bytes = 192 * 1024;
constexpr std::size_t slots_at = sizeof(layout::CallQueueHeader) + sizeof(layout::CallTimes);

void demand(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "out of bounds: %s\n", what);
    std::abort();
}

/// Looks at every byte, for the address sanitizer.
void touch(std::span<const std::byte> bytes) {
    unsigned sum = 0;
    for (const std::byte byte : bytes) sum += std::to_integer<unsigned>(byte);
    volatile unsigned sink = sum;
    static_cast<void>(sink);
}

/// In bounds: in the ring's own chunks or records, or in private memory of that size.
void check_record(const Record& record, const RingView<RealAtomics>& ring) {
    demand(record.bytes.size() <= std::max(ring.max_record, ring.chunk_bytes), "size of a record");
    const auto* shared = reinterpret_cast<const std::byte*>(ring.shared);
    const auto* end = ring.chunk_count != 0 ? ring.chunk(ring.chunk_count)
                                            : reinterpret_cast<const std::byte*>(ring.cells) + ring.capacity;
    const auto* at = record.bytes.data();
    if (at >= shared && at < end)
        demand(at + record.bytes.size() <= end, "end of a record in place");
    else
        demand(record.bytes.size() <= ring.max_record, "size of a copied record");
    touch(record.bytes);
}

} // namespace

FuzzTargets::FuzzTargets() : link_("fuzz-" + std::to_string(getpid())) {
    JoinOptions options;
    options.arena_bytes = arena_bytes;
    hostile_ = Segment::join(link_, Side::first, options);
    victim_ = Segment::join(link_, Side::second, options);
    for (const std::uint32_t chunks : {0U, 2U})
        for (const Side writer : {Side::first, Side::second}) {
            const std::string name = "r" + std::to_string(to_victim_.size() + from_victim_.size());
            hostile_->add_ring(name, {.writer = writer,
                                      .max_record = max_record,
                                      .capacity = 512,
                                      .chunk_bytes = chunks * chunk_bytes / 2,
                                      .chunks = chunks});
            auto& list = writer == Side::first ? to_victim_ : from_victim_;
            list.push_back({name, hostile_->list(Side::first).back().memory});
        }
    hostile_->add_call_queue("c", {.callers = Side::second, .slots = 2, .max_bytes = max_call});
    queue_ = {"c", hostile_->list(Side::first).back().memory};
    hostile_->add_blob("b", 100);
    hostile_->publish();
    // The mapping begins where the arenas' offset says, before the first object.
    std::byte* begin = to_victim_.front().hostile.data() - layout::arenas_begin;
    everything_ = {begin, layout::arenas_begin + arena_bytes};
    arena_ = everything_.subspan(layout::arenas_begin);
    pristine_.assign(everything_.begin(), everything_.end());
}

void FuzzTargets::restore(Restore what) {
    const auto to = what == Restore::all ? everything_ : arena_;
    std::memcpy(to.data(), pristine_.data() + (pristine_.size() - to.size()), to.size());
}

RingHandle FuzzTargets::ring(const Object& object) const {
    return *victim_->find_ring(Side::first, object.name);
}

template <class A>
void FuzzTargets::consume(Input& input, const Object& object) {
    const RingHandle handle = ring(object);
    RingProducer<RealAtomics> honest(hostile_->find_ring(Side::first, object.name)->view);
    Mutator::unleash(input, object.hostile, sizeof(layout::RingHeader));
    RingConsumer<A> consumer(view_as<A>(handle.view));
    const std::vector<std::byte> payload(chunk_bytes, std::byte{7});
    for (std::size_t i = 0; i < max_operations && !input.used_up(); ++i) {
        const std::uint8_t what = input.byte();
        const Record* record = nullptr;
        switch (what % 5) {
        case 0:
            Mutator::rewrite();
            break;
        case 1:
            record = consumer.read();
            break;
        case 2:
            record = consumer.read_newest();
            break;
        case 3:
            consumer.empty();
            break;
        default:
            honest.write(payload.data(), what > 200 ? what * 16U : what / 2U, i);
            break;
        }
        if (record) check_record(*record, handle.view);
    }
    Mutator::restrain();
}

template <class A>
void FuzzTargets::produce(Input& input, const Object& object) {
    const RingHandle handle = ring(object);
    const auto same = hostile_->find_ring(Side::first, object.name)->view;
    RingConsumer<RealAtomics> honest(same);
    Mutator::unleash(input, object.hostile, sizeof(layout::RingHeader));
    RingProducer<A> producer(view_as<A>(handle.view));
    const std::vector<std::byte> payload(2 * chunk_bytes, std::byte{7});
    for (std::size_t i = 0; i < max_operations && !input.used_up() && !producer.corrupt(); ++i) {
        const std::uint8_t what = input.byte();
        const std::size_t bytes = what > 200 ? what * 20U : what / 2U;
        switch (what % 4) {
        case 0:
            Mutator::rewrite();
            break;
        case 1:
            producer.write(payload.data(), bytes, i);
            break;
        case 2: {
            using Reservation = typename RingProducer<A>::Reservation;
            const Reservation reserved = producer.reserve(bytes);
            if (reserved == Reservation::refused) break;
            if (reserved == Reservation::chunk) std::memset(producer.chunk(), 1, bytes);
            if (what % 3 == 0)
                producer.cancel_reservation();
            else
                producer.commit(payload.data(), bytes / (1 + what % 5), i);
            break;
        }
        default:
            if (const auto record = honest.read()) check_record(*record, same);
            break;
        }
    }
    Mutator::restrain();
}

void FuzzTargets::read_with_shipping(Input& input, const Object& object) {
    const RingHandle handle = ring(object);
    Mutator::unleash(input, object.hostile, sizeof(layout::RingHeader));
    Mutator::rewrite();
    RingReader reader(handle);
    for (std::size_t i = 0; i < max_operations && !input.used_up(); ++i) {
        const std::uint8_t what = input.byte();
        if (what % 2 == 0) Mutator::rewrite();
        const auto record = what % 3 == 0 ? reader.read_newest() : reader.read();
        if (record) check_record(*record, handle.view);
        reader.counters();
    }
}

void FuzzTargets::write_with_shipping(Input& input, const Object& object) {
    Mutator::unleash(input, object.hostile, sizeof(layout::RingHeader));
    Mutator::rewrite();
    RingWriter writer(ring(object));
    for (std::size_t i = 0; i < max_operations && !input.used_up(); ++i) {
        const std::uint8_t what = input.byte();
        if (what % 2 == 0) Mutator::rewrite();
        const auto room = writer.reserve(what > 200 ? what * 20U : what / 2U);
        if (room.data() == nullptr) continue;
        std::memset(room.data(), 1, room.size());
        writer.commit(room.size(), i);
    }
}

void FuzzTargets::call(Input& input) {
    Mutator::unleash(input, queue_.hostile, slots_at);
    CallCaller<MutatedAtomics> caller(
        view_as<MutatedAtomics>(victim_->find_call_queue(Side::first, "c")->view));
    const std::vector<std::byte> payload(max_call, std::byte{7});
    std::vector<std::byte> results(max_call);
    for (std::size_t i = 0; i < max_operations / 8 && !input.used_up(); ++i) {
        CallTicket ticket;
        const std::uint8_t what = input.byte();
        if (caller.begin(payload.data(), what % (max_call + 1), 1000, 0, what % 2 == 0, ticket) !=
            CallStart::ok)
            continue;
        Mutator::rewrite();
        if (what % 3 == 0 && caller.withdraw(ticket)) continue;
        const bool over = what % 5 == 0 ? caller.sleep(ticket, now_ns() + 1000) : caller.spin(ticket, 0);
        if (over && caller.replied(ticket)) {
            const std::uint64_t word = caller.reply(ticket); // as CallClient does, it is read once
            if (word == 0 || length_of(word) > max_call) {
                caller.forget(ticket);
                continue;
            }
            caller.copy_results(ticket, results.data(), length_of(word));
            caller.finish(ticket);
        } else if (!caller.withdraw(ticket)) {
            caller.finish(ticket);
        }
    }
    Mutator::restrain();
}

/// The other end of the same queue. The queue is in the arena of the first side, but a worker's view has no
/// side.
void FuzzTargets::serve(Input& input) {
    Mutator::unleash(input, queue_.hostile, slots_at);
    const auto view = victim_->find_call_queue(Side::first, "c")->view;
    CallWorker<MutatedAtomics> worker(view_as<MutatedAtomics>(view));
    CallCaller<RealAtomics> honest(view);
    const std::vector<std::byte> payload(max_call, std::byte{7});
    for (std::size_t i = 0; i < max_operations / 8 && !input.used_up(); ++i) {
        const std::uint8_t what = input.byte();
        CallTicket ticket;
        if (what % 4 != 0) honest.begin(payload.data(), what % (max_call + 1), 1000, 0, true, ticket);
        Mutator::rewrite();
        bool polling = what % 2 == 0 && worker.try_become_poller();
        TakenCall call;
        const bool taken = worker.take(polling, call);
        if (polling) worker.stop_polling();
        if (taken) {
            demand(call.bytes() <= max_call, "length of arguments");
            touch({static_cast<const std::byte*>(call.arguments), call.bytes()});
            worker.answer(call, CallStatus::ok, call.arguments, call.bytes());
        } else if (what % 16 == 1) {
            worker.sleep(now_ns() + 1000);
        }
        if (what % 32 == 2) {
            worker.close();
            worker.drop_submitted();
            worker.open();
        }
    }
    Mutator::restrain();
}

void FuzzTargets::call_with_shipping(Input& input) {
    Mutator::unleash(input, queue_.hostile, slots_at);
    Mutator::rewrite();
    const auto found = victim_->find_call_queue(Side::first, "c");
    // The header may now claim a slightly longer text: up to the slots' space, which consists of whole cache lines.
    const std::size_t longest = found->view.max_bytes;
    demand(longest <= max_call + layout::line_pair, "longest arguments");
    CallClient client(*found, {.spin = 500ns});
    CallServer server(*hostile_->find_call_queue(Side::first, "c"), {.spin = 500ns});
    const std::vector<std::byte> payload(max_call + 8, std::byte{7});
    for (std::size_t i = 0; i < max_operations / 8 && !input.used_up(); ++i) {
        const std::uint8_t what = input.byte();
        if (what % 2 == 0) Mutator::rewrite();
        // Makes a call that is not answered, and lets the server take what a rewritten slot contains.
        const Reply reply = client.call({payload.data(), what % (max_call + 8)}, 5us);
        demand(reply.bytes.size() <= longest, "length of a reply");
        if (what % 5 == 0) Mutator::rewrite();
        if (auto call = server.take(0ns)) {
            demand(call->arguments().size() <= longest, "length of arguments");
            touch(call->arguments());
            if (what % 3 == 0) Mutator::rewrite();
            call->reply(CallStatus::ok, call->arguments());
        }
        client.counters();
    }
}

/// Headers and directory: what can be found afterwards lies in the arena, and can be opened and used.
void FuzzTargets::look_up(Input& input) {
    const auto head = everything_.first(layout::page + 512 + 20 * sizeof(layout::DirectoryEntry));
    Mutator::unleash(input, head);
    for (std::size_t i = 0; i < max_operations / 4 && !input.used_up(); ++i) {
        Mutator::rewrite();
        const std::uint8_t what = input.byte();
        if (what % 4 == 0) { // sizes of an object, too
            const auto& object = what < 128 ? to_victim_[what / 4U % to_victim_.size()] : queue_;
            Mutator::unleash(input, object.hostile.first(64));
            Mutator::rewrite();
            Mutator::unleash(input, head);
        }
        victim_->peer_state();
        victim_->superseded();
        victim_->doorbell().poll();
        victim_->ring_peer(what);
        try {
            for (const auto& object : victim_->list(Side::first)) {
                demand(object.memory.size() <= arena_bytes, "size of an object");
                touch(object.memory.first(std::min<std::size_t>(64, object.memory.size())));
                if (!object.memory.empty()) touch(object.memory.last(1));
                if (object.kind == layout::ObjectKind::ring) {
                    const auto found = victim_->find_ring(Side::first, object.name);
                    if (found && found->writer == Side::first) {
                        RingReader reader(*found);
                        if (const auto record = reader.read()) check_record(*record, found->view);
                    }
                }
            }
            victim_->find_call_queue(Side::first, "c");
            if (const auto blob = victim_->copy_blob(Side::first, "b")) touch(*blob);
        } catch (const Error&) { // a clean end; the next word may repair it
        }
    }
}

void FuzzTargets::observe_it(Input& input) {
    Mutator::unleash(input, everything_);
    for (int i = 0; i < 4 + input.byte() % 8; ++i) Mutator::rewrite();
    const auto observed = observe(link_);
    demand(observed.has_value(), "the segment cannot be observed");
    std::size_t copied = 0;
    for (const auto& blob : observed->blobs) copied += blob.content.size();
    demand(copied <= everything_.size(), "copied blobs");
}

/// Followers of rings and calls whose bytes change between polls and between the steps of a poll.
void FuzzTargets::follow(Input& input) {
    constexpr std::size_t most = 1024;
    const auto observed = observe(link_);
    const auto file = open_observed(observed->segment);
    const auto memory = std::make_shared<CopyMemory>();
    std::vector<RingFollower> rings;
    for (const auto& ring : observed->rings)
        rings.emplace_back(file, ring, RingFollower::Begin::oldest, memory);
    CallFollower calls(file, observed->call_queues.at(0));
    RingProducer<RealAtomics> honest(ring(to_victim_.back()).view);
    const std::vector<std::byte> payload(chunk_bytes, std::byte{7});
    for (std::size_t i = 0; i < max_operations && !input.used_up(); ++i) {
        const std::uint8_t what = input.byte();
        const auto& object = what % 8 == 0 ? queue_ : to_victim_[what / 8U % to_victim_.size()];
        Mutator::unleash(input, object.hostile, what % 8 == 0 ? slots_at : sizeof(layout::RingHeader));
        if (what % 3 == 0) honest.write(payload.data(), what > 200 ? what * 16U : what / 2U, i);
        if (what % 2 == 0) Mutator::rewrite();
        for (RingFollower& ring : rings) {
            std::size_t delivered = 0;
            ring.may_have_come();
            ring.poll(
                [&](const FollowedRecord& record) {
                    demand(delivered < most, "messages of one poll");
                    delivered += layout::line;
                    touch(record.bytes);
                    Mutator::look();
                },
                most);
        }
        calls.poll([&](const FollowedCall& call) {
            demand(call.arguments.size() <= max_call && call.results.size() <= max_call, "length of a call");
            touch(call.arguments);
            touch(call.results);
            Mutator::look();
        });
        Mutator::restrain();
    }
    demand((memory->records.size() + memory->chunk.size()) * word_bytes <= 2 * everything_.size(),
           "memory of followers");
}

void FuzzTargets::run(Input& input) {
    const std::uint8_t what = input.byte();
    const auto& to = to_victim_[what / 16U % to_victim_.size()];
    const auto& from = from_victim_[what / 16U % from_victim_.size()];
    Restore after = Restore::arena;
    try {
        switch (what % 16) {
        case 0:
        case 1:
        case 2:
        case 3:
            consume<MutatedAtomics>(input, to);
            break;
        case 4:
        case 5:
        case 6:
            produce<MutatedAtomics>(input, from);
            break;
        case 7:
            read_with_shipping(input, to);
            break;
        case 8:
            write_with_shipping(input, from);
            break;
        case 9:
        case 10:
            call(input);
            break;
        case 11:
        case 12:
            serve(input);
            break;
        case 13:
            call_with_shipping(input);
            break;
        case 14:
            after = Restore::all;
            look_up(input);
            break;
        default:
            after = Restore::all;
            if (what == 15)
                observe_it(input);
            else if (what < 128)
                follow(input);
            else
                look_up(input);
        }
    } catch (const Error&) { // the only clean way to refuse
    }
    Mutator::restrain();
    restore(after);
}

} // namespace tandem::shm::fuzz
