// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"

#include <string>
#include <string_view>

namespace tandem::test {

inline mcap::ByteView bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// Keeps the written bytes until there is no more room.
struct MemorySink : mcap::Sink {
    void write(mcap::ByteView more) override {
        if (more.size() > room - bytes.size()) throw mcap::Error("no room");
        bytes.insert(bytes.end(), more.begin(), more.end());
    }
    void flush() override { flushed = bytes.size(); }
    mcap::Bytes bytes;
    std::size_t flushed = 0, room = SIZE_MAX;
};

} // namespace tandem::test
