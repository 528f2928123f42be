// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/link_follower.hpp"

#include "proxy/link/session/link_session.hpp"
#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/os/clock.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <sys/stat.h>

namespace tandem::command {
namespace {

/// Interval in ns for finding a missing segment and for checking a segment for changes.
constexpr std::uint64_t look_interval_ns = 50'000'000;
/// With a budget, the bytes in one step of reading a port's ring, and the largest number of steps in one poll().
constexpr std::size_t step_bytes = std::size_t{256} << 10;
constexpr int max_steps = 32;

const shm::ObservedRing* find_ring(const shm::Observation& observation, const FollowedPort& port) {
    for (const auto& ring : observation.rings)
        if (ring.damage.empty() && ring.owner == port.owner && ring.name == link::ring_name(port.port))
            return &ring;
    return nullptr;
}

} // namespace

LinkFollower::LinkFollower(std::string link, std::vector<std::string> port_names)
    : link_(std::move(link)), names_(std::move(port_names)) {
    shm::check_link_name(link_);
}

bool LinkFollower::wants(const std::string& port) const {
    return names_.empty() || std::find(names_.begin(), names_.end(), port) != names_.end();
}

LinkFollower::Version LinkFollower::read_version() const {
    using shm::layout::SegmentHeader;
    using shm::layout::SideHeader;
    Version version;
    const auto bytes_of = [](auto& word) { return std::as_writable_bytes(std::span(&word, 1)); };
    bool complete = file_->read(offsetof(SegmentHeader, superseded_by), bytes_of(version.superseded_by));
    for (std::size_t side = 0; side < 2; ++side)
        complete = complete && file_->read(sizeof(SegmentHeader) + side * sizeof(SideHeader) +
                                               offsetof(SideHeader, published),
                                           bytes_of(version.published[side]));
    struct stat status {};
    version.removed = !complete || fstat(file_->fd(), &status) != 0 || status.st_nlink == 0;
    return version;
}

bool LinkFollower::open(const shm::Observation& observation) {
    const auto& segment = observation.segment;
    auto file = shm::open_observed(segment);
    if (!file) return false;
    std::vector<Port> ports;
    const bool same = file_ && segment.generation == generation_ && segment.created_ns == created_ns_;
    bool added = false; // also set for a port that replaces one of another type
    for (FollowedPort& found : find_ports(observation)) {
        const auto* const ring = find_ring(observation, found);
        if (ring == nullptr || !wants(found.port.name)) continue;
        const auto known = std::find_if(ports_.begin(), ports_.end(), [&](const Port& port) {
            return same && port.port == found.port && port.owner == found.owner;
        });
        // Follows a new port from its newest message.
        const auto begin = same ? shm::RingFollower::Begin::newest : begin_;
        added |= known == ports_.end();
        if (known != ports_.end())
            ports.push_back(std::move(*known));
        else
            ports.emplace_back(std::move(found), link_, segment.generation,
                               shm::RingFollower(file, *ring, begin, memory_));
    }
    if (!same) {
        for (const Port& port : ports_) lost_before_ += port.ring.lost();
        for (const auto& queue : calls_) lost_calls_before_ += queue.lost();
        calls_.clear();
        for (const auto& queue : observation.call_queues)
            if (queue.damage.empty() && queue.name == link::calls_name) calls_.emplace_back(file, queue);
    }
    Models models = find_models(observation, same ? models_ : Models());
    const bool changed = !same || added || ports.size() != ports_.size() || models != models_;
    models_ = std::move(models);
    file_ = std::move(file);
    generation_ = segment.generation;
    created_ns_ = segment.created_ns;
    ports_ = std::move(ports);
    begin_with_oldest(); // the next generation is followed from its oldest message
    version_ = read_version();
    return changed;
}

/// Returns whether the ports or the models have changed.
bool LinkFollower::look_for_ports() {
    const std::uint64_t now = shm::now_ns();
    if (now < next_look_ns_) return false;
    next_look_ns_ = now + look_interval_ns;
    if (file_ && read_version() == version_) return false;
    const auto observation = shm::observe(link_);
    if (!observation) begin_with_oldest();
    if (!observation || observation->segment.readability != shm::Readability::readable) return false;
    return open(*observation);
}

bool LinkFollower::poll_port(Port& port, const Deliver& deliver, const Budget& budget) const {
    const auto deliver_record = [&](const shm::FollowedRecord& record) { deliver(port, record); };
    if (!budget) return port.ring.poll(deliver_record);
    for (int step = 0; step < max_steps; ++step) {
        const std::size_t left = budget();
        if (left == 0) return true;
        if (!port.ring.poll(deliver_record, std::min(left, step_bytes))) return false;
    }
    return true;
}

bool LinkFollower::poll(const Deliver& deliver, const std::function<void()>& changed, Rings rings,
                        const Budget& budget) {
    if (look_for_ports() && changed) changed();
    const std::size_t first = first_port_ < ports_.size() ? first_port_ : 0;
    first_port_ = 0;
    bool more = false;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
        const std::size_t place = (first + i) % ports_.size();
        if (budget && budget() == 0) {
            first_port_ = place;
            return true;
        }
        if (rings == Rings::all || ports_[place].ring.may_have_come())
            more |= poll_port(ports_[place], deliver, budget);
    }
    return more;
}

void LinkFollower::poll_calls(const DeliverCall& deliver, shm::CallActivity activity) {
    for (shm::CallFollower& queue : calls_)
        queue.poll([&](const shm::FollowedCall& call) { deliver(queue.callers(), call); }, activity);
}

std::uint64_t LinkFollower::lost_calls() const {
    std::uint64_t lost = lost_calls_before_;
    for (const auto& queue : calls_) lost += queue.lost();
    return lost;
}

std::uint64_t LinkFollower::lost() const {
    std::uint64_t lost = lost_before_;
    for (const Port& port : ports_) lost += port.ring.lost();
    return lost;
}

} // namespace tandem::command
