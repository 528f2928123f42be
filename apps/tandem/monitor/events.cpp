// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/events.hpp"
#include "apps/tandem/monitor/verdict.hpp"
#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::monitor {
namespace {

using shm::PeerState;
using shm::Side;

class Comparison {
  public:
    explicit Comparison(std::uint64_t time_ms) : time_ms_(time_ms) {}

    void came(const LinkState& link) {
        add(link, false, fmt::format("the link exists, generation {}", link.generation));
        for (const Side side : {Side::first, Side::second})
            if (const SideState& host = link.side(side); host.state == PeerState::dead)
                add_host(link, side, host, !host.left, host.left ? "had already ended" : "was already dead");
    }
    void gone(const LinkState& link) {
        add(link, false, "the link no longer exists: its segment was removed");
    }

    void compare(const LinkState& before, const LinkState& after) {
        if (before.readable && !after.readable) add(after, true, "cannot be read: " + after.reason);
        if (!before.readable || !after.readable) return;
        const bool same = before.generation == after.generation && before.created_ns == after.created_ns;
        if (!same)
            add(after, false,
                after.generation > before.generation
                    ? fmt::format("the link continues as generation {}; its counters start at zero",
                                  after.generation)
                    : "the link was created again; its counters start at zero");
        for (const Side side : {Side::first, Side::second}) compare_side(before, after, side);
        if (!same) return; // counters start at zero
        compare_ports(before, after);
        compare_call_queues(before, after);
    }

    void compare_refusals(const State& before, const State& after) {
        const auto has = [](const State& state, const RefusedConnectionState& refused) {
            return std::find(state.refused.begin(), state.refused.end(), refused) != state.refused.end();
        };
        const auto lives = [&](std::uint32_t pid) {
            return std::any_of(after.links.begin(), after.links.end(), [&](const LinkState& link) {
                return link.side(Side::first).pid == pid || link.side(Side::second).pid == pid;
            });
        };
        const auto tell = [&](bool bad, const RefusedConnectionState& refused, const std::string& text) {
            events_.push_back({0, time_ms_, bad, refused.program,
                               fmt::format("{} and {} {}", refused.from, refused.to, text)});
        };
        for (const auto& refused : after.refused)
            if (!has(before, refused)) tell(true, refused, "are not connected: " + refused.reason);
        for (const auto& refused : before.refused)
            if (!has(after, refused) && lives(refused.pid)) tell(false, refused, "are no longer refused");
    }

    // The sides of a link say more about a host than this.
    void compare_hosts_without_links(const State& before, const State& after) {
        for (const HostState& was : before.hosts) {
            const bool lives = std::any_of(after.hosts.begin(), after.hosts.end(),
                                           [&](const HostState& is) { return is.pid == was.pid; });
            if (was.links.empty() && !lives)
                events_.push_back({0, time_ms_, true, was.program,
                                   fmt::format("{} (pid {}) has ended or died", was.program, was.pid)});
        }
    }

    void compare_hangs(const std::vector<TickState>& before, const std::vector<TickState>& after) {
        const auto same_in = [](const std::vector<TickState>& ticks, const TickState& tick) {
            return std::find_if(ticks.begin(), ticks.end(), [&](const TickState& each) {
                return each.pid == tick.pid && each.slot == tick.slot && each.name == tick.name;
            });
        };
        for (const TickState& tick : after) {
            const auto was = same_in(before, tick);
            const bool hung = was != before.end() && was->hang;
            if (tick.hang && !hung) events_.push_back({0, time_ms_, true, tick.program, describe_hang(tick)});
            if (!tick.hang && hung)
                events_.push_back(
                    {0, time_ms_, false, tick.program,
                     fmt::format("{} (pid {}) continues after {:.0f} s",
                                 was->hang->component.empty() ? tick.name : was->hang->component, tick.pid,
                                 was->hang->seconds)});
        }
    }

    void compare_components(const State& before, const State& after) {
        for (const ComponentStatus& component : after.components) {
            const auto found =
                std::find_if(before.components.begin(), before.components.end(), [&](const auto& each) {
                    return each.pid == component.pid && each.name == component.name;
                });
            const ComponentStatus was = found != before.components.end() ? *found : ComponentStatus{};
            compare_component(was, component);
        }
    }

    void compare_notices(const State& before, const State& after) {
        for (const NoticeState& notice : after.notices)
            if (std::find(before.notices.begin(), before.notices.end(), notice) == before.notices.end())
                events_.push_back({0, time_ms_, true, notice.program, notice.text});
    }

    std::vector<Event> take() { return std::move(events_); }

  private:
    void compare_component(const ComponentStatus& was, const ComponentStatus& is) {
        using process::ComponentState;
        const auto tell = [&](bool bad, const std::string& text) {
            events_.push_back({0, time_ms_, bad, is.program, text});
        };
        if (hangs(is) != hangs(was))
            tell(hangs(is),
                 hangs(is) ? describe_component(is) : fmt::format("{} (pid {}) continues", is.name, is.pid));
        if (is.state == was.state || hangs(is)) return;
        if (is.state == ComponentState::error || was.state == ComponentState::active)
            tell(true, describe_component(is));
        else if (is.state == ComponentState::active && was.state != ComponentState::none)
            tell(false, fmt::format("{} (pid {}) is active", is.name, is.pid));
    }
    void compare_side(const LinkState& before, const LinkState& after, Side side) {
        const SideState &was = before.side(side), &is = after.side(side);
        const bool other_process = !was.is_process_of(is), was_there = was.state != PeerState::absent;
        const auto tell = [&](bool bad, const char* what) { add_host(after, side, is, bad, what); };
        if (is.state == PeerState::dead || is.gone) {
            if (was_there && was.state != PeerState::dead) add_end(after, side, is, is.left);
            return;
        }
        if (was.state == is.state && !other_process) return;
        if (was_there && was.state != PeerState::dead && other_process)
            add_end(after, side, was, is.previous_left); // its successor came before the monitor looked
        if (is.state == PeerState::stopped)
            tell(true, "is stopped");
        else if (is.state == PeerState::alive && was.state == PeerState::stopped && !other_process)
            tell(false, "continues");
        else if (is.state == PeerState::alive)
            tell(false, !was.has_process() ? "has joined"
                        : other_process    ? "has started again"
                                           : "has joined again");
    }

    void compare_ports(const LinkState& before, const LinkState& after) {
        for (const PortState& port : after.ports) {
            const auto was =
                std::find_if(before.ports.begin(), before.ports.end(), [&](const PortState& old) {
                    return old.name == port.name && old.owner == port.owner;
                });
            if (was == before.ports.end()) continue;
            const auto edge = [&](std::uint64_t PortState::*count, const char* what) {
                if ((*was).*count == 0 && port.*count != 0)
                    add(after, true, fmt::format("port {}: {} start", port.name, what));
                if ((*was).*count != 0 && port.*count == 0)
                    add(after, false, fmt::format("port {}: no more {}", port.name, what));
            };
            edge(&PortState::lost_recently, "drops");
            edge(&PortState::missed_recently, "missed deadlines");
            edge(&PortState::undecodable_recently, "messages that cannot be decoded");
        }
    }

    void compare_call_queues(const LinkState& before, const LinkState& after) {
        for (const CallQueueState& queue : after.call_queues)
            for (const CallQueueState& was : before.call_queues)
                if (was.name == queue.name && was.owner == queue.owner && was.failed_recently == 0 &&
                    queue.failed_recently != 0)
                    add(after, true,
                        fmt::format("calls of the {} host start failing", model_of(after, queue.callers)));
    }

    void add_end(const LinkState& link, Side side, const SideState& host, bool in_order) {
        add_host(link, side, host, !in_order, in_order ? "has ended cleanly" : "has died");
    }
    void add_host(const LinkState& link, Side side, const SideState& host, bool bad, const char* what) {
        add(link, bad,
            fmt::format("the {} host{} ({}) {}", model_of(link, side),
                        host.program.empty() ? "" : " " + host.program,
                        command::format_pid(host.pid, host.pid_elsewhere), what));
    }
    void add(const LinkState& link, bool bad, std::string text) {
        events_.push_back({0, time_ms_, bad, link.name, std::move(text)});
    }

    std::uint64_t time_ms_;
    std::vector<Event> events_;
};

const LinkState* find_link(const State& state, const std::string& name) {
    const auto found = std::find_if(state.links.begin(), state.links.end(),
                                    [&](const LinkState& link) { return link.name == name; });
    return found != state.links.end() ? &*found : nullptr;
}

} // namespace

std::vector<Event> events_between(const State& before, const State& after) {
    Comparison comparison(after.time_ms);
    if (!after.error.empty()) return {}; // nothing was read, so no link is missing
    for (const LinkState& link : after.links) {
        const LinkState* const was = find_link(before, link.name);
        if (was == nullptr)
            comparison.came(link);
        else
            comparison.compare(*was, link);
    }
    for (const LinkState& link : before.links)
        if (find_link(after, link.name) == nullptr) comparison.gone(link);
    comparison.compare_hosts_without_links(before, after);
    comparison.compare_refusals(before, after);
    comparison.compare_components(before, after);
    comparison.compare_notices(before, after);
    comparison.compare_hangs(before.ticks, after.ticks);
    return comparison.take();
}

void EventLog::add(std::vector<Event> events) {
    for (Event& event : events) {
        event.number = ++count_;
        events_.push_back(std::move(event));
        if (events_.size() > capacity) events_.pop_front();
    }
}

} // namespace tandem::monitor
