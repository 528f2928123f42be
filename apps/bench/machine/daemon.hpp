// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

namespace tandem::bench {

/// A program that a peer needs beside it (iceoryx: RouDi). It runs as long as this object exists, with a log and
/// a configuration in a temporary folder of its own.
class Daemon {
  public:
    /// Starts the program (looked up on PATH) and waits until its log says that it is ready. Empty: there is
    /// none. Throws std::runtime_error if it ends, or is not ready in 10 s.
    explicit Daemon(const std::string& program);
    ~Daemon(); ///< SIGTERM, SIGKILL after 5 s; removes the folder

  private:
    struct Running;
    std::unique_ptr<Running> running_;
};

} // namespace tandem::bench
