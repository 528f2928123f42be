// SPDX-License-Identifier: Apache-2.0
// A program that a peer needs beside it (iceoryx: RouDi): started for one case, stopped by its pid.
#pragma once
#include <memory>
#include <string>

namespace tandem::bench {

class Daemon {
  public:
    explicit Daemon(const std::string& program); ///< Empty: none. Throws if it does not start in 10 s.
    ~Daemon();

  private:
    struct Running;
    std::unique_ptr<Running> running_;
};

} // namespace tandem::bench
