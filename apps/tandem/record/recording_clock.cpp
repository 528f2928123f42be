// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/recording_clock.hpp"

#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/wire/cdr.hpp"
#include "shm/os/clock.hpp"

#include <string>
#include <vector>

namespace tandem::command {
namespace {

constexpr std::uint64_t sharp_enough_ns = 10'000;
constexpr std::int64_t smallest_step_ns = 1'000'000;

constexpr const char* clock_step_type = "tandem::ClockStep";
constexpr const char* clock_step_idl =
    "module tandem {\nstruct ClockStep {\n  long long step_ns;\n  long long offset_ns;\n};\n};\n";
constexpr const char* step_signature = "{step_ns}x{offset_ns}x";

} // namespace

ClockReading read_clocks() {
    ClockReading best;
    std::uint64_t best_width = ~std::uint64_t{0};
    for (int i = 0; i < 20 && best_width > sharp_enough_ns; ++i) {
        const std::uint64_t before = shm::now_ns(), wall = wall_clock_ns(), after = shm::now_ns();
        if (after - before >= best_width) continue;
        best_width = after - before;
        best = {wall, before + best_width / 2};
    }
    return best;
}

std::uint64_t RecordingClock::now() const { return time_of(shm::now_ns()); }

std::int64_t RecordingClock::take_step() {
    const ClockReading reading = read_();
    const auto offset = static_cast<std::int64_t>(reading.wall_ns - time_of(reading.monotonic_ns));
    const std::int64_t step = offset - offset_ns_;
    if (step > -smallest_step_ns && step < smallest_step_ns) return 0;
    offset_ns_ = offset;
    return step;
}

void ClockChannel::write_start() {
    if (std::exchange(started_, true)) return;
    writer_.add_metadata("tandem.clock",
                         {{"log_time", "wall_ns + CLOCK_MONOTONIC - monotonic_ns"},
                          {"wall_ns", std::to_string(clock_.reading_at_start().wall_ns)},
                          {"monotonic_ns", std::to_string(clock_.reading_at_start().monotonic_ns)}});
}

void ClockChannel::write_step() {
    const std::int64_t step = clock_.take_step();
    if (step == 0) return;
    if (channel_ == 0)
        channel_ = writer_.add_channel(
            clock_topic,
            writer_.add_schema(clock_step_type, "omgidl",
                               std::as_bytes(std::span(std::string_view(clock_step_idl)))),
            "cdr", {{"tandem.signature", step_signature}});
    std::vector<std::byte> bytes, message(std::begin(encapsulation), std::end(encapsulation));
    wire::CdrWriter out(bytes);
    out.put(step);
    out.put(clock_.offset_ns());
    message.insert(message.end(), bytes.begin(), bytes.end());
    const std::uint64_t now = clock_.now();
    writer_.write(channel_, ++steps_, now, now, message);
}

} // namespace tandem::command
