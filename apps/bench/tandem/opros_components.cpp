// SPDX-License-Identifier: Apache-2.0
// The cost of pushes, calls and events between OPRoS components of one process, and the lateness of a 1 ms
// period, as the engine connects and runs them. Each case has a hand-written counterpart in
// baseline/hand_written.cpp.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/in_process_cases.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/harness/tick_budget.hpp"
#include "apps/bench/machine/cores.hpp"
#include "apps/bench/measurements/time_each_call.hpp"
#include "apps/bench/tandem/opros/BenchParts.hpp"

#include "host/opros/engine/application.hpp"
#include "host/rt/periodic_tick.hpp"
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <thread>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;
constexpr const char* connected = "BenchParts.xml"; ///< two instances, connected by all their ports
constexpr const char* periodic = "BenchTick.xml";   ///< one instance with a period of 1 ms

/// An application of BenchParts components in this process, started.
class PartsApplication {
  public:
    PartsApplication(Session& session, const std::string& profile, std::chrono::nanoseconds tick_spin = {})
        : folder_(fs::temp_directory_path() / session.name()),
          application_(write_application_profile(session, profile), options(tick_spin)) {
        application_.start();
    }

    /// Throws std::runtime_error if there is no component of this name.
    BenchParts& part(const std::string& name) {
        auto* component = application_.find_component(name);
        auto* parts = component ? dynamic_cast<BenchParts*>(&component->component()) : nullptr;
        if (!parts) throw std::runtime_error("the application has no BenchParts component " + name);
        return *parts;
    }
    engine::Application& application() { return application_; }

  private:
    static engine::ApplicationOptions options(std::chrono::nanoseconds tick_spin) {
        engine::ApplicationOptions options;
        // The plugins are beside the programs, in the build tree and in the installed one.
        options.plugin_dirs = {fs::read_symlink("/proc/self/exe").parent_path() / "../plugins/opros"};
        options.strict = true;
        options.executors.tick_spin = tick_spin;
        return options;
    }

    /// Returns an element of the application profile, from an output port of From to an input port of To.
    static std::string connection(const char* type, const char* source, const char* target) {
        return fmt::format(
            "<port_connection port_type=\"{}\"><source component_name=\"From\" port_name=\"{}\"/>"
            "<target component_name=\"To\" port_name=\"{}\"/></port_connection>\n",
            type, source, target);
    }

    /// Returns the path of the profile. Properties become parameters of the component's TickRecord.
    fs::path write_application_profile(Session& session, const std::string& profile) const {
        fs::create_directory(folder_); // removed with the case's leftovers
        const auto component = [&](const char* name) {
            return fmt::format(
                "<subcomponent><name>{}</name><reference>{}</reference><properties>"
                "<property name=\"period_ns\">{}</property><property name=\"samples\">{}</property>"
                "<property name=\"origin_ns\">{}</property></properties></subcomponent>\n",
                name, profile, tick_period_ns, session.budget().samples, rt::grid_origin.count());
        };
        std::ofstream(folder_ / "app.xml")
            << "<package_profile><name>app</name><subcomponents>\n"
            << component("From") << (profile == periodic ? "" : component("To"))
            << "</subcomponents>\n<port_connections>\n"
            << (profile == periodic
                    ? ""
                    : connection("data", "out", "in") + connection("data", "arrays_out", "arrays_in") +
                          connection("event", "events_out", "events_in") +
                          connection("service", "doubler_required", "doubler"))
            << "</port_connections></package_profile>\n";
        return folder_ / "app.xml";
    }

    fs::path folder_;
    engine::Application application_;
};

/// Measures from the call of push() until the value is in the other component's queue.
void push_double(Session& session) {
    PartsApplication components(session, connected);
    BenchParts& from = components.part("From");
    time_each_call(session, [&](double value) { from.push(value); });
    double last = -1; // the port keeps the newest only
    double value = components.part("To").pop_value();
    while (value >= 0) {
        last = value;
        value = components.part("To").pop_value();
    }
    if (last <= 0) throw std::runtime_error("the input port has none of the pushed values");
}

/// Measures from the call of push() until the receiver has taken the value out.
void push_and_pop(Session& session) {
    PartsApplication components(session, connected);
    BenchParts& from = components.part("From");
    BenchParts& to = components.part("To");
    time_each_call(session, [&](double value) {
        from.push(value);
        if (to.pop_value() != value)
            throw std::runtime_error("the input port has another value than was pushed");
    });
}

/// Measures a push of an array, which is copied into the queue.
void push_array(Session& session) {
    PartsApplication components(session, connected);
    BenchParts& from = components.part("From");
    const std::vector<double> values(session.bytes() / sizeof(double), 1.5);
    time_each_call(session, [&](double) { from.push(values); });
}

/// Measures a blocking service call from one component to the other.
void call_doubler(Session& session) {
    PartsApplication components(session, connected);
    BenchParts& from = components.part("From");
    time_each_call(session, [&](double value) {
        if (from.call(value) != 2 * value) throw std::runtime_error("wrong result of a call");
    });
}

/// Measures from send_event() to onEvent() in the engine's worker, which sleeps in between. Sender and worker
/// need a core each.
void event(Session& session) {
    pin_to_all_cores();
    PartsApplication components(session, connected);
    BenchParts& from = components.part("From");
    const BenchParts& to = components.part("To");
    double sent = 0;
    const auto send_and_wait = [&](double) {
        from.send_event(++sent);
        while (to.last_event() != sent) {
        }
    };
    time_each_call(session, send_and_wait, [](double) { busy_wait(2e5); });
}

/// Lets the periodic component tick for `ticks` periods and stops the application.
void run_for(BenchParts& parts, engine::Application& application, int periods) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(tick_period_ns) * periods);
    application.stop();
    if (parts.tick_record().ticks() == 0) throw std::runtime_error("the component has not ticked");
}

/// Measures how long after its planned time onExecute() is called. With tick-spin (Wake::spin), the engine
/// polls the last 200 us before each tick.
void measure_executor_lateness(Session& session) {
    const bool spin = session.bench_case().wake == Wake::spin;
    PartsApplication components(session, periodic, std::chrono::microseconds(spin ? 200 : 0));
    BenchParts& parts = components.part("From");
    run_for(parts, components.application(), lateness_ticks(session.budget()));
    for (const std::int64_t late : parts.tick_record().lateness_ns())
        session.add_result(static_cast<double>(late));
    session.set_tick_counts(parts.tick_record().counts());
}

/// Measures the difference between the mean period and 1 ms.
void measure_executor_drift(Session& session) {
    PartsApplication components(session, periodic);
    BenchParts& parts = components.part("From");
    run_for(parts, components.application(), drift_ticks(session.budget()));
    // The engine's own counts, so that each period can be accounted for.
    fmt::print(stderr, "{}\n", components.application().executor_stats().at(0));
    session.add_result(std::abs(parts.tick_record().mean_drift_ns()));
    session.set_tick_counts(parts.tick_record().counts());
}

} // namespace

void add_opros_cases(Registry& registry) {
    InProcessCases cases(registry, Group::tandem, "opros");
    cases.add("push", sizeof(double), Wake::none, push_double);
    cases.add("push-and-pop", sizeof(double), Wake::none, push_and_pop);
    cases.add("push", 1000 * sizeof(double), Wake::none, push_array);
    cases.add("local-call", sizeof(double), Wake::none, call_doubler);
    cases.add_event(event);
    cases.add("tick", sizeof(double), Wake::blocking, measure_executor_lateness);
    cases.add("tick", sizeof(double), Wake::spin, measure_executor_lateness);
    cases.add_tick_drift(measure_executor_drift);
}

} // namespace tandem::bench
