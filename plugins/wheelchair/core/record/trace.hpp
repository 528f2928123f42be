// SPDX-License-Identifier: Apache-2.0
// Traces record the behaviour of a component per tick, as records of doubles in a memory-mapped file. A record costs a
// few stores and no system call, and survives a SIGKILL of the process. A restarted component continues the file. The
// file's layout, in native byte order:
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

/// The start of the file.
struct TraceHeader {
    char magic[8];
    std::uint32_t version;
    std::uint32_t columns;
    std::uint64_t committed; // number of valid records; stored with release order after a record
};
static_assert(sizeof(TraceHeader) == 24);

inline constexpr std::size_t trace_name_bytes = 24; // NUL-terminated
inline constexpr std::size_t trace_header_bytes = 4096;
inline constexpr std::size_t max_trace_columns =
    (trace_header_bytes - sizeof(TraceHeader)) / trace_name_bytes;

/// Names of a record's columns, one per double (column_names() in records.hpp).
using ColumnNames = std::span<const char* const>;

/// Writes a trace. One writer per file, in one thread. Enters the kernel only every 8192 records, to grow the file. If
/// the disk is full then, recording ends and dropped() counts the lost records.
class TraceFile {
  public:
    /// Creates the file, or continues it if it is a trace with the same columns. Throws InputError if it is another
    /// file, if another process writes it, or if there is no room for further records.
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
    double* chunk_ = nullptr; // part of the file that is mapped for writing
    std::uint64_t chunk_number_ = 0, count_ = 0, dropped_ = 0;
};

/// Reads a trace, even while it is being written. Checks every count; a damaged file is an error.
class TraceReader {
  public:
    /// Throws InputError unless the file is a trace with these columns.
    TraceReader(const std::string& path, ColumnNames columns);
    ~TraceReader();
    TraceReader(const TraceReader&) = delete;
    TraceReader& operator=(const TraceReader&) = delete;

    std::uint64_t size() const; // number of records so far
    /// Returns the doubles of records [first, first + count), as far as they exist.
    std::vector<double> read(std::uint64_t first, std::uint64_t count) const;

  private:
    std::string path_;
    int file_ = -1;
    std::size_t columns_;
};

/// Returns whether the file exists and is not empty. A component that was never activated has written no trace.
bool trace_exists(const std::string& path);

} // namespace tandem::wheelchair
