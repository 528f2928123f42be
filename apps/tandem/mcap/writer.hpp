// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/compression.hpp"
#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/mcap/write/summary_builder.hpp"

#include <string_view>

namespace tandem::mcap {

struct WriterOptions {
    std::string library = {}; ///< program and version of the writer; `mcap doctor` expects one
    std::string profile = {}; ///< specification: registry.md, "Well-known profiles"; none applies here
    Compression compression = Compression::none; ///< a chunk that does not shrink is stored uncompressed
    std::size_t chunk_size = 1 << 20; ///< limit in bytes for a chunk; 0: messages outside of chunks
    bool message_indexes = true;
    SummaryParts summary = {};
};

/// Writes an MCAP file. A full chunk goes to the sink at once and is flushed, so readers find everything before it if
/// the process is killed. After the first message of each channel, a message needs no allocation until the chunk is
/// full. Every function throws Error, including errors of the sink. [one thread at a time]
class McapWriter {
  public:
    /// Writes the start of the file. `sink` must outlive the writer.
    McapWriter(Sink& sink, WriterOptions options);
    ~McapWriter(); ///< Writes nothing: without close(), the file looks like that of a killed process.

    /// `encoding` and `data`: see the specification's registry.md, for example "omgidl" and IDL text. At most 65,535
    /// schemas.
    std::uint16_t add_schema(std::string name, std::string encoding, ByteView data);
    /// `schema` 0: messages describe themselves. At most 65,535 channels.
    std::uint16_t add_channel(std::string topic, std::uint16_t schema, std::string message_encoding,
                              StringMap metadata = {});
    /// Times in nanoseconds. `sequence`: publisher's message count on this topic, including lost messages.
    void write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time,
               std::uint64_t publish_time, ByteView data);
    /// Stores a file's content before the current chunk. Times in nanoseconds; `create_time` 0: unknown.
    void attach(const std::string& name, const std::string& media_type, std::uint64_t log_time,
                std::uint64_t create_time, ByteView data);
    void add_metadata(const std::string& name, const StringMap& metadata);

    /// Ends the chunk and passes all bytes to the operating system.
    void flush();
    /// Ends the file: chunk, end of data, summary, footer. Write nothing afterwards.
    void close();
    /// What is in the file after end_at_last_chunk().
    struct Rest {
        bool closed = false; ///< the file has its summary and its end
        std::uint64_t messages = 0, lost_messages = 0;
    };
    /// Ends the file after an Error of the sink: drops everything after the last chunk or flush, and closes the file there
    /// if the sink can. The room for it was reserved with that chunk. Write nothing afterwards.
    Rest end_at_last_chunk();
    std::uint64_t messages() const { return summary_.messages(); }
    std::uint64_t bytes_written() const { return position_; } ///< without the current chunk

  private:
    void require_open() const;
    void end_chunk();
    void finish();
    void set_mark();
    void output(ByteView bytes);
    template <typename Definition>
    void add_definition(const Definition& definition);

    Sink& sink_;
    const WriterOptions options_;
    Compressor compressor_;
    ChunkBuilder chunk_;
    SummaryBuilder summary_;
    Bytes scratch_;
    std::uint64_t position_ = 0;
    std::uint32_t crc_ = 0; // of all bytes up to position_
    std::uint32_t schemas_ = 0, channels_ = 0;
    bool closed_ = false;
    struct {
        std::uint64_t position = 0;
        std::uint32_t crc = 0;
        SummaryBuilder::Mark summary;
    } mark_; ///< after the last chunk or flush
};

} // namespace tandem::mcap
