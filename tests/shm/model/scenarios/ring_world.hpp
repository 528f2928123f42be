// SPDX-License-Identifier: Apache-2.0
// A ring in the model: both ends of it, records whose content tells which one they are, and what must hold.
#pragma once
#include "shm/ring/ring_consumer.hpp"
#include "shm/ring/ring_producer.hpp"
#include "tests/shm/model/checker/model.hpp"

namespace tandem::shm::model {

struct RingShape {
    std::uint64_t lines = 4; ///< one of them always stays empty
    std::uint64_t start = 0; ///< position of the first record, lines
    std::uint64_t max_record = 112;
    std::uint32_t chunks = 0; ///< of chunk_bytes
};

class RingWorld {
  public:
    using A = ModelAtomics;
    static constexpr std::uint64_t second = 1'000'000'000;
    static constexpr std::size_t one_line = 8, two_lines = 56, chunk_bytes = 128;

    RingWorld(Execution& execution, const RingShape& shape)
        : execution_(execution), cells_(std::make_unique<A::Cell[]>(shape.lines * 8)),
          chunks_(std::make_unique<A::Cell[]>(shape.chunks * chunk_bytes / 8)),
          chunk_words_(std::make_unique<layout::BasicChunkWords<A>[]>(shape.chunks)), view_(view_of(shape)) {
        header_.head.store(shape.start * 64, Order::relaxed);
        header_.newest.store(shape.start * 64, Order::relaxed);
        header_.tail.store(shape.start * 64, Order::relaxed);
        next_ = shape.start * 64;
        writer = std::make_unique<RingProducer<A>>(view_);
        reader = std::make_unique<RingConsumer<A>>(view_);
    }

    /// Returns false if the record was dropped. Its payload begins with the number that it must get.
    bool write(std::size_t bytes) {
        const auto payload = payload_of(accepted_ + 1, bytes);
        ++tried_;
        if (bytes > view_.max_record) return write_in_chunk(payload, bytes);
        note_place(bytes);
        // Every second message goes as a channel sends numbers, unless that would take a detour.
        const std::uint64_t stamp = stamp_of(accepted_ + 1);
        const bool accepted =
            (accepted_ % 2 == 1 && bytes % 8 == 0 &&
             writer->write_words_behind_last(payload[0], &payload[1], bytes / 8 - 1, stamp)) ||
            writer->write(payload.data(), bytes, stamp);
        count(accepted, bytes);
        return accepted;
    }
    /// Writes a message by reserve() and commit(), with less than was reserved. First abandons another reservation.
    bool write_reserved(std::size_t reserved, std::size_t bytes) {
        using Reservation = typename RingProducer<A>::Reservation;
        ++tried_;
        require(writer->reserve(reserved) == Reservation::scratch,
                "a short payload is made in scratch memory");
        writer->cancel_reservation();
        require(writer->reserve(reserved) == Reservation::scratch,
                "what was abandoned can be reserved again");
        note_place(bytes);
        const auto payload = payload_of(accepted_ + 1, bytes);
        const bool accepted = writer->commit(payload.data(), bytes, stamp_of(accepted_ + 1));
        count(accepted, bytes);
        return accepted;
    }

    bool read(bool newest = false) {
        const Record* const record = newest ? reader->read_newest() : reader->read();
        if (record) check(*record, is_in_chunk(*record));
        return record != nullptr;
    }
    void set_depth(std::uint64_t depth) {
        depth_ = depth;
        reader->set_depth(depth);
    }
    /// Another writer continues from the place at which the previous one has ended.
    void new_writer() { writer = std::make_unique<RingProducer<A>>(view_); }

    /// At rest: all that can be read is read, and everything adds up. `whole`: no end was killed.
    /// `newest_first`: begins with the newest.
    void check_at_end(bool whole = true, bool newest_first = false) {
        require(!writer->corrupt() && !reader->corrupt(), "no honest end makes a ring corrupt");
        const std::uint64_t seen_before = last_;
        if (whole) require_sum(waiting());
        if (whole && newest_first && read(true))
            require(last_ == accepted_, "the newest record is read at once");
        if (whole && read())
            require(depth_ == 0 || accepted_ - last_ < depth_, "what is read is within the depth");
        while (read()) {
        }
        require(reader->empty() && !reader->corrupt(), "the ring can be emptied");
        if (whole) {
            require(last_ == accepted_, "the newest record is read last");
            require(waiting() == 0, "nothing waits in an empty ring");
            require_sum(0);
            const auto get = [](auto& word) { return word.load(Order::relaxed); };
            check_writer();
            require(get(header_.received) == received_, "the reader's counts");
            require(get(header_.bytes_received) == bytes_received_ && get(header_.bytes_sent) == bytes_sent_,
                    "the bytes of both ends");
            check_all_chunks_are_free();
        } else {
            // A killed writer may have dropped its last record already, for one that it did not finish.
            require(last_ <= accepted_ + 1, "nothing is read that was not published");
            require(last_ >= seen_before, "records stay in order");
        }
    }
    /// With the reader gone, the writer fills every chunk without dropping a record.
    void check_all_chunks_are_free() {
        reader.reset();
        const std::uint64_t dropped = header_.overwritten.load(Order::relaxed);
        for (std::uint32_t i = 0; i < view_.chunk_count; ++i) {
            require(write(chunk_bytes), "a chunk is free");
            require(header_.overwritten.load(Order::relaxed) == dropped, "every chunk has come back");
        }
    }
    void check_writer() {
        require(!writer->corrupt(), "no honest end makes a ring corrupt");
        require(header_.published.load(Order::relaxed) == accepted_ &&
                    header_.sent.load(Order::relaxed) == tried_,
                "the writer's counts");
    }
    std::uint64_t last() const { return last_; }
    std::uint64_t received() const { return received_; }
    RingView<A>& view() { return view_; }
    void require(bool holds, const char* claim) { execution_.require(holds, claim); }

  private:
    using Payload = std::array<std::uint64_t, chunk_bytes / 8>;

    RingView<A> view_of(const RingShape& shape) {
        RingView<A> view;
        view.shared = &header_;
        view.cells = cells_.get();
        view.capacity = shape.lines * 64;
        view.max_record = shape.max_record;
        view.chunk_bytes = shape.chunks != 0 ? chunk_bytes : 0;
        view.chunk_count = shape.chunks;
        view.chunk_words = chunk_words_.get();
        view.chunks = reinterpret_cast<std::byte*>(chunks_.get());
        return view;
    }

    static std::uint64_t stamp_of(std::uint64_t sequence) { return 1000 + sequence; }
    static Payload payload_of(std::uint64_t sequence, std::size_t bytes) {
        Payload payload{};
        for (std::size_t i = 0; i < bytes / 8; ++i) payload[i] = sequence * 1000 + i;
        payload[0] = bytes << 32U | sequence;
        return payload;
    }

    /// Notes where the next record begins.
    void note_place(std::size_t bytes) {
        const std::uint64_t record = record_size(bytes > view_.max_record ? sizeof(ChunkReference) : bytes);
        const std::uint64_t room = view_.bytes_to_end(next_);
        if (record > room) next_ += room;
        starts_.push_back(next_);
        next_ += record;
    }

    bool write_in_chunk(const Payload& payload, std::size_t bytes) {
        note_place(bytes);
        if (writer->reserve(bytes) == RingProducer<A>::Reservation::refused) return false;
        A::copy_plain_to_shared(reinterpret_cast<A::Cell*>(writer->chunk()), payload.data(), bytes);
        const bool accepted = writer->commit(nullptr, bytes, stamp_of(accepted_ + 1));
        count(accepted, bytes);
        return accepted;
    }

    void count(bool accepted, std::size_t bytes) {
        accepted_ += accepted ? 1 : 0;
        bytes_sent_ += accepted ? bytes : 0;
    }
    bool is_in_chunk(const Record& record) const { return record.bytes.size() > view_.max_record; }

    /// `shared`: the bytes are cells of the model.
    void check(const Record& record, bool shared) {
        Payload found{};
        const std::size_t bytes = record.bytes.size();
        require(bytes <= sizeof found && bytes % 8 == 0 && bytes != 0,
                "a record has the length that was written");
        if (shared)
            A::copy_plain_from_shared(found.data(), reinterpret_cast<const A::Cell*>(record.bytes.data()),
                                      bytes);
        else
            std::memcpy(found.data(), record.bytes.data(), bytes);
        require(found == payload_of(record.sequence, bytes), "a record is whole, and has its own number");
        require(record.stamp_ns == stamp_of(record.sequence), "a record has its own stamp");
        require(record.sequence > last_, "no record comes twice or late");
        if (!shared) {
            const auto* cells = view_.cell(starts_[record.sequence - 1]);
            A::settle(cells + 1, 8 + bytes);
        }
        last_ = record.sequence;
        ++received_;
        bytes_received_ += bytes;
    }

    std::uint64_t waiting() const {
        const std::uint64_t head = header_.head.load(Order::relaxed),
                            tail = header_.tail.load(Order::relaxed);
        return head - tail;
    }
    /// sent = received + dropped + waiting; `bytes`: how much waits, at least.
    void require_sum(std::uint64_t bytes) {
        const auto get = [](auto& word) { return word.load(Order::relaxed); };
        const std::uint64_t left = get(header_.sent) - get(header_.received) - get(header_.refused) -
                                   get(header_.overwritten) - get(header_.skipped);
        require(left <= bytes / 64 && (left == 0) == (bytes == 0), "sent = received + dropped + waiting");
    }

    Execution& execution_;
    layout::BasicRingHeader<A> header_{};
    std::unique_ptr<A::Cell[]> cells_, chunks_;
    std::unique_ptr<layout::BasicChunkWords<A>[]> chunk_words_;
    RingView<A> view_;
    std::vector<std::uint64_t> starts_; // by sequence
    std::uint64_t next_ = 0, depth_ = 0;
    std::uint64_t tried_ = 0, accepted_ = 0, bytes_sent_ = 0;    // the writer's
    std::uint64_t last_ = 0, received_ = 0, bytes_received_ = 0; // the reader's

  public: // last, because a reader gives its chunk back when it ends
    std::unique_ptr<RingProducer<A>> writer;
    std::unique_ptr<RingConsumer<A>> reader;
};

} // namespace tandem::shm::model
