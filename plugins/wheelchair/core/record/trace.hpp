// SPDX-License-Identifier: Apache-2.0
// Traces: what a component did, tick by tick, as records of doubles in a memory-mapped file. Recording costs a few
// stores per tick and no system call, and what was recorded survives a SIGKILL of the process. A restarted component
// continues the file where the killed one stopped. The file's layout, in native byte order:
//
//   offset 0      TraceHeader, then `columns` names of trace_name_bytes each, padded to one page
//   offset 4096   records, `columns` doubles each; `committed` of them are valid
#pragma once

#include <atomic>
#include <boost/interprocess/mapped_region.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// The beginning of the file.
struct TraceHeader {
    char magic[8];
    std::uint32_t version;
    std::uint32_t columns;
    std::uint64_t committed; // number of valid records; stored with release after a record's doubles
};
static_assert(sizeof(TraceHeader) == 24);

inline constexpr std::size_t trace_name_bytes = 24; // NUL-terminated
inline constexpr std::size_t trace_header_bytes = 4096;
inline constexpr std::size_t max_trace_columns =
    (trace_header_bytes - sizeof(TraceHeader)) / trace_name_bytes;

/// Names of a record's columns, one per double (column_names() in records.hpp).
using ColumnNames = std::span<const char* const>;

/// Writes a trace. One writer per file, in one thread. Enters the kernel only to grow the file, every 8192
/// records; if the disk is full then, recording ends and dropped() counts the records that are lost.
class TraceFile {
  public:
    /// Creates the file, or continues it if it is a trace with the same columns. Throws InputError if it is
    /// anything else, if another process writes it, or if there is no room for the next records.
    TraceFile(const std::string& path, ColumnNames columns);
    ~TraceFile();
    TraceFile(const TraceFile&) = delete;
    TraceFile& operator=(const TraceFile&) = delete;

    void append(std::span<const double> record);
    std::uint64_t dropped() const { return dropped_; }

  private:
    void open_or_create(ColumnNames columns);
    bool map_chunk(std::uint64_t chunk);

    std::string path_;
    int file_ = -1;
    std::size_t columns_;
    boost::interprocess::mapped_region header_, chunk_; ///< the chunk is the part that is being written
    std::uint64_t chunk_number_ = 0, count_ = 0, dropped_ = 0;
};

/// Reads a trace, even while it is being written. A damaged file is an error: each count in it is checked.
class TraceReader {
  public:
    /// Throws InputError unless the file is a trace with these columns.
    TraceReader(const std::string& path, ColumnNames columns);
    ~TraceReader();
    TraceReader(const TraceReader&) = delete;
    TraceReader& operator=(const TraceReader&) = delete;

    std::uint64_t size() const; // number of records written by now
    /// Returns the doubles of records [first, first + count), or of those that exist.
    std::vector<double> read(std::uint64_t first, std::uint64_t count) const;

  private:
    std::string path_;
    int file_ = -1;
    std::size_t columns_;
};

/// Frees the room of the first `count` records in the file, while components write it. Readers get zeros for them. Does
/// nothing where the file system cannot do this.
void discard_records(const std::string& path, ColumnNames columns, std::uint64_t count);

/// Returns whether the file exists and is not empty: a component that was not activated yet has written no trace.
bool trace_exists(const std::string& path);

} // namespace tandem::wheelchair
