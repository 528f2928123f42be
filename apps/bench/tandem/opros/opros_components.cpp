// SPDX-License-Identifier: Apache-2.0
// What OPRoS components of one process cost each other: pushes, calls, events, and a 1 ms period, as the
// engine connects and runs them. Each has a minimal hand-written counterpart in hand_written.cpp.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/power_profile.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/harness/time_each.hpp"
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
constexpr std::int64_t period_ns = 1'000'000;

/// Two of the bench's component, connected in all ways, or one that ticks.
class Components {
  public:
    Components(Session& session, const std::string& profile, std::chrono::nanoseconds spin = {})
        : folder_(fs::temp_directory_path() / session.name()),
          application_(write(session, profile), options(spin)) {
        application_.start();
    }

    BenchParts& part(const std::string& name) {
        auto* component = application_.find_component(name);
        auto* parts = component ? dynamic_cast<BenchParts*>(&component->component()) : nullptr;
        if (!parts) throw std::runtime_error("the bench's OPRoS component " + name + " is not there");
        return *parts;
    }
    engine::Application& application() { return application_; }

  private:
    static engine::ApplicationOptions options(std::chrono::nanoseconds spin) {
        engine::ApplicationOptions options;
        options.plugin_dirs = {fs::read_symlink("/proc/self/exe").parent_path() / "../plugins/opros"};
        options.strict = true;
        options.executors.tick_spin = spin;
        return options;
    }

    static std::string connection(const char* type, const char* source, const char* target) {
        return fmt::format(
            "<port_connection port_type=\"{}\"><source component_name=\"From\" port_name=\"{}\"/>"
            "<target component_name=\"To\" port_name=\"{}\"/></port_connection>\n",
            type, source, target);
    }

    fs::path write(Session& session, const std::string& profile) const {
        fs::create_directory(folder_); // removed with the case's left-overs
        const auto component = [&](const char* name) {
            return fmt::format(
                "<subcomponent><name>{}</name><reference>{}</reference><properties>"
                "<property name=\"period_ns\">{}</property><property name=\"samples\">{}</property>"
                "<property name=\"origin_ns\">{}</property></properties></subcomponent>\n",
                name, profile, period_ns, session.budget().samples, rt::grid_origin.count());
        };
        std::ofstream(folder_ / "app.xml")
            << "<package_profile><name>app</name><subcomponents>\n"
            << component("From") << (profile == "BenchTick.xml" ? "" : component("To"))
            << "</subcomponents>\n<port_connections>\n"
            << (profile == "BenchTick.xml"
                    ? ""
                    : connection("data", "out", "in") + connection("data", "arrays_out", "arrays_in") +
                          connection("event", "news_out", "news_in") +
                          connection("service", "needed", "doubler"))
            << "</port_connections></package_profile>\n";
        return folder_ / "app.xml";
    }

    fs::path folder_;
    engine::Application application_;
};

void push_double(Session& session) {
    Components components(session, "BenchParts.xml");
    BenchParts& from = components.part("From");
    time_each_call(session, [&](double value) { from.push(value); });
    double last = -1;
    for (double value = 0; value >= 0; value = components.part("To").pop()) last = value;
    if (last <= 0) throw std::runtime_error("the pushed values have not come");
}

void push_and_pop(Session& session) {
    Components components(session, "BenchParts.xml");
    BenchParts& from = components.part("From");
    BenchParts& to = components.part("To");
    time_each_call(session, [&](double value) {
        from.push(value);
        if (to.pop() != value) throw std::runtime_error("another value came than was pushed");
    });
}

void push_array(Session& session) {
    Components components(session, "BenchParts.xml");
    BenchParts& from = components.part("From");
    const std::vector<double> values(session.bytes() / sizeof(double), 1.5);
    time_each_call(session, [&](double) { from.push(values); });
}

void call(Session& session) {
    Components components(session, "BenchParts.xml");
    BenchParts& from = components.part("From");
    time_each_call(session, [&](double value) {
        if (from.call(value) != 2 * value) throw std::runtime_error("wrong result of a call");
    });
}

/// From the push to the call-back in the worker, which sleeps in between.
void event(Session& session) {
    pin_to_all_cores();
    Components components(session, "BenchParts.xml");
    BenchParts& from = components.part("From");
    const BenchParts& to = components.part("To");
    const std::uint64_t pause = to_ticks(2e5);
    const auto loop = [&] {
        for (double value = 1; session.needs_more(); ++value) {
            for (const std::uint64_t begin = ticks(); ticks() - begin < pause;) {
            }
            const std::uint64_t before = ticks();
            from.send_event(value);
            while (to.heard() != value) {
            }
            const std::uint64_t now = ticks();
            session.add_sample(now - before, now);
        }
    };
    session.begin_warm_up();
    loop();
    from.send_event(0);
    while (to.heard() != 0) {
    }
    session.begin_measuring();
    loop();
    session.end_measuring();
}

void run_for(BenchParts& parts, engine::Application& application, std::uint64_t periods) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(period_ns) * periods);
    application.stop();
    if (parts.ticks().ticks() == 0) throw std::runtime_error("the component has not ticked");
}

/// How much later than its time onExecute is called.
void lateness(Session& session) {
    const bool spin = session.bench_case().wake == Wake::spin;
    Components components(session, "BenchTick.xml", std::chrono::microseconds(spin ? 200 : 0));
    BenchParts& parts = components.part("From");
    run_for(parts, components.application(),
            std::min<std::uint64_t>(session.budget().samples,
                                    session.budget().samples >= 50'000 ? 10'000 : 1'000));
    for (const std::int64_t late : parts.ticks().lateness_ns()) session.add_result(static_cast<double>(late));
    session.set_tick_counts(parts.ticks().counts());
}

/// By how much the mean period differs from 1 ms; each tick is accounted for.
void drift(Session& session) {
    Components components(session, "BenchTick.xml");
    BenchParts& parts = components.part("From");
    run_for(parts, components.application(), session.budget().samples >= 50'000 ? 100'100 : 1'000);
    const auto stats = components.application().executor_stats().at(0);
    std::fprintf(stderr, "%s\n", stats.c_str());
    session.add_result(std::abs(parts.ticks().mean_drift_ns()));
    session.set_tick_counts(parts.ticks().counts());
}

} // namespace

void add_tandem_opros_cases(Registry& registry) {
    Case entry;
    entry.subject = "opros";
    entry.placement = Placement::alone;
    entry.wake = Wake::none;
    const auto add = [&](const char* operation, std::size_t bytes, void (*run)(Session&)) {
        entry.operation = operation;
        entry.bytes = bytes;
        entry.run = run;
        registry.cases.push_back(entry);
    };
    add("push", sizeof(double), push_double);
    add("push-and-pop", sizeof(double), push_and_pop);
    add("push", 1000 * sizeof(double), push_array);
    add("local-call", sizeof(double), call);
    entry.wake = Wake::blocking;
    entry.bytes = sizeof(double);
    entry.operation = "event";
    entry.run = event;
    registry.cases.push_back(entry);
    entry.regime = Regime::low_latency_idle;
    registry.cases.push_back(entry);
    entry.regime = Regime::normal;
    add("tick", sizeof(double), lateness);
    entry.wake = Wake::spin;
    add("tick", sizeof(double), lateness);
    entry.wake = Wake::blocking;
    entry.extra_seconds = 110;
    add("tick-drift", sizeof(double), drift);
}

} // namespace tandem::bench
