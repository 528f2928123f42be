// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/recorder.hpp"

#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/record/host_files.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"

#include <ctime>

namespace tandem::command {
namespace {

constexpr std::byte encapsulation[4] = {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};
constexpr const char* drops_type = "tandem::Drops";
constexpr const char* drops_idl =
    "module tandem {\nstruct Drops {\n  string port;\n  unsigned long long refused;\n"
    "  unsigned long long overwritten;\n  unsigned long long skipped;\n"
    "  unsigned long long not_recorded;\n};\n};\n";

std::uint64_t wall_clock_ns() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

std::uint64_t stamp_ns(std::uint64_t stamp) {
    return std::uint64_t{wire::stamp_seconds(stamp)} * 1'000'000'000ULL + wire::stamp_nanoseconds(stamp);
}

mcap::ByteView bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

} // namespace

Recorder::Recorder(mcap::McapWriter& writer, const std::vector<std::string>& links,
                   const std::vector<std::string>& ports)
    : writer_(writer) {
    for (const std::string& link : links) links_.emplace_back(LinkFollower(link, ports));
}

std::uint16_t Recorder::add_schema(const std::string& name, const std::string& text) {
    auto& id = schemas_[{name, text}];
    if (id == 0) id = writer_.add_schema(name, "omgidl", bytes_of(text));
    return id;
}

/// The ports of a generation: those that were there before keep their channel, unless their type has changed.
void Recorder::add_channels(Link& link) {
    for (const auto& port : link.follower.ports()) {
        const auto known = link.channels.find(port.port.name);
        if (known == link.channels.end() || known->second.signature != port.port.signature)
            add_channel(link, port);
    }
    if (!link.follower.ports().empty() && link.follower.ports()[0].generation != link.generation) {
        link.generation = link.follower.ports()[0].generation;
        link.drops.clear(); // the segment's counters begin anew
        store_host_files(writer_, link.follower.link(), link.generation);
    }
}

void Recorder::add_channel(Link& link, const LinkFollower::Port& port) {
    const MessageIdl idl = message_idl(port);
    const std::string topic = "/" + port.link + "/" + port.port.name;
    const mcap::StringMap metadata{{"tandem.link", port.link},
                                   {"tandem.port", port.port.name},
                                   {"tandem.component", port.port.component},
                                   {"tandem.type", port.port.type},
                                   {"tandem.signature", port.port.signature},
                                   {"tandem.writer", shm::name_of(port.writer)}};
    link.channels[port.port.name] = {
        writer_.add_channel(topic, add_schema(idl.name, idl.text), "cdr", metadata), port.port.signature};
    channels_[topic] = true;
}

void Recorder::write(Link& link, const LinkFollower::Port& port, const shm::FollowedRecord& record) {
    message_.assign(std::begin(encapsulation), std::end(encapsulation));
    append_message(port, record.bytes, record.stamp, message_);
    writer_.write(link.channels.at(port.port.name).id, static_cast<std::uint32_t>(record.sequence),
                  wall_clock_ns(), stamp_ns(record.stamp), message_);
    ++messages_;
}

bool Recorder::poll() {
    const std::uint64_t before = messages_;
    for (Link& link : links_) {
        const auto deliver = [&](const LinkFollower::Port& port, const shm::FollowedRecord& record) {
            write(link, port, record);
        };
        while (link.follower.poll(deliver, [&] { add_channels(link); })) {
        }
    }
    return messages_ != before;
}

void Recorder::write_drop(Link& link, const std::string& port, const Drops& drops) {
    if (link.drops_channel == 0)
        link.drops_channel = writer_.add_channel("/" + link.follower.link() + "/tandem/drops",
                                                 add_schema(drops_type, drops_idl), "cdr");
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put_string(port);
    for (const std::uint64_t count : {drops.refused, drops.overwritten, drops.skipped, drops.not_recorded})
        out.put(count);
    message_.assign(std::begin(encapsulation), std::end(encapsulation));
    message_.insert(message_.end(), bytes.begin(), bytes.end());
    const std::uint64_t now = wall_clock_ns();
    writer_.write(link.drops_channel, ++link.drops_sequence, now, now, message_);
}

void Recorder::write_drops() {
    for (Link& link : links_) {
        const auto observation = shm::observe(link.follower.link());
        if (!observation || observation->segment.generation != link.generation) continue;
        for (const auto& port : link.follower.ports())
            for (const auto& ring : observation->rings) {
                if (ring.owner != port.owner || ring.name != link::ring_name(port.port.name) ||
                    !ring.damage.empty())
                    continue;
                const auto& counters = ring.counters;
                const Drops now{counters.refused, counters.overwritten, counters.skipped, port.ring.lost()};
                Drops& written = link.drops[port.port.name];
                if (now == written) continue;
                written = now;
                write_drop(link, port.port.name, now);
            }
    }
}

std::uint64_t Recorder::lost() const {
    std::uint64_t lost = 0;
    for (const Link& link : links_) lost += link.follower.lost();
    return lost;
}

std::string Recorder::absent_links() const {
    std::string names;
    for (const Link& link : links_)
        if (!link.follower.is_open()) names += (names.empty() ? "" : ", ") + link.follower.link();
    return names;
}

} // namespace tandem::command
