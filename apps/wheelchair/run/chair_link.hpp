// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/wheelchair/run/trace_follower.hpp"
#include "shm/segment.hpp"

namespace tandem::wheelchair {

/// Publishes the chair's state from the traces as port `chair` of a link, about 20 times a second and in every
/// configuration. Both sides of the link are this process; the hosts are not involved. [one thread]
class ChairLink {
  public:
    /// `link`: a name that no other process uses. `drive`: path of the socket for stick positions; empty if there is
    /// none. Throws shm::Error if /dev/shm is full.
    ChairLink(const std::string& link, std::string drive);

    /// Sends the newest records, if HWComp has ticked since the last call.
    void update(const ComponentTraces& traces);

  private:
    std::unique_ptr<shm::Segment> first_, second_;
    std::optional<shm::RingWriter> writer_;
    std::optional<shm::RingReader> reader_;
    std::string drive_;
    std::vector<std::byte> message_;
    double sent_sequence_ = -1.0;
};

} // namespace tandem::wheelchair
