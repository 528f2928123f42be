// SPDX-License-Identifier: Apache-2.0
// Two processes that act as hosts: they join and exchange records and calls. When the other one dies or a newer generation
// appears, they leave and join again. They record what they see in memory that outlives them.
#pragma once
#include "../shm/fixture.hpp"
#include "shared.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"

#include <future>

namespace tandem::shm::test {

/// What one side has noted. flowing_ns: when it had received a record and a reply for the first time since it
/// joined, and `flowing` the generation. (The first side in an empty directory begins with generation 1
/// again.)
struct Noted {
    std::atomic<std::uint64_t> joined_ns{0}, generation{0}, flowing{0}, flowing_ns{0};
    std::atomic<std::uint64_t> records{0}, calls{0}, wrong{0};
};
struct Notes {
    Noted side[2];
    std::atomic<bool> stop{false};
};

/// One generation, seen from one side.
class Visit {
  public:
    Visit(const Link& link, Side side, Noted& noted)
        : segment_(join(link, side, small(arena))), noted_(noted),
          writer_(segment_->add_ring("out", {.writer = side, .max_record = 200, .capacity = 4096})),
          client_(segment_->add_call_queue("calls", {.callers = side, .slots = 2, .max_bytes = 64})) {
        noted_.generation = segment_->generation();
        noted_.joined_ns = now_ns();
        segment_->publish();
    }

    ~Visit() { client_.shut_down(); } // so that the pending call ends soon; the future waits for it
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

    bool over() const { return segment_->peer_state() == PeerState::dead || segment_->superseded(); }

    void turn() {
        ++number_;
        const std::vector<std::uint64_t> payload(1 + number_ % 20, number_);
        writer_.write(std::as_bytes(std::span(payload)), number_);
        if (!reader_ && segment_->peer_published()) meet();
        if (!reader_) return;
        receive();
        if (auto call = server_->take(0ns)) call->reply(CallStatus::ok, call->arguments());
        exchange_call();
        if (records_ == 0 || calls_ == 0 || flowing_) return;
        flowing_ = true;
        noted_.flowing = segment_->generation();
        noted_.flowing_ns = now_ns();
    }

  private:
    static constexpr std::size_t arena = 64 * 1024;

    void meet() {
        const Side theirs = other(segment_->side());
        reader_.emplace(*segment_->find_ring(theirs, "out"));
        server_.emplace(*segment_->find_call_queue(theirs, "calls"));
    }

    void receive() {
        while (const auto record = reader_->read()) {
            for (std::size_t at = 0; at < record->bytes.size(); at += 8)
                if (std::memcmp(&record->bytes[at], &record->stamp_ns, 8) != 0) ++noted_.wrong;
            if (record->sequence <= sequence_ || record->bytes.size() != 8 * (1 + record->stamp_ns % 20))
                ++noted_.wrong;
            sequence_ = record->sequence;
            ++records_;
            ++noted_.records;
        }
        if (reader_->corrupt() || writer_.corrupt()) ++noted_.wrong;
    }

    /// Begins a call in a separate thread, or takes its reply if it has arrived.
    void exchange_call() {
        const std::string text = std::to_string(asked_);
        if (!pending_.valid()) {
            pending_ =
                std::async(std::launch::async, [this, text] { return client_.call(bytes_of(text), 10s); });
        } else if (pending_.wait_for(0s) == std::future_status::ready) {
            const Reply reply = pending_.get();
            if (reply.status == CallStatus::ok && reply.text() == text) {
                ++calls_;
                ++noted_.calls;
            } else if (reply.status != CallStatus::shut_down && reply.status != CallStatus::peer_died) {
                ++noted_.wrong;
            }
            ++asked_;
        }
    }

    std::unique_ptr<Segment> segment_;
    Noted& noted_;
    RingWriter writer_;
    CallClient client_;
    std::optional<RingReader> reader_;
    std::optional<CallServer> server_;
    std::future<Reply> pending_;
    bool flowing_ = false;
    std::uint64_t number_ = 0, sequence_ = 0, records_ = 0, calls_ = 0, asked_ = 0;
};

/// Until told to stop; 0 if nothing was wrong.
inline int live(const Link& link, Side side, Notes& notes) {
    auto& noted = notes.side[index_of(side)];
    while (!notes.stop) {
        Visit visit(link, side, noted);
        while (!notes.stop && !visit.over()) {
            visit.turn();
            std::this_thread::sleep_for(50us);
        }
    }
    return noted.wrong == 0 ? 0 : 1;
}

} // namespace tandem::shm::test
