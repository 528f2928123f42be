// SPDX-License-Identifier: Apache-2.0
// Internal to the ring: users include ring_reader.hpp.
#pragma once
#include <algorithm>

namespace tandem::shm {

/// [one thread] Keeps a fast reader from slowing down a fast writer. A reader that has caught up takes away the cache line
/// that the writer is still writing to, and both run at the speed of these transfers. Therefore, after a run of records
/// with few empty polls between them, the first empty poll pauses for about 0.5 us, and the writer gets ahead. If the
/// writer has written at most one record by then, it waits for something else, for example an answer of this thread, and
/// the pause was only a delay: the next pause comes after a run twice as long.
template <class A>
class ReaderBackoff {
  public:
    void on_record() {
        ++run_;
        empty_looks_ = 0;
    }
    void on_nothing() {
        if (empty_looks_++ == 0) on_caught_up();
        if (empty_looks_ > max_looks_within_run) run_ = paused_at_ = 0; // the effect of the pause is unknown
    }

  private:
    /// Call it at the first look that finds no record.
    void on_caught_up() {
        if (paused_at_ != 0) {
            const bool writer_got_ahead = run_ > paused_at_ + 1;
            long_run_ = writer_got_ahead ? min_long_run : std::min(2 * long_run_, max_long_run);
            if (!writer_got_ahead) run_ = 0;
            paused_at_ = 0;
        }
        if (run_ <= long_run_) return;
        for (int i = 0; i < pauses; ++i) A::pause();
        paused_at_ = run_;
    }

    static constexpr unsigned max_looks_within_run = 8, min_long_run = 16, max_long_run = 1 << 14;
    static constexpr int pauses = 16;
    unsigned empty_looks_ = max_looks_within_run + 1;
    unsigned run_ = 0;                 ///< records
    unsigned long_run_ = min_long_run; ///< after a run of more records, pauses
    unsigned paused_at_ = 0;           ///< run_ at the last pause; 0: its effect is known, or never will be
};

} // namespace tandem::shm
