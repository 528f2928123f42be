// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <condition_variable>
#include <mutex>
#include <thread>

namespace tandem::mcap {

/// Passes the written data of a file to the disk, at most once a second. A thread does so, because a slow disk would
/// delay the recorder.
class DiskSync {
  public:
    /// The descriptor must outlive this object. Without a free thread, requests do nothing.
    explicit DiskSync(int descriptor);
    ~DiskSync() { stop(); }
    DiskSync(const DiskSync&) = delete;
    DiskSync& operator=(const DiskSync&) = delete;

    /// Requests that the data written so far go to the disk. Returns at once: 0, or the errno value of the first
    /// failure. [any-thread]
    int request();
    /// Ends the thread. Returns like request(). [one thread]
    int stop();

  private:
    void run();

    const int descriptor_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool requested_ = false, stopping_ = false;
    int error_ = 0;
    std::thread thread_; ///< last: it uses everything above
};

/// Blocks until the data of the file are on the disk. Returns 0 or an errno value; 0 if the file cannot be synchronized.
int sync_to_disk(int descriptor);

} // namespace tandem::mcap
