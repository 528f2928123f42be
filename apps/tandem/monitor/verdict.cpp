// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/verdict.hpp"
#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>

namespace tandem::monitor {
namespace {

using shm::PeerState;
using shm::Side;

constexpr struct {
    const char *name, *text;
} level_names[] = {{"well", "All is well"},
                   {"unseen", "Not everything can be seen"},
                   {"setting", "A setting is not in effect"},
                   {"inactive", "A component is not active"},
                   {"no_link", "No link"},
                   {"mismatch", "A port is not joined"},
                   {"waiting", "Waiting for a host"},
                   {"missing", "A link is missing"},
                   {"unrecorded", "The recording has failed"},
                   {"late", "Something is late"},
                   {"dropping", "Messages are lost"},
                   {"overrun", "A component does not keep its period"},
                   {"unreadable", "A link cannot be read"},
                   {"failed", "A component has failed"},
                   {"stopped", "A host is stopped"},
                   {"gone", "A host has ended"},
                   {"dead", "A host has died"},
                   {"hanging", "A component hangs"}};

/// Counts the findings and keeps the worst ones, in order.
class Findings {
  public:
    void add(Level level, std::string reason) {
        ++verdict_.findings;
        auto& worst = verdict_.worst;
        const auto milder = std::find_if(worst.begin(), worst.end(),
                                         [&](const Finding& finding) { return finding.level < level; });
        worst.insert(milder, {level, std::move(reason)});
        if (worst.size() > Verdict::max_worst) worst.pop_back();
    }
    Verdict verdict() && {
        if (!verdict_.worst.empty()) verdict_.level = verdict_.worst.front().level;
        if (!verdict_.worst.empty()) verdict_.reason = verdict_.worst.front().reason;
        verdict_.text = text_of(verdict_.level);
        return std::move(verdict_);
    }

  private:
    Verdict verdict_;
};

std::string host_of(const LinkState& link, Side side) {
    const SideState& host = link.side(side);
    return fmt::format(
        "the {} host{}{}", model_of(link, side), host.program.empty() ? "" : " " + host.program,
        host.has_process() ? fmt::format(" ({})", command::format_pid(host.pid, host.pid_elsewhere)) : "");
}

void judge_end(const LinkState& link, Side side, Findings& findings) {
    const bool in_order = link.side(side).left;
    findings.add(in_order ? Level::gone : Level::dead,
                 fmt::format("link {}: {} has {}", link.name, host_of(link, side),
                             in_order ? "ended cleanly" : "died"));
}

void judge_sides(const LinkState& link, Findings& findings) {
    for (const Side side : {Side::first, Side::second}) {
        const std::string host = host_of(link, side);
        switch (link.side(side).state) {
        case PeerState::dead:
            judge_end(link, side, findings);
            break;
        case PeerState::stopped:
            findings.add(Level::stopped,
                         fmt::format("link {}: {} is stopped by a signal or a debugger", link.name, host));
            break;
        case PeerState::absent:
            if (link.side(side).gone)
                judge_end(link, side, findings);
            else
                findings.add(Level::waiting, fmt::format("link {}: the peer of the {} host has not joined",
                                                         link.name, model_of(link, other(side))));
            break;
        case PeerState::alive:
            if (link.side(side).unpublished)
                findings.add(
                    Level::waiting,
                    fmt::format("link {}: {} has joined, but has not published its ports", link.name, host));
            break;
        }
    }
}

void judge_port(const LinkState& link, const PortState& port, Findings& findings) {
    const auto say = [&](Level level, const std::string& what) {
        findings.add(level, fmt::format("link {}, port {}: {}", link.name, port.name, what));
    };
    if (!port.damage.empty()) return say(Level::unreadable, port.damage);
    const auto recently = [](std::uint64_t count, const char* one, const char* many) {
        return fmt::format("{} {} in the last {:.0f} s", count, count == 1 ? one : many, recent_s);
    };
    if (port.lost_recently != 0)
        say(Level::dropping, recently(port.lost_recently, "message dropped", "messages dropped"));
    if (port.undecodable_recently != 0)
        say(Level::dropping,
            recently(port.undecodable_recently, "message not decodable", "messages not decodable"));
    if (port.missed_recently != 0)
        say(Level::late, recently(port.missed_recently, "missed deadline", "missed deadlines"));
}

void judge_call_queue(const LinkState& link, const CallQueueState& queue, Findings& findings) {
    const std::string where =
        fmt::format("link {}, calls of the {} host: ", link.name, model_of(link, queue.callers));
    if (!queue.damage.empty())
        findings.add(Level::unreadable, where + queue.damage);
    else if (queue.failed_recently != 0)
        findings.add(Level::late, where + fmt::format("{} timed out or refused in the last {:.0f} s",
                                                      queue.failed_recently, recent_s));
}

void judge_link(const LinkState& link, Findings& findings) {
    if (!link.readable)
        return findings.add(Level::unreadable, fmt::format("link {}: {}", link.name, link.reason));
    if (!link.damage.empty())
        findings.add(Level::unreadable, fmt::format("link {}: {}", link.name, link.damage));
    judge_sides(link, findings);
    for (const SharedPort& port : link.shared_ports)
        if (!port.mismatch.empty())
            findings.add(Level::mismatch, fmt::format("link {}, port {} of {}: {}", link.name, port.name,
                                                      port.component, port.mismatch));
    for (const PortState& port : link.ports) judge_port(link, port, findings);
    for (const CallQueueState& queue : link.call_queues) judge_call_queue(link, queue, findings);
}

Level level_of(process::NoticeKind kind) {
    return kind == process::NoticeKind::component ? Level::failed
           : kind == process::NoticeKind::unseen  ? Level::unseen
           : kind == process::NoticeKind::lost    ? Level::dropping
                                                  : Level::setting;
}

/// Judges what the hosts say about themselves.
void judge_hosts(const State& state, Findings& findings) {
    using process::ComponentState;
    for (const ComponentStatus& component : state.components)
        if (hangs(component))
            findings.add(Level::hanging, describe_component(component));
        else if (component.state != ComponentState::active)
            findings.add(component.state == ComponentState::error ? Level::failed : Level::inactive,
                         describe_component(component));
    for (const NoticeState& notice : state.notices)
        findings.add(level_of(notice.kind),
                     fmt::format("{} (pid {}): {}", notice.program, notice.pid, notice.text));
    for (const RefusedConnectionState& refused : state.refused)
        findings.add(Level::mismatch,
                     fmt::format("{} (pid {}) could not connect {} with {}: {}", refused.program, refused.pid,
                                 refused.from, refused.to, refused.reason));
}

/// Reports ACTIVE RTCs that run no cycle because each of their execution contexts is stopped.
void judge_contexts(const HostState& host, const State& state, Findings& findings) {
    if (!host.inventory) return;
    std::map<std::string, bool> is_run;
    for (const HostContext& context : host.inventory->contexts)
        for (const std::string& component : context.components) is_run[component] |= context.running;
    for (const ComponentStatus& component : state.components) {
        if (component.pid != host.pid || component.state != process::ComponentState::active) continue;
        if (const auto found = is_run.find(component.name); found != is_run.end() && !found->second)
            findings.add(Level::inactive,
                         fmt::format("{} in {} (pid {}) is active, but its execution context is stopped",
                                     component.name, component.program, component.pid));
    }
}

/// Reports missing links, a failed recording, and what could not be read.
void judge_completeness(const State& state, Findings& findings) {
    for (const std::string& link : state.missing_links)
        findings.add(Level::missing, fmt::format("link {} does not exist; start its hosts", link));
    if (!state.recording_failure.empty()) findings.add(Level::unrecorded, state.recording_failure);
    for (const std::string& unseen : state.unseen) findings.add(Level::unseen, unseen);
    if (!state.cut.empty()) findings.add(Level::unseen, state.cut);
}

std::string local_time(std::uint64_t ms_since_epoch) {
    const auto seconds = static_cast<std::time_t>(ms_since_epoch / 1000);
    std::tm local{};
    localtime_r(&seconds, &local);
    char text[16];
    return std::string(text, std::strftime(text, sizeof text, "%H:%M:%S", &local));
}

/// Reports hanging callbacks first, because a hanging component can take the CPU from other threads.
void judge_hangs(const std::vector<TickState>& ticks, Findings& findings) {
    for (const bool in_callback : {true, false})
        for (const TickState& tick : ticks)
            if (tick.hang && in_callback != tick.hang->callback.empty())
                findings.add(Level::hanging, describe_hang(tick));
}

void judge_tick(const TickState& tick, Findings& findings) {
    if (tick.hang) return;
    const auto overruns = static_cast<double>(tick.overruns_recently);
    const auto ticks = static_cast<double>(tick.ticks_recently);
    if (tick.overruns_recently == 0 || overruns < late_share * ticks) return;
    const bool bad = tick.overruns_recently >= few_overruns && overruns >= overrun_share * ticks;
    findings.add(bad ? Level::overrun : Level::late,
                 fmt::format("{} in {} (pid {}): {} of {} ticks of {:g} ms overran in the last {:.0f} s",
                             tick.name.empty() ? "a component" : tick.name, tick.program, tick.pid,
                             tick.overruns_recently, tick.ticks_recently,
                             static_cast<double>(tick.period_ns) / 1e6, recent_s));
}

} // namespace

const char* name_of(Level level) { return level_names[static_cast<std::size_t>(level)].name; }
const char* text_of(Level level) { return level_names[static_cast<std::size_t>(level)].text; }

std::string describe_hang(const TickState& tick) {
    const HangState& hang = *tick.hang;
    const bool in_callback = !hang.callback.empty();
    const std::string& name = in_callback ? hang.component : tick.name;
    return fmt::format("{} in {} (pid {}): {} since {} ({:.0f} s); its period is {:g} ms",
                       name.empty() ? "a component" : name, tick.program, tick.pid,
                       in_callback ? hang.callback + " has not returned" : "its thread gets no CPU time",
                       local_time(hang.since_ms), hang.seconds, static_cast<double>(tick.period_ns) / 1e6);
}

std::string describe_component(const ComponentStatus& component) {
    if (hangs(component))
        return fmt::format("{} in {} (pid {}): its cycle has not returned for {:.0f} s", component.name,
                           component.program, component.pid, component.in_cycle_s);
    const bool failed = component.state == process::ComponentState::error;
    return fmt::format("{} in {} (pid {}) is {}", component.name, component.program, component.pid,
                       !failed                    ? "not active"
                       : component.reason.empty() ? "in ERROR; its host's log says why"
                                                  : "in ERROR: " + component.reason);
}

Verdict judge(const State& state) {
    Findings findings;
    if (!state.error.empty())
        findings.add(Level::unreadable, state.error);
    else if (state.links.empty() && state.hosts.empty())
        findings.add(Level::no_link, "no link exists in /dev/shm; start the hosts");
    std::size_t seen = 0;
    for (const LinkState& link : state.links) {
        // Another user's link is in the table, but its state is unknown.
        if (link.foreign) continue;
        ++seen;
        judge_link(link, findings);
    }
    for (const HostState& host : state.hosts)
        if (host.usage.stopped && host.links.empty())
            findings.add(Level::stopped, fmt::format("{} (pid {}) is stopped by a signal or a debugger",
                                                     host.program, host.pid));
    judge_hangs(state.ticks, findings);
    for (const TickState& tick : state.ticks) judge_tick(tick, findings);
    judge_hosts(state, findings);
    for (const HostState& host : state.hosts) judge_contexts(host, state, findings);
    judge_completeness(state, findings);
    if (seen == 0 && !state.links.empty() && state.hosts.empty())
        findings.add(Level::no_link, "all links belong to other users");
    Verdict verdict = std::move(findings).verdict();
    if (verdict.level == Level::well)
        verdict.reason =
            seen == 0 ? fmt::format("{} {} without a link: nothing late in the last {:.0f} s",
                                    state.hosts.size(), state.hosts.size() == 1 ? "host" : "hosts", recent_s)
                      : fmt::format("{} {}: both hosts alive, nothing lost or late in the last {:.0f} s",
                                    seen, seen == 1 ? "link" : "links", recent_s);
    return verdict;
}

} // namespace tandem::monitor
