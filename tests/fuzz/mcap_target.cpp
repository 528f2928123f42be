// SPDX-License-Identifier: Apache-2.0
// Recordings of other programs, truncated and damaged ones. Each is read as far as possible or refused with one line, and no
// message comes from outside its file.
#include "apps/tandem/mcap/check_file.hpp"
#include "tests/apps/tandem/mcap/sample.hpp"

#include <cstdint>

using namespace tandem::mcap;
using tandem::test::sample;
using tandem::test::TemporaryFile;

namespace {

/// Files of ours, with and without chunks, compression and summary.
const std::vector<Bytes>& examples() {
    static const std::vector<Bytes> files = [] {
        std::vector<Bytes> made;
        for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd})
            for (const std::size_t chunk_size : {0, 300})
                for (const bool statistics : {true, false}) {
                    WriterOptions options{
                        .library = "fuzz", .compression = compression, .chunk_size = chunk_size};
                    options.summary.statistics = statistics;
                    made.push_back(sample(30, options));
                }
        return made;
    }();
    return files;
}

/// One of the examples with some of its bytes changed, and perhaps cut; or the header of one and then any bytes.
Bytes file_of(const std::uint8_t* data, std::size_t size) {
    if (size < 8) return {};
    Bytes file = examples()[data[0] % examples().size()];
    const std::size_t count = data[1] % 8, header = sizeof(magic) + 9 + 8 + 4;
    if (data[2] % 4 == 0) {
        file.resize(header);
        for (std::size_t i = 3; i < size; ++i) file.push_back(std::byte{data[i]});
        return file;
    }
    for (std::size_t i = 0; i < count && 3 + 4 * i + 4 <= size; ++i) {
        const std::uint8_t* change = data + 3 + 4 * i;
        // Small and large values alike: most fields are lengths and offsets.
        const std::size_t at = (std::size_t{change[0]} << 8U | change[1]) % file.size();
        file[at] = change[2] % 3 == 0   ? std::byte{change[3]}
                   : change[2] % 3 == 1 ? std::byte{0xFF}
                                        : std::byte{0};
    }
    if (data[2] % 4 == 1)
        file.resize(header + (std::size_t{data[size - 1]} << 8U | data[size - 2]) % file.size());
    return file;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const TemporaryFile place;
    const Bytes bytes = file_of(data, size);
    place.set(bytes);
    try {
        McapReader reader(place.path());
        for (const bool by_time : {false, true}) {
            auto messages = reader.messages({.in_log_time_order = by_time});
            std::uint64_t last = 0;
            while (const auto message = messages.next()) {
                if (by_time && message->log_time < last && !reader.contents().by_summary) __builtin_trap();
                last = message->log_time;
                if (!reader.contents().channels.contains(message->channel_id)) __builtin_trap();
            }
        }
        for (const auto& index : reader.contents().attachments) reader.attachment_data(index);
        for (const auto& index : reader.contents().metadata) reader.metadata(index);
    } catch (const Error&) {
    }
    try {
        check_file(place.path());
    } catch (const Error&) {
    }
    return 0;
}
