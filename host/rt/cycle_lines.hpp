// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tandem::rt {

/// The cache lines that a cycle uses. Its rehearsal notes them (note_lines()). A thread with the cycles of many components
/// requests those of the next one while one runs. Together they are more than the caches hold, and without the request
/// each cycle would wait for dozens of lines one after the other.
class CycleLines {
  public:
    static constexpr std::size_t line = 64, longest_run = 16, most_runs = 32;

    void clear() noexcept { count_ = 0; }
    /// Adds the lines of these bytes, at most `longest_run`. Ignores them if there are `most_runs` already.
    void add(const void* begin, std::size_t bytes) noexcept {
        if (count_ == most_runs || bytes == 0) return;
        const auto address = reinterpret_cast<std::uintptr_t>(begin);
        const std::uintptr_t first = address / line, last = (address + bytes - 1) / line;
        runs_[count_++] = first * line + (last - first < longest_run ? last - first : longest_run - 1);
    }
    /// Requests the lines. An address that has become invalid has no effect.
    void prefetch() const noexcept {
        for (std::size_t i = 0; i < count_; ++i) {
            // NOLINTNEXTLINE(performance-no-int-to-ptr): never read, only requested
            const auto* const first = reinterpret_cast<const std::byte*>(runs_[i] / line * line);
            for (std::size_t more = 0; more <= runs_[i] % line; ++more)
                __builtin_prefetch(first + more * line, 1);
        }
        // GCC omits calls of a function that does nothing but prefetch.
        std::atomic_signal_fence(std::memory_order_seq_cst);
    }
    std::size_t count() const noexcept { return count_; }

  private:
    std::size_t count_ = 0;
    std::array<std::uintptr_t, most_runs>
        runs_{}; // address of the first line, plus the number of further ones
};

/// Where note_lines() adds lines; NULL: nowhere. Like `this_thread_rehearses` (rehearsal.hpp).
extern constinit thread_local CycleLines* this_thread_lines [[gnu::tls_model("initial-exec")]];

/// Reports, in a rehearsal, an object that the cycle uses.
inline void note_lines(const void* begin, std::size_t bytes) noexcept {
    if (this_thread_lines != nullptr) this_thread_lines->add(begin, bytes);
}

} // namespace tandem::rt
