// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/compression.hpp"
#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/mcap/write/summary_builder.hpp"

#include <string_view>

namespace tandem::mcap {

struct WriterOptions {
    std::string library = {}; ///< program and version that write; `mcap doctor` wants one
    std::string profile = {}; ///< specification: registry.md, "Well-known profiles"; none is ours
    Compression compression = Compression::none; ///< a chunk that does not become smaller is stored as it is
    std::size_t chunk_size =
        1 << 20; ///< a chunk ends before it exceeds this many bytes; 0: messages without chunks
    bool message_indexes = true;
    SummaryParts summary = {};
};

/// Writes an MCAP file. A chunk goes to the sink, and out of the process, as soon as it is full: when the process is
/// killed, the file ends there and readers find all that is before. Once channels have had their first messages, a
/// message costs no allocation until the chunk is full. Every function throws Error, also that of the sink. Used by one
/// thread at a time.
class McapWriter {
  public:
    /// Writes the file's begin. `sink` must outlive the writer.
    McapWriter(Sink& sink, WriterOptions options);
    ~McapWriter(); ///< Writes nothing: without close(), the file is as that of a killed process.

    /// `encoding` and `data` as the specification's registry.md says: "omgidl" and IDL. At most 65,535.
    std::uint16_t add_schema(std::string name, std::string encoding, ByteView data);
    /// Schema 0: messages describe themselves. At most 65,535.
    std::uint16_t add_channel(std::string topic, std::uint16_t schema, std::string message_encoding,
                              StringMap metadata = {});
    /// Times in nanoseconds; `sequence` counts what the publisher sent on this topic, also what was lost.
    void write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time,
               std::uint64_t publish_time, ByteView data);
    /// Stores a file's content in front of the chunk that is being filled. Times in nanoseconds; create time 0: unknown.
    void attach(const std::string& name, const std::string& media_type, std::uint64_t log_time,
                std::uint64_t create_time, ByteView data);
    void add_metadata(const std::string& name, const StringMap& metadata);

    /// Ends the chunk and hands all bytes to the operating system.
    void flush();
    /// Ends the file: chunk, end of data, summary, footer. Nothing may be written afterwards.
    void close();
    std::uint64_t bytes_written() const { return position_; } ///< without the chunk that is being filled

  private:
    void require_open() const;
    void end_chunk();
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
};

} // namespace tandem::mcap
