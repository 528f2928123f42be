// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/commands.hpp"
#include "apps/tandem/observe/message_json.hpp"
#include "apps/tandem/observe/open_link.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "host/text/join.hpp"
#include "proxy/wire/time.hpp"
#include "shm/os/clock.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace tandem::command {
namespace {

using Json = nlohmann::ordered_json;

std::string hex_dump(std::span<const std::byte> bytes) {
    return text::join(bytes, " ",
                      [](std::byte byte) { return fmt::format("{:02x}", static_cast<unsigned>(byte)); });
}

/// Returns the message with the names of its members, or its bytes if they do not fit the port's type.
Json value_of(const FollowedPort& port, const shm::FollowedRecord& record) {
    try {
        return message_to_json(port, record.bytes, record.stamp);
    } catch (const std::exception& error) {
        return {{"cdr", hex_dump(record.bytes)}, {"error", error.what()}};
    }
}

std::string line_of(const EchoOptions& options, const LinkFollower::Port& port,
                    const shm::FollowedRecord& record) {
    constexpr auto replace = Json::error_handler_t::replace; // replaces invalid UTF-8
    const Json value = value_of(port, record);
    if (options.json)
        return Json{
            {"link", port.link},
            {"port", port.port.name},
            {"generation", port.generation},
            {"sequence", record.sequence},
            {"sent",
             {{"sec", wire::stamp_seconds(record.stamp)}, {"nsec", wire::stamp_nanoseconds(record.stamp)}}},
            {"value", value}}
            .dump(-1, ' ', false, replace);
    const std::string text = value.dump(-1, ' ', false, replace);
    return options.ports.size() == 1 ? text : replace_nonprintable(port.port.name) + " " + text;
}

} // namespace

int echo(const EchoOptions& options) {
    LinkFollower follower = open_link(options.link, options.ports);
    std::uint64_t printed = 0, lost = 0, last_ns = shm::now_ns();
    const auto print = [&](const LinkFollower::Port& port, const shm::FollowedRecord& record) {
        if (options.count != 0 && printed == options.count) return;
        print_text(line_of(options, port, record) + "\n");
        ++printed;
        last_ns = shm::now_ns();
    };
    while (options.count == 0 || printed < options.count) {
        if (!follower.poll(print)) sleep_between_looks();
        if (follower.lost() != lost) {
            print_note("tandem: {} messages were overwritten before they were copied\n",
                       follower.lost() - lost);
            lost = follower.lost();
        }
        if (options.timeout_s > 0 && static_cast<double>(shm::now_ns() - last_ns) > options.timeout_s * 1e9) {
            print_note(
                "tandem: no message for {} s; to see which ports send and receive, run tandem shm stats {}\n",
                options.timeout_s, options.link);
            return 1;
        }
    }
    return 0;
}

} // namespace tandem::command
