// SPDX-License-Identifier: Apache-2.0
// The common parts of the cells of one host: the settings that the bench passes, and the samples that it
// reads.
#pragma once

#include "host/rt/periodic_tick.hpp"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace tandem::bench {

/// The environment variable with the settings: number of cells, period in ns, 1 if data moves, folder.
constexpr const char* cells_variable = "TANDEM_BENCH_CELLS";

class Cells {
  public:
    static Cells& all() {
        static Cells cells;
        return cells;
    }
    bool data_moves() const { return data_moves_; }
    std::int64_t lateness_now() const {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        return (now.tv_sec * 1'000'000'000 + now.tv_nsec - rt::grid_origin.count()) % period_ns_;
    }
    /// Reports the first cycle of a cell. When all cells have begun, creates the file `started`.
    void begin() {
        if (++begun_ == count_) publish({}, "started");
    }
    /// Reports that a cell has stopped. After the last one, writes the lateness of all cycles, in ns, to the
    /// file `samples`.
    void end(const std::vector<double>& lateness) {
        const std::lock_guard lock(mutex_);
        samples_.insert(samples_.end(), lateness.begin(), lateness.end());
        if (++ended_ == count_) publish(samples_, "samples");
    }

  private:
    Cells() {
        const char* settings = std::getenv(cells_variable);
        std::istringstream(settings ? settings : "") >> count_ >> period_ns_ >> data_moves_ >> folder_;
    }
    void publish(const std::vector<double>& values, const char* name) const {
        const std::filesystem::path folder(folder_);
        std::ofstream(folder / "part", std::ios::binary)
            .write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size() * sizeof(double)));
        std::filesystem::rename(folder / "part", folder / name);
    }

    int count_ = 0;
    std::int64_t period_ns_ = 1;
    bool data_moves_ = false;
    std::string folder_;
    std::atomic<int> begun_{0};
    std::mutex mutex_;
    int ended_ = 0;
    std::vector<double> samples_;
};

/// The lateness of one cell's cycles. [one thread]
class CellRecord {
  public:
    CellRecord() { lateness_.reserve(most); }
    /// Adds the lateness of a cycle. Ignores the first one, which does not belong to a tick.
    void cycle() {
        if (!std::exchange(has_begun_, true))
            Cells::all().begin();
        else if (lateness_.size() < most)
            lateness_.push_back(static_cast<double>(Cells::all().lateness_now()));
    }
    void end() { Cells::all().end(lateness_); }

  private:
    static constexpr std::size_t most = 128;
    bool has_begun_ = false;
    std::vector<double> lateness_;
};

} // namespace tandem::bench
