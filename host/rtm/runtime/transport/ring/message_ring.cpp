// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include <coil/UUID.h>
#include <new>
#include <unistd.h>

namespace RTC {
namespace {

using tandem::shm::Error;
using tandem::shm::Segment;
using tandem::shm::Side;

constexpr std::string_view ring_link_prefix = "rtm-messages-";
constexpr char ring_name[] = "messages", calls_name[] = "calls", state_name[] = "state";
constexpr std::uint64_t contract = 0x52494e47'00000002; // "RING", and the version of what is in the segment
// The reader holds one of the chunks and two are in transit. A chunk takes memory only when it is first used.
constexpr tandem::shm::RingOptions ring_options{.writer = Side::first,
                                                .max_record = std::size_t{16} * 1024,
                                                .capacity = std::size_t{64} * 1024,
                                                .chunk_bytes = MessageRingWriter::max_message_bytes,
                                                .chunks = 3};
// The calls have no arguments, and one byte as their result. One thread serves them. The second slot is for the message
// after one that had no answer in time.
constexpr tandem::shm::CallQueueOptions call_options{.callers = Side::first, .slots = 2, .max_bytes = 1};

tandem::shm::JoinOptions join_options() {
    tandem::shm::JoinOptions options;
    options.arena_bytes = tandem::shm::ring_memory(ring_name, ring_options).without_chunks +
                          tandem::shm::call_queue_size(call_options) + 4096;
    options.sparse = true;
    options.contract = contract;
    return options;
}
tandem::shm::JoinOptions writer_options() {
    auto options = join_options();
    options.chunk_pool_bytes = tandem::shm::ring_memory(ring_name, ring_options).total;
    return options;
}

// The name comes from the other process. join() would create a missing segment, even under the name of another link.
const std::string& require_prefix(const std::string& link) {
    if (!link.starts_with(ring_link_prefix))
        throw Error("link '" + link + "': not a name of a segment for messages");
    return link;
}

} // namespace

MessageRingWriter::MessageRingWriter()
    // No other link has that name. Otherwise a segment of another container with the same /dev/shm could be joined.
    : link_(std::string(ring_link_prefix) + coil::UUID_Generator().generateUUID()->to_string()),
      segment_(Segment::join(link_, Side::first, writer_options())) {
    tandem::shm::install_truncation_guard();
    state_ = new (segment_->add_blob(state_name, sizeof(RingState)).data()) RingState{};
    const auto ring = segment_->add_ring(ring_name, ring_options);
    if (!give_memory(ring)) throw Error(segment_->path() + ": no memory left in /dev/shm");
    writer_.emplace(ring);
    // The component waits in its cycle, so it sleeps, as in a call of the ORB.
    calls_.emplace(segment_->add_call_queue(calls_name, call_options),
                   tandem::shm::WaitOptions{.mode = tandem::shm::WaitMode::futex});
    segment_->publish();
}

MessageRingWriter::~MessageRingWriter() = default;

void MessageRingWriter::remove_name() { ::unlink(segment_->path().c_str()); }

bool MessageRingWriter::write(std::span<const std::byte> message) {
    return state_->accepts_messages.load(std::memory_order_relaxed) != 0 && write_if_read(message);
}

bool MessageRingWriter::write_for_server(std::span<const std::byte> message) {
    return state_->serves_calls.load(std::memory_order_acquire) != 0 && write_if_read(message);
}

bool MessageRingWriter::write_if_read(std::span<const std::byte> message) {
    return !writer_->corrupt() && is_read() && writer_->has_room(message.size()) &&
           writer_->write(message, 0);
}

bool MessageRingWriter::is_refused() const {
    // Placed after the write of the message: either this load sees that the message is refused, or the reader, which
    // looks into the ring after its store, sees the message.
    std::atomic_thread_fence(std::memory_order_seq_cst);
    return state_->accepts_messages.load(std::memory_order_relaxed) == 0;
}

tandem::shm::ReplyView MessageRingWriter::call_server(std::chrono::milliseconds timeout) {
    const auto status = calls_->call_into({}, timeout, answer_);
    return {status, answer_};
}

// Checks every 10 ms, because a check takes a system call: whether the other process holds its lock, and since when it has
// not read the waiting messages. The latter also finds a process that has ended while a child of clone() holds its lock.
bool MessageRingWriter::is_read() {
    constexpr std::uint64_t pause_ns = 10'000'000;
    const std::uint64_t now_ns = clock_.now_ns();
    if (now_ns - checked_at_ns_ < pause_ns) return is_read_;
    checked_at_ns_ = now_ns;
    const auto counters = writer_->counters();
    if (counters.received != received_ || counters.waiting() == 0) read_at_ns_ = now_ns;
    received_ = counters.received;
    is_read_ =
        segment_->peer_state_by_lock() == tandem::shm::PeerState::alive &&
        now_ns - read_at_ns_ < static_cast<std::uint64_t>(std::chrono::nanoseconds(max_unread).count());
    return is_read_;
}

MessageRingReader::MessageRingReader(const std::string& link)
    : segment_(Segment::join(require_prefix(link), Side::second, join_options())) {
    tandem::shm::install_truncation_guard();
    const auto state = segment_->find_blob(Side::first, state_name);
    const auto ring = segment_->find_ring(Side::first, ring_name);
    // join() creates a missing segment: in another container the link is a different one.
    calls_ = segment_->find_call_queue(Side::first, calls_name);
    if (!state || !ring || !calls_ || state->size() != sizeof(RingState))
        throw Error(segment_->path() + ": was not made by the sender");
    state_ = reinterpret_cast<RingState*>(state->data());
    // Spares the cycles of components page faults in the segment.
    ring->mapping->touch(
        std::as_bytes(std::span(ring->view.cells, ring->view.capacity / sizeof *ring->view.cells)));
    reader_.emplace(*ring);
}

MessageRingReader::~MessageRingReader() { accept_messages(false); }

bool MessageRingReader::is_corrupt() const { return reader_->corrupt(); }

void MessageRingReader::accept_messages(bool accept) {
    if (accepts_ == accept) return;
    accepts_ = accept;
    state_->accepts_messages.store(accept ? 1 : 0, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_seq_cst); // see MessageRingWriter::is_refused()
}

std::optional<std::span<const std::byte>> MessageRingReader::read() {
    const auto* const record = reader_->read();
    return record == nullptr ? std::nullopt : std::optional(record->bytes);
}

} // namespace RTC
