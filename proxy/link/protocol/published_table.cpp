// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/published_table.hpp"

#include "proxy/link/protocol/link_error.hpp"
#include "shm/os/shared_copy.hpp"

#include <cstring>

namespace tandem::link {
namespace {

constexpr std::size_t head_bytes = 2 * shm::word_bytes, tail_bytes = shm::word_bytes;
// Room for ports that are added later, in addition to twice the size of the first table.
constexpr std::size_t room_for_changes = std::size_t{8} * 1024;

std::uint64_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

} // namespace

std::size_t published_table_bytes(std::size_t encoded_bytes, bool may_change) {
    const std::size_t room = may_change ? 2 * encoded_bytes + room_for_changes : encoded_bytes;
    return head_bytes + shm::round_up(room, shm::word_bytes) + tail_bytes;
}

bool write_published_table(std::span<std::byte> blob, std::span<const std::byte> encoded,
                           std::uint64_t version) {
    if (blob.size() < head_bytes + shm::round_up(encoded.size(), shm::word_bytes) + tail_bytes) return false;
    shm::store_word(blob.data() + blob.size() - tail_bytes, version);
    shm::store_word(blob.data() + shm::word_bytes, encoded.size());
    shm::copy_to_shared(blob.data() + head_bytes, encoded.data(), encoded.size());
    shm::store_word(blob.data(), version);
    return true;
}

std::uint64_t published_version(std::span<const std::byte> blob) {
    return blob.size() < shm::word_bytes ? 0 : shm::load_word(blob.data());
}

std::optional<PublishedTable> read_published_table(std::span<const std::byte> copy) {
    if (copy.size() < head_bytes + tail_bytes) throw LinkError("the port table is cut short");
    const std::uint64_t version = word_at(copy, 0), bytes = word_at(copy, shm::word_bytes);
    if (word_at(copy, copy.size() - tail_bytes) != version) return std::nullopt;
    if (bytes > copy.size() - head_bytes - tail_bytes) throw LinkError("the port table is damaged");
    return PublishedTable{version, decode_port_table(copy.subspan(head_bytes, bytes))};
}

} // namespace tandem::link
