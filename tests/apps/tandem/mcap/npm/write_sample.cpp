// SPDX-License-Identifier: Apache-2.0
// write_sample FILE none|lz4|zstd CHUNK_SIZE: writes the sample recording, and prints what a reader must find.
#include "tests/apps/tandem/mcap/sample.hpp"

#include <cstdio>
#include <fstream>

using namespace tandem::mcap;

int main(int, char** arguments) {
    Compression compression = Compression::none;
    for (const auto known : {Compression::lz4, Compression::zstd})
        if (compression_name(known) == std::string(arguments[2])) compression = known;
    const auto bytes = tandem::test::sample(
        300, {.library = "test", .compression = compression, .chunk_size = std::stoul(arguments[3])});
    std::ofstream(arguments[1], std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    McapReader reader(arguments[1]);
    auto messages = reader.messages();
    while (const auto message = messages.next()) {
        const auto& channel = reader.contents().channels.at(message->channel_id);
        std::printf("%s %u %llu %llu %.*s\n", channel.topic.c_str(), message->sequence,
                    static_cast<unsigned long long>(message->log_time),
                    static_cast<unsigned long long>(message->publish_time),
                    static_cast<int>(message->data.size()),
                    reinterpret_cast<const char*>(message->data.data()));
    }
    std::puts("metadata host arm 10 ms\nattachment arm.idl text/plain module arm {};\nschema Number omgidl "
              "struct Number "
              "{ long n; };\nchannel even Number cdr robot\nchannel odd - text -\nstatistics 300 1 2 1 1");
    return messages.problems().empty() ? 0 : 1;
}
