// SPDX-License-Identifier: Apache-2.0
// Traces: what a component did, tick by tick, as records of doubles in a memory-mapped file. Recording costs
// a few stores and no system call per tick; what was recorded outlives a kill -9 of the process. A restarted
// component goes on where the killed one stopped.
//
//   offset 0      TraceHeader, then `columns` names of trace_name_bytes each, padded to one page
//   offset 4096   records, `columns` doubles each; `committed` of them are valid
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

struct TraceHeader {
    char magic[8];
    std::uint32_t version;
    std::uint32_t columns;
    std::uint64_t committed; // stored with release after the record's doubles
};
static_assert(sizeof(TraceHeader) == 24);

inline constexpr std::size_t trace_name_bytes = 24; // NUL-terminated
inline constexpr std::size_t trace_header_bytes = 4096;
inline constexpr std::size_t max_trace_columns =
    (trace_header_bytes - sizeof(TraceHeader)) / trace_name_bytes;

/// Names of a record's columns, one per double; specialised beside each record type in records.hpp.
using ColumnNames = std::span<const char* const>;

/// One writer per file, one thread. Growing the file (every 8192 records) is the only time it enters the
/// kernel; when the disk is full then, recording ends and dropped() counts.
class TraceFile {
  public:
    /// Creates `path`, or continues it when it is a trace with the same columns and nobody else writes it.
    /// Throws InputError otherwise.
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
    TraceHeader* header_ = nullptr;
    double* chunk_ = nullptr;
    std::uint64_t chunk_number_ = 0, count_ = 0, dropped_ = 0;
};

/// Reads a trace, also while it is being written. Every count in the file is checked before it is used.
class TraceReader {
  public:
    /// Throws InputError when the file is no trace with these columns.
    TraceReader(const std::string& path, ColumnNames columns);
    ~TraceReader();
    TraceReader(const TraceReader&) = delete;
    TraceReader& operator=(const TraceReader&) = delete;

    std::uint64_t size() const; // records committed by now
    /// Doubles of records [first, first + count), fewer when there are fewer.
    std::vector<double> read(std::uint64_t first, std::uint64_t count) const;

  private:
    std::string path_;
    int file_ = -1;
    std::size_t columns_;
};

/// Whether `path` exists and is not empty: a host that has not come yet has left no trace.
bool trace_exists(const std::string& path);

} // namespace tandem::wheelchair
