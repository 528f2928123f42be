// SPDX-License-Identifier: Apache-2.0
// A recording of two topics whose messages follow from their numbers, and files of any bytes.
#pragma once
#include "apps/tandem/mcap/reader.hpp"
#include "tests/apps/tandem/mcap/memory_sink.hpp"

#include <algorithm>
#include <filesystem>
#include <sys/mman.h>
#include <unistd.h>

namespace tandem::test {

/// A file in memory, while this lives: some tests write tens of thousands.
class TemporaryFile {
  public:
    explicit TemporaryFile(mcap::ByteView bytes = {})
        : descriptor_(memfd_create("mcap", MFD_CLOEXEC)),
          path_("/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_)) {
        set(bytes);
    }
    ~TemporaryFile() { close(descriptor_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    void set(mcap::ByteView bytes) const {
        if (ftruncate(descriptor_, 0) != 0 ||
            pwrite(descriptor_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
            throw std::runtime_error("no memory for a file");
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    int descriptor_;
    std::filesystem::path path_;
};

/// Message `number` of the sample, on topic odd or even, has this text; every tenth is empty.
inline std::string sample_text(unsigned number) {
    if (number % 10 == 0) return {};
    return std::to_string(number) + std::string(number % 50, static_cast<char>('a' + number % 26));
}

/// Begins at time 1000 and has a message every nanosecond.
inline mcap::Bytes sample(unsigned messages, const mcap::WriterOptions& options) {
    MemorySink sink;
    mcap::McapWriter writer(sink, options);
    const auto schema = writer.add_schema("Number", "omgidl", bytes_of("struct Number { long n; };"));
    const auto even = writer.add_channel("even", schema, "cdr", {{"link", "robot"}});
    const auto odd = writer.add_channel("odd", 0, "text");
    writer.add_metadata("host", {{"name", "arm"}, {"tick", "10 ms"}});
    for (unsigned i = 0; i < messages; ++i)
        writer.write(i % 2 == 0 ? even : odd, i / 2, 1000 + i, 999 + i, bytes_of(sample_text(i)));
    writer.attach("arm.idl", "text/plain", 5, 0, bytes_of("module arm {};"));
    writer.close();
    return sink.bytes;
}

/// The numbers of the sample's messages in the order in which the cursor gives them; it must end.
inline std::vector<unsigned> numbers(mcap::MessageCursor& cursor) {
    std::vector<unsigned> found;
    while (const auto message = cursor.next()) {
        found.push_back(static_cast<unsigned>(message->log_time - 1000));
        const auto text = sample_text(found.back());
        if (!std::ranges::equal(message->data, bytes_of(text)) ||
            message->publish_time + 1 != message->log_time || message->sequence != found.back() / 2)
            return {~0U}; // no message of the sample
    }
    return found;
}

inline std::vector<unsigned> numbers(mcap::McapReader& reader, mcap::Query query = {}) {
    auto cursor = reader.messages(std::move(query));
    return numbers(cursor);
}

} // namespace tandem::test
