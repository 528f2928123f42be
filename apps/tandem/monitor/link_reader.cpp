// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/link_reader.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"
#include "apps/tandem/output/format.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/protocol/published_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "shm/inspect/read_only_snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <set>

namespace tandem::monitor {
namespace {

using command::replace_nonprintable;
using shm::Side;

constexpr auto recent_ns = static_cast<std::uint64_t>(recent_s * 1e9);
/// Averaging time of rates: long enough for ports with 1 Hz.
constexpr std::uint64_t rate_ns = 2'000'000'000;

/// Returns 0 if a counter decreases, because the other process may write any value.
std::uint64_t increase(std::uint64_t from, std::uint64_t to) { return to > from ? to - from : 0; }

Times recent_times(const shm::HistogramCounts& before, const shm::HistogramCounts& now) {
    using shm::layout::Histogram;
    shm::HistogramCounts recent;
    Times times;
    for (std::size_t i = 0; i < recent.counts.size(); ++i) {
        recent.counts[i] = increase(before.counts[i], now.counts[i]);
        if (recent.counts[i] == 0) continue;
        const std::uint64_t end = i == 0 ? 64 : std::bit_ceil(Histogram::lower_bound_of(i) + 1);
        if (times.octaves.empty() || times.octaves.back().first != end) times.octaves.emplace_back(end, 0);
        times.octaves.back().second += recent.counts[i];
    }
    times.samples = recent.total();
    times.p50_ns = recent.percentile(0.5);
    times.p99_ns = recent.percentile(0.99);
    times.max_ns = recent.percentile(1);
    return times;
}

/// Returns the same object in an earlier observation; nullptr if there is none. Objects are only added, so it usually
/// has the same index as `wanted` in `now`.
template <class Object>
const Object* find_same(const std::vector<Object>& objects, const std::vector<Object>& now,
                        const Object& wanted) {
    const auto same = [&](const Object& object) {
        return object.name == wanted.name && object.owner == wanted.owner && object.damage.empty();
    };
    const auto place = static_cast<std::size_t>(&wanted - now.data());
    if (place < objects.size() && same(objects[place])) return &objects[place];
    const auto found = std::find_if(objects.begin(), objects.end(), same);
    return found != objects.end() ? &*found : nullptr;
}

SharedPort shared_port(const link::Port& port, Side owner) {
    static constexpr const char* kinds[] = {"out", "in", "provided", "required"};
    SharedPort shared{replace_nonprintable(port.name),
                      replace_nonprintable(port.component),
                      replace_nonprintable(port.type),
                      owner,
                      kinds[static_cast<std::size_t>(port.kind)],
                      {},
                      port.instance,
                      port.operations};
    // `?{reason}` replaces a type that cannot be described to the peer.
    if (const auto at = port.signature.find(link::no_signature); at != std::string::npos) {
        const auto end = port.signature.find('}', at);
        shared.mismatch = end != std::string::npos && end > at + 2
                              ? replace_nonprintable(port.signature.substr(at + 2, end - at - 2))
                              : "its type is unknown to the other model";
    }
    return shared;
}

/// Returns the port table entries other than data ports with rings. Skips tables that are being changed. Sets `damage` if a
/// table cannot be read.
std::vector<SharedPort> shared_ports(const shm::Observation& observation, std::string& damage) {
    std::vector<SharedPort> shared;
    for (const auto& blob : observation.blobs) {
        if (blob.name != link::table_name) continue;
        try {
            if (!blob.damage.empty()) throw link::LinkError(blob.damage);
            const auto published = link::read_published_table(blob.content);
            if (!published) continue;
            for (const link::Port& port : published->table.ports)
                if (!port.has_ring()) shared.push_back(shared_port(port, blob.owner));
        } catch (const link::LinkError& error) {
            const bool is_whole = !blob.damage.empty() || blob.content.size() == blob.bytes;
            if (is_whole)
                damage = fmt::format("the port table of the {} side cannot be read: {}", name_of(blob.owner),
                                     replace_nonprintable(error.what()));
        }
    }
    return shared;
}

/// Returns the name without the prefix of link::ring_name(): "odometry" for "port odometry".
std::string port_name(const std::string& ring) {
    const std::string& prefix = link::ring_prefix;
    return replace_nonprintable(ring.compare(0, prefix.size(), prefix) == 0 ? ring.substr(prefix.size())
                                                                            : ring);
}

/// Skips repeated names, because a damaged segment can contain a name twice.
template <class Object>
bool is_first(std::set<std::pair<Side, std::string>>& seen, const Object& object) {
    return seen.emplace(object.owner, object.name).second;
}

} // namespace

void LinkReader::keep(shm::Observation observation, std::uint64_t now_ns) {
    damage_ = observation.damage.empty() ? "" : replace_nonprintable(observation.damage.front());
    if (!observation.blobs.empty()) shared_ports_ = shared_ports(observation, damage_);
    models_ = command::find_models(observation, {});
    observation.blobs.clear(); // the follower has read the tables of data ports
    const auto& now = observation.segment;
    const bool same = !samples_.empty() && newest().seen.segment.generation == now.generation &&
                      newest().seen.segment.created_ns == now.created_ns;
    if (!same) change_segment(now);
    if (!same || now.readability != shm::Readability::readable) {
        samples_.clear();
        messages_.clear();
    }
    samples_.push_back({now_ns, std::move(observation)});
    while (samples_.size() > 2 && now_ns - samples_[1].time_ns >= recent_ns) samples_.pop_front();
}

/// Finds out from the old segment how the processes of its sides have ended, and opens the next one.
void LinkReader::change_segment(const shm::ObservedSegment& to) {
    for (const Side which : {Side::first, Side::second})
        if (file_ != nullptr && shm::has_left(*file_, which)) last_sides_[shm::index_of(which)].left = true;
    file_ = to.readability == shm::Readability::readable ? shm::open_observed(to) : nullptr;
}

LinkState LinkReader::read(shm::Observation observation, std::uint64_t now_ns, Round& round) {
    cut_ = false;
    keep(std::move(observation), now_ns);
    const auto& segment = newest().seen.segment;
    LinkState link;
    link.name = replace_nonprintable(segment.link);
    link.generation = segment.generation;
    link.created_ns = segment.created_ns;
    link.readable = segment.readability == shm::Readability::readable;
    link.foreign = segment.readability == shm::Readability::foreign;
    link.reason = replace_nonprintable(segment.reason);
    link.memory_bytes = segment.memory_bytes;
    if (!link.readable) return link;
    link.damage = damage_;
    read_sides(link);
    read_messages(round);
    read_rings(link, round);
    read_call_queues(link, round);
    link.shared_ports = shared_ports_;
    return link;
}

void LinkReader::read_sides(LinkState& link) {
    for (const Side which : {Side::first, Side::second}) {
        const auto& observed = newest().seen.segment.side(which);
        SideState& side = link.sides[shm::index_of(which)];
        SideState& last = last_sides_[shm::index_of(which)];
        side.state = observed.state;
        if (side.state == shm::PeerState::absent) {
            if (!last.has_process()) continue;
            side = last;
            side.state = shm::PeerState::absent;
            side.gone = true;
            continue;
        }
        side.unpublished = !observed.published;
        side.left = observed.left;
        side.pid = observed.pid;
        side.pid_elsewhere = observed.pid_elsewhere;
        const std::string& model = models_[shm::index_of(which)];
        side.model = model.empty() && last.is_process_of(side) ? last.model : replace_nonprintable(model);
        side.previous_left = last.is_process_of(side) ? last.previous_left : last.left;
        // A dead process's pid may already belong to another program, as does a pid of another namespace.
        const bool visible = side.state != shm::PeerState::dead && side.pid != 0;
        side.program = last.is_process_of(side) && !last.program.empty() ? last.program
                       : visible                                         ? program_of(side.pid)
                                                                         : "";
        last = side;
    }
}

void LinkReader::read_messages(Round& round) {
    using command::LinkFollower;
    const auto keep_value = [&](const LinkFollower::Port& port, const shm::FollowedRecord& record) {
        messages_[{port.owner, link::ring_name(port.port)}].value.keep(port, record);
        round.count_message(record.bytes.size());
    };
    cut_ = follower_.poll(keep_value, {}, LinkFollower::Rings::likely, [&] { return round.bytes_left(); });
    ports_.clear();
    for (const auto& port : follower_.ports())
        ports_.emplace(Key(port.owner, link::ring_name(port.port)), &port);
}

/// Returns the sample to compute rates from.
const LinkReader::Sample& LinkReader::rate_sample() const {
    const auto found = std::find_if(samples_.rbegin(), samples_.rend(), [&](const Sample& sample) {
        return newest().time_ns - sample.time_ns >= rate_ns;
    });
    return found != samples_.rend() ? *found : samples_.front();
}

double LinkReader::per_second(const Sample& from, std::uint64_t before, std::uint64_t now) const {
    const std::uint64_t elapsed_ns = newest().time_ns - from.time_ns;
    return elapsed_ns == 0
               ? 0
               : static_cast<double>(increase(before, now)) * 1e9 / static_cast<double>(elapsed_ns);
}

void LinkReader::read_rings(LinkState& link, const Round& round) {
    std::set<Key> seen;
    for (const auto& ring : newest().seen.rings) {
        if (round.is_stopped()) return;
        if (is_first(seen, ring)) link.ports.push_back(read_port(ring, round));
    }
}

PortState LinkReader::read_port(const shm::ObservedRing& ring, const Round& round) {
    PortState port;
    port.name = port_name(ring.name);
    port.owner = ring.owner;
    port.damage = replace_nonprintable(ring.damage);
    if (!ring.damage.empty()) return port;
    port.writer = ring.writer;
    port.counters = ring.counters;
    port.age = ring.age;
    const auto& rings = newest().seen.rings;
    const Sample& from = rate_sample();
    if (const auto* const before = find_same(from.seen.rings, rings, ring)) {
        port.sent_per_s = per_second(from, before->counters.sent, ring.counters.sent);
        port.bytes_per_s = per_second(from, before->counters.bytes_sent, ring.counters.bytes_sent);
    }
    if (const auto* const before = find_same(samples_.front().seen.rings, rings, ring)) {
        const auto &a = before->counters, &b = ring.counters;
        port.recent_age = recent_times(before->age, ring.age);
        port.lost_recently = increase(a.lost(), b.lost());
        port.missed_recently = increase(a.missed_deadlines, b.missed_deadlines);
        port.undecodable_recently = increase(a.undecodable, b.undecodable);
    }
    add_value(ring, port, round);
    return port;
}

void LinkReader::add_value(const shm::ObservedRing& ring, PortState& port, const Round& round) {
    Message& message = messages_[{ring.owner, ring.name}];
    const std::uint64_t now_ns = newest().time_ns;
    // The time of messages before the first read is unknown.
    if (message.sent != ring.counters.sent && samples_.size() > 1) message.changed_ns = now_ns;
    message.sent = ring.counters.sent;
    if (message.changed_ns != 0) port.silent_s = static_cast<double>(now_ns - message.changed_ns) / 1e9;
    if (const auto followed = ports_.find({ring.owner, ring.name}); followed != ports_.end()) {
        port.component = replace_nonprintable(followed->second->port.component);
        port.type = replace_nonprintable(followed->second->port.type);
        if (!round.is_over())
            message.value.decode(*followed->second);
        else if (message.value.is_fresh())
            cut_ = true;
    }
    port.value = message.value.value();
    port.value_note = message.value.note();
}

void LinkReader::read_call_queues(LinkState& link, const Round& round) {
    std::set<Key> seen;
    const auto& queues = newest().seen.call_queues;
    const Sample& from = samples_.front();
    for (const auto& observed : queues) {
        if (round.is_stopped()) return;
        if (!is_first(seen, observed)) continue;
        CallQueueState queue;
        queue.name = replace_nonprintable(observed.name);
        queue.owner = observed.owner;
        queue.damage = replace_nonprintable(observed.damage);
        if (observed.damage.empty()) {
            queue.callers = observed.callers;
            queue.counters = observed.counters;
            queue.round_trip = observed.round_trip;
            queue.open_calls = observed.open_calls.size();
            if (const auto* const before = find_same(from.seen.call_queues, queues, observed)) {
                const auto &a = before->counters, &b = observed.counters;
                queue.calls_per_s = per_second(from, a.calls, b.calls);
                queue.answered_per_s = per_second(from, a.answered, b.answered);
                queue.failed_recently = increase(a.timeouts + a.overloads, b.timeouts + b.overloads);
                queue.recent_round_trip = recent_times(before->round_trip, observed.round_trip);
            }
        }
        link.call_queues.push_back(std::move(queue));
    }
}

} // namespace tandem::monitor
