// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/record/trace.hpp"

#include <boost/interprocess/file_mapping.hpp>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace tandem::wheelchair {

namespace {

namespace ipc = boost::interprocess;

constexpr char magic[8] = {'T', 'A', 'N', 'D', 'T', 'R', 'C', '\n'};
constexpr std::uint32_t version = 1;
constexpr std::uint64_t chunk_records = 8192; // times 8 bytes: whole pages for any number of columns

// Every message names the file.
[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw InputError("trace " + path + ": " + what);
}

std::string system_error() { return std::strerror(errno); }

// The file grows, and is mapped, in chunks of this size.
std::size_t chunk_bytes(std::size_t columns) { return chunk_records * columns * sizeof(double); }

std::uint64_t file_size(int file) {
    struct stat info {};
    return fstat(file, &info) == 0 ? static_cast<std::uint64_t>(info.st_size) : 0;
}

/// The first page of a new file with these columns.
std::vector<char> header_page(ColumnNames columns) {
    std::vector<char> page(trace_header_bytes);
    TraceHeader header{};
    std::copy(std::begin(magic), std::end(magic), header.magic);
    header.version = version;
    header.columns = static_cast<std::uint32_t>(columns.size());
    std::memcpy(page.data(), &header, sizeof header);
    for (std::size_t i = 0; i < columns.size(); ++i)
        std::strncpy(page.data() + sizeof header + i * trace_name_bytes, columns[i], trace_name_bytes - 1);
    return page;
}

/// Empty if the file's first page equals `expected`, apart from the number of records; else what is wrong.
std::string difference(int file, const std::vector<char>& expected) {
    std::vector<char> page(trace_header_bytes);
    if (pread(file, page.data(), page.size(), 0) != static_cast<ssize_t>(page.size()))
        return "too short for a trace";
    if (std::memcmp(page.data(), magic, sizeof magic) != 0) return "not a trace file";
    const std::size_t count_at = offsetof(TraceHeader, committed), names_at = sizeof(TraceHeader);
    if (std::memcmp(page.data(), expected.data(), count_at) != 0 ||
        std::memcmp(page.data() + names_at, expected.data() + names_at, page.size() - names_at) != 0)
        return "another version or other columns; give each component a separate trace file";
    return {};
}

// The number of records that the file claims to have, checked against its size.
std::uint64_t committed(int file, const std::string& path, std::size_t columns) {
    std::uint64_t count = 0;
    if (pread(file, &count, sizeof count, offsetof(TraceHeader, committed)) != sizeof count)
        fail(path, "header cannot be read");
    const std::uint64_t room =
        (file_size(file) - std::min<std::uint64_t>(file_size(file), trace_header_bytes)) /
        (columns * sizeof(double));
    if (count > room)
        fail(path, "claims " + std::to_string(count) + " records but has room for " + std::to_string(room) +
                       "; the file is damaged");
    return count;
}

/// Maps a part of the file. Returns an empty region, with errno, if that fails.
ipc::mapped_region map(const std::string& path, off_t offset, std::size_t bytes) {
    try {
        return {ipc::file_mapping(path.c_str(), ipc::read_write),
                ipc::read_write,
                offset,
                bytes,
                nullptr,
                MAP_POPULATE};
    } catch (const ipc::interprocess_exception& error) {
        errno = error.get_native_error();
        return {};
    }
}

} // namespace

TraceFile::TraceFile(const std::string& path, ColumnNames columns) : path_(path), columns_(columns.size()) {
    if (columns.empty() || columns.size() > max_trace_columns) fail(path, "number of columns out of bounds");
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file_ < 0) fail(path, "cannot be opened for writing: " + system_error());
    // The destructor does not run when the constructor throws.
    try {
        open_or_create(columns);
    } catch (...) {
        close(file_);
        throw;
    }
}

void TraceFile::open_or_create(ColumnNames columns) {
    // Two writers would overwrite each other's records. The kernel releases the lock when the process ends.
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) fail(path_, "another component writes it");
    // An empty file is a new one; any other must begin with the same page.
    const auto page = header_page(columns);
    if (file_size(file_) == 0 &&
        pwrite(file_, page.data(), page.size(), 0) != static_cast<ssize_t>(page.size()))
        fail(path_, "cannot be written: " + system_error());
    if (const auto wrong = difference(file_, page); !wrong.empty()) fail(path_, wrong);
    count_ = committed(file_, path_, columns_);
    header_ = map(path_, 0, trace_header_bytes);
    if (header_.get_address() == nullptr) fail(path_, "cannot be mapped: " + system_error());
    if (!map_chunk(count_ / chunk_records)) fail(path_, "no room to record: " + system_error());
}

TraceFile::~TraceFile() {
    if (file_ >= 0) close(file_);
}

// Allocates and touches the whole chunk, so that no tick meets a page fault or a full disk within it.
bool TraceFile::map_chunk(std::uint64_t chunk) {
    const auto bytes = chunk_bytes(columns_);
    const auto offset = static_cast<off_t>(trace_header_bytes + chunk * bytes);
    chunk_ = {};
    errno = posix_fallocate(file_, offset, static_cast<off_t>(bytes));
    if (errno != 0) return false;
    chunk_ = map(path_, offset, bytes);
    chunk_number_ = chunk;
    return chunk_.get_address() != nullptr;
}

void TraceFile::append(std::span<const double> record) {
    // After the first lost record nothing more is written: a trace has no gaps, it only ends early.
    const bool full =
        dropped_ > 0 || (count_ / chunk_records != chunk_number_ && !map_chunk(count_ / chunk_records));
    if (full || record.size() != columns_) {
        ++dropped_;
        return;
    }
    // Release order: a reader that sees the new count also sees the record.
    auto* const chunk = static_cast<double*>(chunk_.get_address());
    std::copy(record.begin(), record.end(), chunk + (count_ % chunk_records) * columns_);
    std::atomic_ref<std::uint64_t>(static_cast<TraceHeader*>(header_.get_address())->committed)
        .store(++count_, std::memory_order_release);
}

TraceReader::TraceReader(const std::string& path, ColumnNames columns)
    : path_(path), columns_(columns.size()) {
    file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) fail(path, "cannot be read: " + system_error());
    if (const auto wrong = difference(file_, header_page(columns)); !wrong.empty()) {
        close(file_);
        fail(path, wrong);
    }
}

TraceReader::~TraceReader() { close(file_); }

std::uint64_t TraceReader::size() const { return committed(file_, path_, columns_); }

std::vector<double> TraceReader::read(std::uint64_t first, std::uint64_t count) const {
    // Records up to this count are complete and never change, so no lock is needed.
    const std::uint64_t have = size();
    if (first >= have) return {};
    std::vector<double> out(std::min(count, have - first) * columns_);
    const auto bytes = out.size() * sizeof(double);
    std::size_t done = 0;
    while (done < bytes) {
        const auto at = trace_header_bytes + first * columns_ * sizeof(double) + done;
        const auto got =
            pread(file_, reinterpret_cast<char*>(out.data()) + done, bytes - done, static_cast<off_t>(at));
        if (got <= 0) fail(path_, "cannot be read: " + system_error());
        done += static_cast<std::size_t>(got);
    }
    return out;
}

void discard_records(const std::string& path, ColumnNames columns, std::uint64_t count) {
    const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) return;
    fallocate(file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(trace_header_bytes),
              static_cast<off_t>(count * columns.size() * sizeof(double)));
    close(file);
}

bool trace_exists(const std::string& path) {
    struct stat info {};
    return stat(path.c_str(), &info) == 0 && info.st_size > 0;
}

} // namespace tandem::wheelchair
