// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/wheelchair/run/trace_follower.hpp"
#include "shm/segment.hpp"

namespace tandem::wheelchair {

/// Publishes the chair's state in each tick of HWComp from the traces as port `chair` of a link, in every
/// configuration. Both sides of the link are this process; the hosts are not involved. [one thread]
class ChairLink {
  public:
    /// `link`: a name that no other process uses. `drive`: path of the socket for stick positions; empty if there is
    /// none. Throws shm::Error if /dev/shm is full.
    ChairLink(const std::string& link, std::string drive);

    /// Sends a message for each tick of HWComp since the last call, with the time of the tick.
    void update(const ComponentTraces& traces);

  private:
    void send(const HWRecord& hw, const JoystickRecord& joystick, const ControlRecord& control,
              std::uint64_t stamp_ns);

    std::unique_ptr<shm::Segment> first_, second_;
    std::optional<shm::RingWriter> writer_;
    std::optional<shm::RingReader> reader_;
    std::string drive_;
    std::vector<std::byte> message_;
    std::size_t sent_ = 0; ///< ticks of HWComp
};

} // namespace tandem::wheelchair
