// SPDX-License-Identifier: Apache-2.0
// Internal to the ring: users include ring_reader.hpp.
#pragma once

namespace tandem::shm {

/// [one thread] Keeps a fast reader from slowing down a fast writer. A reader that has caught up takes the
/// cache line away that the writer still writes to, and both run at the speed of these transfers. So the
/// first look that finds nothing after a run of records that came without waiting pauses for about 0.5 us, in
/// which the writer gets ahead. Records that come one by one make no such run and are never delayed.
template <class A>
class ReaderBackoff {
  public:
    void on_record() {
        ++run_;
        empty_looks_ = 0;
    }
    void on_nothing() {
        if (empty_looks_++ == 0 && run_ > long_run)
            for (int i = 0; i < pauses; ++i) A::pause();
        if (empty_looks_ > max_looks_within_run) run_ = 0;
    }

  private:
    static constexpr unsigned max_looks_within_run = 8, long_run = 16;
    static constexpr int pauses = 16;
    unsigned empty_looks_ = max_looks_within_run + 1, run_ = 0; ///< run_: records
};

} // namespace tandem::shm
