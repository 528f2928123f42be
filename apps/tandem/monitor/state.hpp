// SPDX-License-Identifier: Apache-2.0
// The state of all links at one moment, as plain data. StateReader fills it; the verdict, the events, the JSON and the
// metrics are functions of it. Names and texts are printable ASCII.
#pragma once
#include "host/process/published/component_states.hpp"
#include "host/process/published/notices.hpp"
#include "host/rt/tick_page.hpp"
#include "proxy/link/protocol/port_table.hpp"
#include "shm/inspect/observer.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tandem::monitor {

/// Percentiles of the last seconds, as upper ends of histogram buckets. Meaningless if `samples` is 0.
struct Times {
    std::uint64_t samples = 0, p50_ns = 0, p99_ns = 0, max_ns = 0;
    /// Upper end in ns (a power of two) and number of samples, for octaves with samples. The last octave has no end.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> octaves{};
};

struct SideState {
    shm::PeerState state = shm::PeerState::absent;
    std::uint32_t pid = 0; ///< 0: none, or see pid_elsewhere
    std::string program;   ///< name of the host program from the kernel; kept after its death
    /// The side is absent. pid and program are those of a previous process, because its peer has already started the
    /// next generation, usually within milliseconds of a death.
    bool gone = false;
    std::string model{}; ///< of its components, from its port table; kept after its death; empty: unknown
    std::uint32_t pid_elsewhere = 0; ///< in its own pid namespace, if that is another one (a container)
    bool unpublished = false;        ///< it has joined, but has not published its ports
    bool left = false;               ///< it has ended cleanly; if it is dead or gone without this, it died
    bool previous_left = false;      ///< the previous process of this side has ended cleanly

    bool has_process() const { return pid != 0 || pid_elsewhere != 0; }
    bool is_process_of(const SideState& other) const {
        return pid == other.pid && pid_elsewhere == other.pid_elsewhere;
    }
};

/// A ring. If no port in a table has it, component and type are empty.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a nlohmann::json throws nothing
struct PortState {
    std::string name, component, type;
    shm::Side owner{}, writer{};
    std::string damage; ///< not empty: the other fields are meaningless
    shm::RingCounters counters{};
    shm::HistogramCounts age{}; ///< since the segment was created
    double sent_per_s = 0, bytes_per_s = 0;
    Times recent_age;
    std::uint64_t lost_recently = 0;   ///< see shm::RingCounters::lost()
    std::uint64_t missed_recently = 0; ///< missed deadlines
    std::uint64_t undecodable_recently = 0;
    std::optional<double> silent_s; ///< time since the last message that was seen
    nlohmann::ordered_json value;   ///< newest message; null if none was seen
    std::string value_note;         ///< reason why it is missing or incomplete
};

struct CallQueueState {
    std::string name;
    shm::Side owner{}, callers{};
    std::string damage;
    shm::CallCounters counters{};
    shm::HistogramCounts round_trip{}; ///< since the segment was created
    double calls_per_s = 0, answered_per_s = 0;
    Times recent_round_trip;
    std::uint64_t failed_recently = 0; ///< timed out, or refused because no slot was free
    std::size_t open_calls = 0;
};

/// A shared port other than a data port with a ring.
struct SharedPort {
    std::string name, component, type;
    shm::Side owner{};
    std::string kind;       ///< provided, required (service ports), out, in (data ports)
    std::string mismatch;   ///< not empty: reason why it cannot be connected
    std::string instance{}; ///< interface of a service port
    std::vector<link::ServiceOperation> operations{};
};

struct LinkState {
    std::string name;
    std::uint64_t generation = 0, created_ns = 0;
    bool readable = true;
    bool foreign = false; ///< belongs to another user and is not opened
    std::string reason;   ///< why it is not readable
    std::string damage{}; ///< the first object of a readable link that cannot be read; empty: none
    std::uint64_t memory_bytes = 0;
    std::array<SideState, 2> sides;
    std::vector<PortState> ports;
    std::vector<CallQueueState> call_queues;
    std::vector<SharedPort> shared_ports;

    const SideState& side(shm::Side which) const { return sides[shm::index_of(which)]; }
    /// Returns the side with components of this model; nullopt if no port table names it.
    std::optional<shm::Side> side_of(std::string_view model) const {
        for (const shm::Side which : {shm::Side::first, shm::Side::second})
            if (side(which).model == model) return which;
        return std::nullopt;
    }
};

/// A tick that is long overdue.
struct HangState {
    /// Callback that has not returned. Empty: the thread is in none, but gets no processor.
    std::string component, callback;
    std::uint64_t since_ms = 0; ///< since the epoch: start of the callback's cycle, or due time of the tick
    double seconds = 0;         ///< since then
};

/// A tick of a host: one component, or several together.
struct TickState {
    std::string name, program;
    std::uint32_t pid = 0;
    std::size_t slot = 0; ///< distinguishes the ticks of a process
    std::uint64_t period_ns = 0, ticks = 0, overruns = 0, skipped = 0; ///< rt::TickStats
    std::uint64_t ticks_recently = 0, overruns_recently = 0;
    std::array<std::uint64_t, rt::TickSlot::octaves> lateness{},
        execution{};              ///< by octave, since the first tick
    std::uint64_t latest_ns = 0;  ///< maximum lateness since the first tick
    std::uint64_t longest_ns = 0; ///< maximum execution time since the first tick
    double ticks_per_s = 0;
    Times recent_lateness{}, recent_execution{}; ///< upper ends of octaves
    std::optional<HangState> hang{};
};

/// A component as its host lists it (host/process/published/inventory.hpp).
struct HostComponent {
    std::string name, type;
    std::string
        execution; ///< of an OPRoS component: periodic, aperiodic ...; empty: its contexts say when it runs
    std::uint64_t period_ns = 0;
    std::vector<std::string> names{}; ///< in name servers
};

/// An execution context of RTCs. The owner of a context with several components is a composite, or lends it to them.
struct HostContext {
    std::string owner, kind;
    std::uint64_t period_ns = 0;
    bool running = false;
    std::vector<std::string> components{};
};

struct HostPort {
    std::string component, name;
    std::string kind;      ///< data, event, service
    std::string direction; ///< input, output, provided, required
    std::string type;
    std::vector<std::string> connections{}; ///< ids, which connected ports have in common, even in two hosts
};

struct HostInventory {
    std::vector<HostComponent> components{};
    std::vector<HostContext> contexts{};
    std::vector<HostPort> ports{};
    std::uint64_t left_out = 0; ///< parts that the host could not list, or that could not be read
};

struct ThreadUsage {
    std::uint32_t tid = 0;
    std::string name;
    double cpu_percent = 0; ///< of one processor, during the last second or so
};

struct HostUsage {
    bool stopped = false; ///< by a signal or a debugger
    double cpu_percent = 0;
    std::uint64_t resident_bytes = 0;
    unsigned thread_count = 0;
    std::vector<ThreadUsage> threads{}; ///< the busiest ones
};

/// A running process that is on a link or has components.
struct HostState {
    std::uint32_t pid = 0;
    std::string program;
    HostUsage usage{};
    std::vector<std::string> links{};
    std::shared_ptr<const HostInventory> inventory{}; ///< null: it lists no parts, or they cannot be seen
};

/// A connection that a host refused between two of its ports.
struct RefusedConnectionState {
    std::string program;
    std::uint32_t pid = 0;
    std::string from, to; ///< COMPONENT.PORT
    std::string reason;
    bool operator==(const RefusedConnectionState&) const = default;
};

/// A component of a host. In several execution contexts, it is in ERROR if it is in one of them, else ACTIVE if in one.
struct ComponentStatus {
    std::string program;
    std::uint32_t pid = 0;
    std::string name;
    process::ComponentState state{};
    double in_cycle_s = 0; ///< how long an event-driven component has been in its cycle; 0: it is in none
    std::string reason{};  ///< why it is in ERROR; empty: its host does not say
};

/// What a host was asked for and does not do.
struct NoticeState {
    std::string program;
    std::uint32_t pid = 0;
    process::NoticeKind kind{};
    std::string text; ///< as in the host's log
    bool operator==(const NoticeState&) const = default;
};

struct State {
    std::uint64_t time_ms = 0; ///< since the epoch
    std::vector<LinkState> links;
    std::vector<HostState> hosts{}; ///< those on links first, in the order of the links
    std::vector<TickState> ticks{};
    std::vector<RefusedConnectionState> refused{};
    std::vector<ComponentStatus> components{};
    std::vector<NoticeState> notices{};
    std::vector<std::string> missing_links{}; ///< named on the command line, but not there
    std::vector<std::string> unseen{};        ///< what this user cannot see of the links, one line each
    std::string
        recording_failure{}; ///< why the recording that the page started has ended; empty: it has not failed
    std::string error;       ///< why /dev/shm could not be read
    std::string cut{};       ///< what a bound left out, one line; empty: nothing
};

/// Number of seconds that "recently" covers.
inline constexpr double recent_s = 5;

/// Returns a side's name for people, which is its model.
inline std::string model_of(const LinkState& link, shm::Side side) {
    const std::string& model = link.side(side).model;
    return model.empty() ? "unknown" : model;
}

} // namespace tandem::monitor
