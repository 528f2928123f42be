// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/shared_copy.hpp"
#include "shm/ring/ring_consumer.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tandem::shm {

/// Private memory for messages that their user reads more than once. A payload in a chunk stays in shared memory, where its
/// writer may change it between a check and the use. Users that read each byte once need no copy. [one thread]
class MessageSnapshot {
  public:
    /// Returns the payload, after copying it once if it is in a chunk. Valid until the next call or the next read of the
    /// ring.
    std::span<const std::byte> of(const Record& record) {
        if (record.front != nullptr) return record.bytes; // already a private copy
        const std::size_t words = round_up(record.bytes.size(), word_bytes) / word_bytes;
        if (words > memory_.size()) memory_.resize(words);
        copy_from_shared(memory_.data(), record.bytes.data(), record.bytes.size());
        return std::as_bytes(std::span(memory_)).first(record.bytes.size());
    }

  private:
    std::vector<std::uint64_t> memory_; ///< words, for their alignment; as long as the longest message so far
};

} // namespace tandem::shm
