// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/recorder.hpp"

#include "apps/tandem/mcap/writer.hpp"
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/protocol/published_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"
#include "shm/inspect/observer.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <tandem_version.hpp>
#include <vector>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
constexpr std::uintmax_t longest_file = 1 << 20;
/// How often one poll() looks for more messages of a link. Enough for the largest ring.
constexpr int max_rounds = 64;

std::string content_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// proc(5): arguments that end with a zero byte each.
std::vector<std::string> arguments_of(const fs::path& process) {
    std::vector<std::string> arguments;
    const std::string text = content_of(process / "cmdline");
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\0', begin), text.size());
        arguments.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return arguments;
}

void store_side(mcap::McapWriter& writer, const std::string& link, const shm::ObservedSide& side,
                const char* name, std::uint64_t time_ns) {
    // The files of a process of another pid namespace, or of a dead one, cannot be found by its pid.
    const bool visible = side.state != shm::PeerState::dead && side.pid != 0;
    const fs::path process = visible ? "/proc/" + std::to_string(side.pid) : "";
    const auto arguments = visible ? arguments_of(process) : std::vector<std::string>();
    std::error_code unreadable; // the process may belong to another user, or be gone
    const fs::path folder = fs::read_symlink(process / "cwd", unreadable);
    std::string line;
    for (const std::string& argument : arguments) {
        line += (line.empty() ? "" : " ") + argument;
        const fs::path file = folder / argument;
        if (&argument == &arguments[0] || argument.empty() || !fs::is_regular_file(file, unreadable) ||
            fs::file_size(file, unreadable) > longest_file)
            continue;
        const std::string content = content_of(file);
        const char* type = file.extension() == ".xml" ? "application/xml" : "text/plain";
        writer.attach(link + "/" + file.filename().string(), type, time_ns, 0,
                      std::as_bytes(std::span(content)));
    }
    const std::string pid = side.pid_elsewhere != 0
                                ? std::to_string(side.pid_elsewhere) + " of another namespace"
                                : std::to_string(side.pid);
    writer.add_metadata(
        "tandem.host",
        {{"link", link}, {"side", name}, {"pid", pid}, {"command", line}, {"version", tandem::version}});
}

/// Stores the port tables of both sides as metadata `tandem.ports`. A replay publishes the table of the
/// side that it replaces.
void store_port_tables(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation) {
    const auto observation = shm::observe(link, generation);
    if (!observation) return;
    for (const auto& blob : observation->blobs) {
        if (!blob.damage.empty() || blob.name != link::table_name) continue;
        try {
            if (const auto published = link::read_published_table(blob.content))
                writer.add_metadata("tandem.ports", {{"link", link},
                                                     {"side", shm::name_of(blob.owner)},
                                                     {"table", encode_as_text(published->table)}});
        } catch (const link::LinkError&) { // no table: its ports are not recorded either
        }
    }
}

/// Stores the command line of each host of the link as metadata, and the files that it names (application
/// profiles, rtc.conf), up to 1 MiB each, as attachments. Skips unreadable files.
void store_host_files(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation,
                      std::uint64_t time_ns) {
    const auto observation = shm::observe(link, generation);
    if (!observation) return;
    for (const shm::Side side : {shm::Side::first, shm::Side::second})
        if (observation->segment.side(side).state != shm::PeerState::absent)
            store_side(writer, link, observation->segment.side(side), shm::name_of(side), time_ns);
}

/// Represents service calls in the messages about drops.
constexpr const char* calls_port = "(service calls)";
constexpr const char* step_type = "tandem::Step";
constexpr const char* step_idl =
    "module tandem {\nstruct Step {\n  unsigned long long tick;\n  string host;\n"
    "  string component;\n};\n};\n";
std::uint64_t stamp_to_ns(std::uint64_t stamp) {
    return std::uint64_t{wire::stamp_seconds(stamp)} * 1'000'000'000ULL + wire::stamp_nanoseconds(stamp);
}

} // namespace

Recorder::Recorder(mcap::McapWriter& writer, const std::vector<std::string>& links,
                   const std::vector<std::string>& ports, RecordingClock clock)
    : writer_(writer), port_names_(ports),
      call_writer_(writer, [this](const std::string& name,
                                  const std::string& text) { return add_schema(name, text); }),
      clock_(std::move(clock)), clock_channel_(writer, clock_) {
    for (const std::string& link : links) links_.emplace_back(LinkFollower(link, ports));
}

std::uint16_t Recorder::add_schema(const std::string& name, const std::string& text) {
    auto& id = schemas_[{name, text}];
    if (id == 0) id = writer_.add_schema(name, "omgidl", bytes_of(text));
    return id;
}

/// Adds the ports of a generation. Existing ports keep their channel, unless their type has changed.
void Recorder::add_channels(Link& link) {
    if (!simulated_ns_) clock_channel_.write_start();
    for (const auto& port : link.follower.ports()) {
        const auto known = link.channels.find(port.port.name);
        if (known == link.channels.end() || known->second.signature != port.port.signature)
            add_channel(link, port);
    }
    store_port_tables(writer_, link.follower.link(), link.follower.generation());
    if (link.follower.generation() != link.generation) {
        link.generation = link.follower.generation();
        link.drops.clear(); // the segment's counters restart
        store_host_files(writer_, link.follower.link(), link.generation, log_time());
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
    const std::uint64_t now = log_time();
    writer_.write(link.channels.at(port.port.name).id, static_cast<std::uint32_t>(record.sequence), now,
                  simulated_ns_ ? now : stamp_to_ns(record.stamp), message_);
    ++messages_;
}

std::uint64_t Recorder::log_time() const { return simulated_ns_ ? *simulated_ns_ : clock_.now(); }

bool Recorder::poll(shm::CallActivity activity, LinkFollower::Rings rings) {
    const std::uint64_t before = messages_ + calls();
    const auto wanted = [&](const std::string& port) {
        return port_names_.empty() ||
               std::find(port_names_.begin(), port_names_.end(), port) != port_names_.end();
    };
    for (Link& link : links_) {
        const auto deliver = [&](const LinkFollower::Port& port, const shm::FollowedRecord& record) {
            write(link, port, record);
        };
        bool more = true;
        for (int round = 0; more && round < max_rounds && (stop_ == nullptr || !*stop_); ++round)
            more = link.follower.poll(
                deliver, [&] { add_channels(link); }, rings);
        link.follower.poll_calls(
            [&](shm::Side callers, const shm::FollowedCall& call) {
                const std::uint64_t now = log_time();
                call_writer_.write(link.follower.link(), callers, call,
                                   {simulated_ns_ ? now : clock_.time_of(call.submitted_ns), now}, wanted);
            },
            activity);
    }
    return messages_ + calls() != before;
}

void Recorder::begin_with_oldest() {
    for (Link& link : links_) link.follower.begin_with_oldest();
}

void Recorder::write_step(std::uint64_t time_ns, std::uint64_t tick, const std::string& host,
                          const std::string& component) {
    simulated_ns_ = time_ns;
    if (steps_channel_ == 0)
        steps_channel_ = writer_.add_channel(steps_topic, add_schema(step_type, step_idl), "cdr",
                                             {{"tandem.signature", "{tick}t{host}s{component}s"}});
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put(tick);
    out.put_string(host);
    out.put_string(component);
    message_.assign(std::begin(encapsulation), std::end(encapsulation));
    message_.insert(message_.end(), bytes.begin(), bytes.end());
    writer_.write(steps_channel_, ++steps_, time_ns, time_ns, message_);
}

void Recorder::write_drop(Link& link, const std::string& port, const Drops& drops) {
    if (link.drops_channel == 0)
        link.drops_channel = writer_.add_channel("/" + link.follower.link() + "/tandem/drops",
                                                 add_schema(drops_type, drops_idl), "cdr");
    const auto bytes = encode(port, drops);
    message_.assign(std::begin(encapsulation), std::end(encapsulation));
    message_.insert(message_.end(), bytes.begin(), bytes.end());
    const std::uint64_t now = log_time();
    writer_.write(link.drops_channel, ++link.drops_sequence, now, now, message_);
}

void Recorder::write_clock_step() {
    if (!simulated_ns_) clock_channel_.write_step();
}

void Recorder::write_drops() {
    for (Link& link : links_) {
        if (const Drops calls{.not_recorded = link.follower.lost_calls()}; calls != link.drops[calls_port]) {
            link.drops[calls_port] = calls;
            write_drop(link, calls_port, calls);
        }
        const auto observation = shm::observe(link.follower.link());
        if (!observation || observation->segment.generation != link.generation) continue;
        for (const auto& port : link.follower.ports())
            for (const auto& ring : observation->rings) {
                if (ring.owner != port.owner || ring.name != link::ring_name(port.port) ||
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

std::uint64_t Recorder::lost_calls() const {
    std::uint64_t lost = 0;
    for (const Link& link : links_) lost += link.follower.lost_calls();
    return lost;
}

std::string Recorder::absent_links() const {
    std::string names;
    for (const Link& link : links_)
        if (link.follower.generation() == 0) names += (names.empty() ? "" : ", ") + link.follower.link();
    return names;
}

} // namespace tandem::command
