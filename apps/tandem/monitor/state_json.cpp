// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/state_json.hpp"

#include "apps/tandem/shm/segment_format.hpp"

namespace tandem::monitor {
namespace {

using Json = nlohmann::ordered_json;
using shm::Side;

Json times_json(const Times& times) {
    if (times.samples == 0) return nullptr;
    return {{"samples", times.samples},
            {"p50_ns", times.p50_ns},
            {"p99_ns", times.p99_ns},
            {"max_ns", times.max_ns},
            {"octaves", times.octaves}};
}

Json side_json(const LinkState& link, Side which) {
    const SideState& side = link.side(which);
    return {{"model", model_of(link, which)},
            {"state", side.gone ? "gone" : command::to_string(side.state)},
            {"ended_in_order", side.left},
            {"pid", side.pid},
            {"pid_in_other_namespace", side.pid_elsewhere},
            {"program", side.program}};
}

Json port_json(const PortState& port) {
    if (!port.damage.empty())
        return {{"name", port.name}, {"owner", name_of(port.owner)}, {"damage", port.damage}};
    const auto& c = port.counters;
    return {{"name", port.name},
            {"owner", name_of(port.owner)},
            {"writer", name_of(port.writer)},
            {"component", port.component},
            {"type", port.type},
            {"sent_per_s", port.sent_per_s},
            {"bytes_per_s", port.bytes_per_s},
            {"age", times_json(port.recent_age)},
            {"sent", c.sent},
            {"received", c.received},
            {"waiting", c.waiting()},
            {"dropped", {{"refused", c.refused}, {"overwritten", c.overwritten}, {"skipped", c.skipped}}},
            {"lost", c.lost()},
            {"converted", c.converted},
            {"undecodable", c.undecodable},
            {"discarded", c.discarded},
            {"missed_deadlines", c.missed_deadlines},
            {"recently",
             {{"lost", port.lost_recently},
              {"undecodable", port.undecodable_recently},
              {"missed_deadlines", port.missed_recently}}},
            {"silent_s", port.silent_s ? Json(*port.silent_s) : Json()},
            {"value", port.value},
            {"value_note", port.value_note}};
}

Json call_queue_json(const CallQueueState& queue) {
    if (!queue.damage.empty())
        return {{"name", queue.name}, {"owner", name_of(queue.owner)}, {"damage", queue.damage}};
    const auto& c = queue.counters;
    return {{"name", queue.name},
            {"owner", name_of(queue.owner)},
            {"callers", name_of(queue.callers)},
            {"calls_per_s", queue.calls_per_s},
            {"answered_per_s", queue.answered_per_s},
            {"round_trip", times_json(queue.recent_round_trip)},
            {"open_calls", queue.open_calls},
            {"calls", c.calls},
            {"answered", c.answered},
            {"timeouts", c.timeouts},
            {"overloads", c.overloads},
            {"cancels", c.cancels},
            {"expired", c.expired},
            {"recently", {{"failed", queue.failed_recently}}}};
}

Json hang_json(const std::optional<HangState>& hang) {
    if (!hang) return nullptr;
    return {{"component", hang->component},
            {"callback", hang->callback},
            {"since_ms", hang->since_ms},
            {"seconds", hang->seconds}};
}

Json link_json(const LinkState& link) {
    Json json{{"name", link.name},
              {"generation", link.generation},
              {"readable", link.readable},
              {"reason", link.reason},
              {"damage", link.damage},
              {"memory_bytes", link.memory_bytes},
              {"sides", Json::object()},
              {"ports", Json::array()},
              {"call_queues", Json::array()},
              {"shared_ports", Json::array()}};
    for (const Side side : {Side::first, Side::second}) json["sides"][name_of(side)] = side_json(link, side);
    for (const PortState& port : link.ports) json["ports"].push_back(port_json(port));
    for (const CallQueueState& queue : link.call_queues)
        json["call_queues"].push_back(call_queue_json(queue));
    for (const SharedPort& port : link.shared_ports)
        json["shared_ports"].push_back({{"name", port.name},
                                        {"owner", name_of(port.owner)},
                                        {"kind", port.kind},
                                        {"component", port.component},
                                        {"type", port.type},
                                        {"mismatch", port.mismatch}});
    return json;
}

Json usage_json(const HostUsage& usage) {
    Json threads = Json::array();
    for (const ThreadUsage& thread : usage.threads)
        threads.push_back({{"tid", thread.tid}, {"name", thread.name}, {"cpu_percent", thread.cpu_percent}});
    return {{"stopped", usage.stopped},
            {"cpu_percent", usage.cpu_percent},
            {"resident_bytes", usage.resident_bytes},
            {"threads", usage.thread_count},
            {"busiest_threads", std::move(threads)}};
}

Json inventory_json(const HostInventory& inventory) {
    Json json{{"components", Json::array()}, {"contexts", Json::array()}, {"ports", Json::array()}};
    for (const HostComponent& component : inventory.components)
        json["components"].push_back({{"name", component.name},
                                      {"type", component.type},
                                      {"execution", component.execution},
                                      {"period_ns", component.period_ns},
                                      {"names", component.names}});
    for (const HostContext& context : inventory.contexts)
        json["contexts"].push_back({{"owner", context.owner},
                                    {"kind", context.kind},
                                    {"period_ns", context.period_ns},
                                    {"running", context.running},
                                    {"components", context.components}});
    for (const HostPort& port : inventory.ports)
        json["ports"].push_back({{"component", port.component},
                                 {"name", port.name},
                                 {"kind", port.kind},
                                 {"direction", port.direction},
                                 {"type", port.type},
                                 {"connections", port.connections}});
    return json;
}

Json host_json(const HostState& host) {
    Json json{{"pid", host.pid}, {"program", host.program}, {"links", host.links}};
    json.update(usage_json(host.usage));
    json["inventory"] = host.inventory ? inventory_json(*host.inventory) : Json();
    return json;
}

const char* name_of(process::ComponentState state) {
    return state == process::ComponentState::active  ? "active"
           : state == process::ComponentState::error ? "error"
                                                     : "inactive";
}

const char* name_of(process::NoticeKind kind) {
    return kind == process::NoticeKind::component ? "component"
           : kind == process::NoticeKind::unseen  ? "unseen"
           : kind == process::NoticeKind::lost    ? "lost"
                                                  : "setting";
}

void add_host_reports(const State& state, Json& json) {
    for (const ComponentStatus& component : state.components)
        json["components"].push_back({{"name", component.name},
                                      {"program", component.program},
                                      {"pid", component.pid},
                                      {"state", name_of(component.state)},
                                      {"in_cycle_s", component.in_cycle_s},
                                      {"reason", component.reason}});
    for (const NoticeState& notice : state.notices)
        json["notices"].push_back({{"program", notice.program},
                                   {"pid", notice.pid},
                                   {"kind", name_of(notice.kind)},
                                   {"text", notice.text}});
}

Json worst_json(const Verdict& verdict) {
    Json worst = Json::array();
    for (const Finding& finding : verdict.worst)
        worst.push_back({{"level", name_of(finding.level)},
                         {"text", text_of(finding.level)},
                         {"reason", finding.reason}});
    return worst;
}

} // namespace

std::string state_json(const State& state, const Verdict& verdict, const std::deque<Event>& events,
                       const nlohmann::ordered_json& control) {
    Json json{{"time_ms", state.time_ms},
              {"recent_s", recent_s},
              {"verdict",
               {{"level", name_of(verdict.level)},
                {"text", verdict.text},
                {"reason", verdict.reason},
                {"findings", verdict.findings},
                {"worst", worst_json(verdict)}}},
              {"cut", state.cut},
              {"control", control},
              {"links", Json::array()},
              {"hosts", Json::array()},
              {"ticks", Json::array()},
              {"refused_connections", Json::array()},
              {"components", Json::array()},
              {"notices", Json::array()},
              {"missing_links", state.missing_links},
              {"unseen", state.unseen},
              {"events", Json::array()}};
    for (const LinkState& link : state.links) json["links"].push_back(link_json(link));
    for (const HostState& host : state.hosts) json["hosts"].push_back(host_json(host));
    for (const TickState& tick : state.ticks)
        json["ticks"].push_back({{"name", tick.name},
                                 {"program", tick.program},
                                 {"pid", tick.pid},
                                 {"period_ns", tick.period_ns},
                                 {"ticks_per_s", tick.ticks_per_s},
                                 {"ticks", tick.ticks},
                                 {"overruns", tick.overruns},
                                 {"overruns_recently", tick.overruns_recently},
                                 {"skipped", tick.skipped},
                                 {"latest_ns", tick.latest_ns},
                                 {"hang", hang_json(tick.hang)},
                                 {"lateness", times_json(tick.recent_lateness)},
                                 {"longest_ns", tick.longest_ns},
                                 {"execution", times_json(tick.recent_execution)}});
    for (const RefusedConnectionState& refused : state.refused)
        json["refused_connections"].push_back({{"program", refused.program},
                                               {"pid", refused.pid},
                                               {"from", refused.from},
                                               {"to", refused.to},
                                               {"reason", refused.reason}});
    add_host_reports(state, json);
    for (const Event& event : events)
        json["events"].push_back({{"number", event.number},
                                  {"time_ms", event.time_ms},
                                  {"bad", event.bad},
                                  {"link", event.link},
                                  {"text", event.text}});
    // Texts of messages may contain any byte.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace tandem::monitor
