// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/metrics.hpp"

#include "apps/tandem/monitor/verdict.hpp"

#include <fmt/format.h>

#include <array>
#include <functional>
#include <map>
#include <utility>

namespace tandem::monitor {
namespace {

using shm::Side;

/// Bucket bounds as exponents of two, in ns: from 1 us to 17 s, in factors of four. They are also bounds of the
/// segments' histograms, so that each duration is in the correct bucket.
constexpr unsigned first_exponent = 10, last_exponent = 34;

/// Escapes a label's value. The texts of a State are printable ASCII.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\' || c == '"') result += '\\';
        result += c;
    }
    return result;
}

class Text {
  public:
    void family(const char* name, const char* type, const char* help, const char* unit = "") {
        name_ = name;
        print("# TYPE {} {}\n", name, type);
        if (*unit != '\0') print("# UNIT {} {}\n", name, unit);
        print("# HELP {} {}\n", name, help);
    }
    /// Writes a sample of the family with its type's suffix.
    template <class Number>
    void sample(const char* suffix, const std::string& labels, Number value) {
        print("{}{}{{{}}} {}\n", name_, suffix, labels, value);
    }
    /// Omits the sum, because segments do not contain it, and the count, because it requires a sum.
    void histogram(const std::string& labels, const shm::HistogramCounts& times) {
        std::size_t bucket = 0;
        std::uint64_t below = 0;
        for (unsigned exponent = first_exponent; exponent <= last_exponent; exponent += 2) {
            const std::uint64_t bound_ns = std::uint64_t{1} << exponent;
            for (; bucket < shm::layout::Histogram::bucket_of(bound_ns); ++bucket)
                below += times.counts[bucket];
            sample("_bucket", fmt::format("{},le=\"{}\"", labels, static_cast<double>(bound_ns) / 1e9),
                   below);
        }
        sample("_bucket", labels + ",le=\"+Inf\"", times.total());
    }
    /// Writes a histogram of octaves. The first octave ends at 64 ns.
    void octave_histogram(const std::string& labels,
                          const std::array<std::uint64_t, rt::TickSlot::octaves>& times) {
        constexpr unsigned first_end = 6; // 2^6 ns
        std::size_t octave = 0;
        std::uint64_t below = 0;
        for (unsigned exponent = first_exponent; exponent <= last_exponent; exponent += 2) {
            for (; octave < times.size() && octave + first_end <= exponent; ++octave) below += times[octave];
            sample(
                "_bucket",
                fmt::format("{},le=\"{}\"", labels, static_cast<double>(std::uint64_t{1} << exponent) / 1e9),
                below);
        }
        for (; octave < times.size(); ++octave) below += times[octave];
        sample("_bucket", labels + ",le=\"+Inf\"", below);
    }
    std::string take() {
        text_ += "# EOF\n";
        return std::move(text_);
    }

  private:
    template <class... Arguments>
    void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        // fmt::format_to() would instantiate half of fmt again.
        text_ += fmt::format(format, std::forward<Arguments>(arguments)...);
    }
    std::string text_;
    const char* name_ = "";
};

/// Calls `each` with the labels of every undamaged object.
template <class Object>
void for_each(const State& state, std::vector<Object> LinkState::*objects, const char* label,
              Side Object::*user, const char* user_label,
              const std::function<void(const std::string&, const Object&)>& each) {
    for (const LinkState& link : state.links)
        for (const Object& object : link.*objects)
            if (object.damage.empty())
                each(fmt::format("link=\"{}\",{}=\"{}\",owner=\"{}\",{}=\"{}\"", escaped(link.name), label,
                                 escaped(object.name), name_of(object.owner), user_label,
                                 name_of(object.*user)),
                     object);
}

void add_ports(const State& state, Text& text) {
    using Port = PortState;
    const auto ports = [&](const std::function<void(const std::string&, const Port&)>& each) {
        for_each<Port>(state, &LinkState::ports, "port", &Port::writer, "writer", each);
    };
    const auto counter = [&](const char* name, const char* help, std::uint64_t shm::RingCounters::*count,
                             const char* unit = "") {
        text.family(name, "counter", help, unit);
        ports([&](const std::string& labels, const Port& port) {
            text.sample("_total", labels, port.counters.*count);
        });
    };
    using Counters = shm::RingCounters;
    counter("tandem_port_sent_messages", "Messages sent by the writer.", &Counters::sent);
    counter("tandem_port_received_messages", "Messages received by the reader.", &Counters::received);
    text.family("tandem_port_dropped_messages", "counter",
                "Messages refused for lack of room, overwritten by newer ones, or skipped by the reader.");
    ports([&](const std::string& labels, const Port& port) {
        text.sample("_total", labels + ",kind=\"refused\"", port.counters.refused);
        text.sample("_total", labels + ",kind=\"overwritten\"", port.counters.overwritten);
        text.sample("_total", labels + ",kind=\"skipped\"", port.counters.skipped);
    });
    text.family("tandem_port_waiting_messages", "gauge", "Messages sent but not received yet.");
    ports([&](const std::string& labels, const Port& port) {
        text.sample("", labels, port.counters.waiting());
    });
    counter("tandem_port_converted_messages", "Messages converted to the receiver's type.",
            &Counters::converted);
    counter("tandem_port_undecodable_messages", "Messages received that are not a value of the port's type.",
            &Counters::undecodable);
    counter("tandem_port_discarded_messages",
            "Messages received for which the queue of a receiving port had no room.", &Counters::discarded);
    counter("tandem_port_missed_deadlines", "Deadlines (deadline_ms) that passed without a message.",
            &Counters::missed_deadlines);
    counter("tandem_port_sent_bytes", "Bytes of the messages sent.", &Counters::bytes_sent, "bytes");
    counter("tandem_port_received_bytes", "Bytes of the messages received.", &Counters::bytes_received,
            "bytes");
    text.family("tandem_port_age_seconds", "histogram",
                "Time from sending to reading, for a sample of the messages.", "seconds");
    ports([&](const std::string& labels, const Port& port) { text.histogram(labels, port.age); });
}

void add_call_queues(const State& state, Text& text) {
    using Queue = CallQueueState;
    const auto queues = [&](const std::function<void(const std::string&, const Queue&)>& each) {
        for_each<Queue>(state, &LinkState::call_queues, "queue", &Queue::callers, "callers", each);
    };
    const auto counter = [&](const char* name, const char* help, std::uint64_t shm::CallCounters::*count) {
        text.family(name, "counter", help);
        queues([&](const std::string& labels, const Queue& queue) {
            text.sample("_total", labels, queue.counters.*count);
        });
    };
    using Counters = shm::CallCounters;
    counter("tandem_calls_made", "Calls submitted.", &Counters::calls);
    counter("tandem_calls_answered", "Calls answered.", &Counters::answered);
    counter("tandem_calls_timed_out", "Calls abandoned by their callers at the deadline.",
            &Counters::timeouts);
    counter("tandem_calls_cancelled", "Calls abandoned by their callers before the deadline.",
            &Counters::cancels);
    counter("tandem_calls_refused", "Calls refused because no slot became free before the deadline.",
            &Counters::overloads);
    counter("tandem_calls_expired", "Calls taken but not run because the deadline had passed.",
            &Counters::expired);
    text.family("tandem_calls_open", "gauge", "Calls in progress.");
    queues([&](const std::string& labels, const Queue& queue) { text.sample("", labels, queue.open_calls); });
    text.family("tandem_call_round_trip_seconds", "histogram",
                "Time from a call to its reply, for a sample of the calls.", "seconds");
    queues([&](const std::string& labels, const Queue& queue) { text.histogram(labels, queue.round_trip); });
}

void add_links(const State& state, Text& text) {
    const auto sides = [&](const std::function<double(const SideState&)>& value) {
        for (const LinkState& link : state.links)
            for (const Side side : {Side::first, Side::second})
                if (link.readable)
                    text.sample("",
                                fmt::format("link=\"{}\",side=\"{}\",model=\"{}\"", escaped(link.name),
                                            name_of(side), escaped(model_of(link, side))),
                                value(link.side(side)));
    };
    text.family("tandem_side_up", "gauge",
                "1 if the side's process has joined the link, is alive and is not stopped.");
    sides([](const SideState& side) { return side.state == shm::PeerState::alive ? 1 : 0; });
    text.family("tandem_side_dead", "gauge", "1 if the side's process has died.");
    sides([](const SideState& side) { return side.state == shm::PeerState::dead ? 1 : 0; });
    text.family("tandem_link_generation", "gauge", "Generation of the link's segment.");
    for (const LinkState& link : state.links)
        if (link.readable) text.sample("", fmt::format("link=\"{}\"", escaped(link.name)), link.generation);
}

/// Calls `each` with the labels of every tick. Numbers ticks of a process with the same name.
void for_each_tick(const State& state,
                   const std::function<void(const std::string&, const TickState&)>& each) {
    std::map<std::pair<std::uint32_t, std::string>, int> seen;
    for (const TickState& tick : state.ticks)
        each(fmt::format("component=\"{}\",host=\"{}\",pid=\"{}\",number=\"{}\"", escaped(tick.name),
                         escaped(tick.program), tick.pid, ++seen[{tick.pid, tick.name}]),
             tick);
}

void add_ticks(const State& state, Text& text) {
    const auto counter = [&](const char* name, const char* help, std::uint64_t TickState::*count) {
        text.family(name, "counter", help);
        for_each_tick(state, [&](const std::string& labels, const TickState& tick) {
            text.sample("_total", labels, tick.*count);
        });
    };
    text.family("tandem_tick_period_seconds", "gauge", "Period of a component's ticks.", "seconds");
    for_each_tick(state, [&](const std::string& labels, const TickState& tick) {
        text.sample("", labels, static_cast<double>(tick.period_ns) / 1e9);
    });
    counter("tandem_ticks", "Ticks of a component, or of several that tick together.", &TickState::ticks);
    counter("tandem_tick_overruns", "Ticks that were already due when the previous work ended.",
            &TickState::overruns);
    counter("tandem_tick_skipped_periods", "Periods without a tick.", &TickState::skipped);
    text.family("tandem_tick_hang_seconds", "gauge",
                "Time for which a component has hung in a callback or got no CPU time; 0 if it ticks.",
                "seconds");
    for_each_tick(state, [&](const std::string& labels, const TickState& tick) {
        text.sample("", labels, tick.hang ? tick.hang->seconds : 0.0);
    });
    text.family("tandem_tick_lateness_seconds", "histogram", "Time from when a tick was due to its start.",
                "seconds");
    for_each_tick(state, [&](const std::string& labels, const TickState& tick) {
        text.octave_histogram(labels, tick.lateness);
    });
    text.family("tandem_tick_execution_seconds", "histogram", "Time from the start of a tick to its end.",
                "seconds");
    for_each_tick(state, [&](const std::string& labels, const TickState& tick) {
        text.octave_histogram(labels, tick.execution);
    });
}

void add_verdict(const State& state, Text& text) {
    const Level level = judge(state).level;
    text.family("tandem_verdict", "gauge", "1 for the level of the verdict, 0 for the others.");
    for (int each = 0; each <= static_cast<int>(worst_level); ++each)
        text.sample("", fmt::format("level=\"{}\"", name_of(static_cast<Level>(each))),
                    static_cast<Level>(each) == level ? 1 : 0);
    text.family("tandem_component_active", "gauge", "1 if the component is ACTIVE, 0 if it is not.");
    for (const ComponentStatus& component : state.components)
        text.sample("",
                    fmt::format("component=\"{}\",host=\"{}\",pid=\"{}\"", escaped(component.name),
                                escaped(component.program), component.pid),
                    component.state == process::ComponentState::active ? 1 : 0);
}

} // namespace

std::string metrics_text(const State& state) {
    Text text;
    add_verdict(state, text);
    add_links(state, text);
    add_ports(state, text);
    add_call_queues(state, text);
    add_ticks(state, text);
    return text.take();
}

} // namespace tandem::monitor
