// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/chair_link.hpp"

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/plant/steering.hpp"
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/published_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/cdr.hpp"
#include "shm/os/clock.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tandem::wheelchair {

namespace {

// In the order of update(): s, m, deg, rad/s, V, deg and m/s. brake and emergency_stop are 0 or 1; state is that of
// ControlComp (docs/wheelchair.md, 6.5).
constexpr const char* signature =
    "{t}d{x}d{y}d{heading_deg}d{stick_x}d{stick_y}d{emergency_stop}d{wheel_left}d{wheel_right}d"
    "{steering_deg}d{reference_deg}d{reference_speed}d{volts_left}d{volts_right}d{brake}d{state}d{drive}s";
constexpr const char* port_name = "chair";

constexpr std::size_t max_batch = 20; ///< messages; the ring has room for more

/// Returns the newest record at a time, or zeros.
template <class Record>
Record last_before(const std::vector<Record>& records, double at) {
    const auto after = std::upper_bound(records.begin(), records.end(), at,
                                        [](double time, const Record& each) { return time < each.at; });
    return after == records.begin() ? Record{} : *std::prev(after);
}

link::PortTable chair_table() {
    link::Port port;
    port.kind = link::PortKind::data_out;
    port.name = port_name;
    port.type = "Wheelchair::Chair";
    port.signature = signature;
    port.component = "wheelchair";
    return {{{.name = "wheelchair", .type = "program"}}, {port}};
}

} // namespace

ChairLink::ChairLink(const std::string& link, std::string drive) : drive_(std::move(drive)) {
    shm::JoinOptions small;
    small.arena_bytes = std::size_t{256} << 10;
    first_ = shm::Segment::join(link, shm::Side::first, small);
    second_ = shm::Segment::join(link, shm::Side::second, small);
    const auto bytes = link::encode(chair_table());
    link::write_published_table(
        first_->add_blob(link::table_name, link::published_table_bytes(bytes.size(), false)), bytes, 1);
    writer_.emplace(first_->add_ring(link::ring_name(port_name), {.max_record = 1024, .capacity = 16384}));
    first_->publish();
    second_->publish();
    reader_.emplace(*second_->find_ring(shm::Side::first, link::ring_name(port_name)));
}

// Only the newest ticks of a late batch are sent.
void ChairLink::update(const ComponentTraces& traces) {
    const auto& ticks = traces.hw.records();
    const std::size_t all = traces.hw.dropped() + ticks.size(),
                      added = std::min({all - std::exchange(sent_, all), ticks.size(), max_batch});
    const std::uint64_t now = shm::now_ns();
    for (auto hw = ticks.end() - static_cast<std::ptrdiff_t>(added); hw != ticks.end(); ++hw) {
        const double age = 1e9 * (ticks.back().at - hw->at);
        send(*hw, last_before(traces.joystick.records(), hw->at),
             last_before(traces.control.records(), hw->at),
             now - static_cast<std::uint64_t>(std::max(0.0, age)));
    }
    // Empties the ring, because messages in a full ring count as lost. Monitors read the ring without taking messages.
    while (reader_->read()) continue;
}

void ChairLink::send(const HWRecord& hw, const JoystickRecord& joystick, const ControlRecord& control,
                     std::uint64_t stamp_ns) {
    message_.clear();
    wire::CdrWriter out(message_);
    for (const double value :
         {hw.sequence * tick_seconds, hw.x, hw.y, hw.heading * degrees, hw.jx, hw.jy, hw.emergency_stop,
          hw.wheel_left_measured, hw.wheel_right_measured,
          steering_angle_deg(hw.wheel_left_measured, hw.wheel_right_measured), joystick.direction_deg,
          joystick.speed, hw.volts_left, hw.volts_right, hw.brake, control.state})
        out.put(value);
    out.put_string(drive_);
    writer_->write(message_, stamp_ns);
}

} // namespace tandem::wheelchair
