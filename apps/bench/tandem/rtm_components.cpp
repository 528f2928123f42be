// SPDX-License-Identifier: Apache-2.0
// The cost of writes, service calls and allocations between RT-Components of one process, and the lateness of
// a 1 ms period, as the manager connects and runs them. For comparison with the cases of opros, hand-written
// and cyclictest.
#include "apps/bench/harness/allocation_count.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/in_process_cases.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/harness/tick_budget.hpp"
#include "apps/bench/harness/tick_record.hpp"
#include "apps/bench/measurements/time_each_call.hpp"

#include "BenchEchoSkel.h"
#include "host/rt/periodic_tick.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/PeriodicExecutionContext.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tandem::bench {

namespace {

/// The servant behind the provided service port.
class Echo : public POA_Bench::Echo, public PortableServer::RefCountServantBase {
  public:
    CORBA::Double twice(CORBA::Double value) override { return 2 * value; }
};

/// A component with data ports of two types, a provided and a required service, and a record of its ticks.
class Parts : public RTC::DataFlowComponentBase {
  public:
    explicit Parts(RTC::Manager* manager) : DataFlowComponentBase(manager) {}
    RTC::ReturnCode_t onInitialize() override {
        addOutPort("long_out", long_out);
        addInPort("long_in", long_in);
        addOutPort("seq_out", seq_out);
        addInPort("seq_in", seq_in);
        provided.registerProvider("echo", "Bench::Echo", servant);
        required.registerConsumer("echo", "Bench::Echo", echo);
        addPort(provided);
        addPort(required);
        out_seq.data.length(3);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        record.record_tick(std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec);
        return RTC::RTC_OK;
    }

    RTC::TimedLong out_long{}, in_long{};
    RTC::TimedDoubleSeq out_seq{}, in_seq{};
    RTC::OutPort<RTC::TimedLong> long_out{"long_out", out_long};
    RTC::InPort<RTC::TimedLong> long_in{"long_in", in_long};
    RTC::OutPort<RTC::TimedDoubleSeq> seq_out{"seq_out", out_seq};
    RTC::InPort<RTC::TimedDoubleSeq> seq_in{"seq_in", in_seq};
    RTC::CorbaPort provided{"provided"}, required{"required"};
    Echo servant;
    RTC::CorbaConsumer<Bench::Echo> echo;
    TickRecord record;
};

/// The manager of this process with two components, From and To. Their ports are connected over `interface`
/// ("direct", "corba_cdr") and To is activated, unless `interface` is empty.
class Components {
  public:
    explicit Components(const std::string& interface, std::chrono::nanoseconds tick_spin = {})
        : manager_(start(tick_spin)) {
        coil::Properties profile;
        for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Parts");
        manager_.registerFactory(profile, RTC::Create<Parts>, RTC::Delete<Parts>);
        for (const char* name : {"From", "To"})
            manager_.createOrThrow(fmt::format("Parts?instance_name={}", name));
        if (interface.empty()) return; // the caller activates what it needs
        for (const char* port : {"long", "seq"})
            manager_.connectOrThrow(
                fmt::format("From.{0}_out?port=To.{0}_in&interface_type={1}", port, interface));
        manager_.connectOrThrow("From.required?port=To.provided");
        manager_.activateComponentOrThrow("To");
    }
    ~Components() { manager_.shutdown(); }

    /// Returns the component with that instance name.
    Parts& part(const char* name) { return dynamic_cast<Parts&>(*manager_.getComponent(name)); }
    RTC::Manager& manager() { return manager_; }

  private:
    static RTC::Manager& start(std::chrono::nanoseconds tick_spin) {
        // No configuration file and no name server, so that nothing outside this process takes part.
        coil::Argv argv(
            {"bench", "-i", "-f", "/none", "-o", "naming.enable:NO", "-o", "logger.log_level:ERROR"});
        RTC::Manager::Options options;
        options.tick_spin = tick_spin;
        return RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), options);
    }
    RTC::Manager& manager_;
};

/// Measures from the call of write() until the value is in the other component's buffer.
void write_long(Session& session) {
    Components components(session.bench_case().detail);
    Parts& from = components.part("From");
    Parts& to = components.part("To");
    time_each_call(session, [&](double) {
        ++from.out_long.data;
        from.long_out.write();
    });
    while (to.long_in.isNew()) to.long_in.read();
    if (to.in_long.data != from.out_long.data)
        throw std::runtime_error("the InPort has another value than the last one written");
}

/// Measures write() of a sequence, which must not allocate memory for each value.
void write_seq(Session& session) {
    Components components(session.bench_case().detail);
    Parts& from = components.part("From");
    Parts& to = components.part("To");
    time_each_call(session, [&](double) {
        from.out_seq.data[0] += 1;
        from.seq_out.write();
    });
    while (to.seq_in.isNew()) to.seq_in.read();
    if (to.in_seq.data[0] != from.out_seq.data[0])
        throw std::runtime_error("the InPort has another value than the last one written");
}

/// Measures a CORBA call within one process: omniORB calls the servant without a message.
void call(Session& session) {
    Components components("direct");
    Parts& from = components.part("From");
    double value = 0;
    time_each_call(session, [&](double) {
        value += 1;
        if (from.echo->twice(value) != 2 * value) throw std::runtime_error("wrong result of a call");
    });
}

/// Counts 100,000 writes and reads of both types. The first 1000 do not count, because buffers grow
/// meanwhile.
void count_allocations(Session& session) {
    Components components(session.bench_case().detail);
    Parts& from = components.part("From");
    Parts& to = components.part("To");
    const auto times = [&](int n) {
        for (int i = 0; i < n; ++i) {
            if (!from.long_out.write() || !from.seq_out.write() || !to.long_in.read() || !to.seq_in.read())
                throw std::runtime_error("a value was lost");
        }
    };
    times(1000);
    const std::uint64_t before = allocation_count();
    times(100'000);
    session.add_result(static_cast<double>(allocation_count() - before));
}

/// Lets From tick for `ticks` periods and deactivates it.
void tick_for(Components& components, int periods) {
    components.part("From").record.prepare(tick_period_ns, static_cast<std::size_t>(periods),
                                           rt::grid_origin.count());
    components.manager().activateComponentOrThrow("From");
    std::this_thread::sleep_for(std::chrono::nanoseconds(tick_period_ns) * periods);
    components.part("From").deactivate(0);
    if (components.part("From").record.ticks() == 0) throw std::runtime_error("the component has not ticked");
}

/// Measures how long after its planned time onExecute() is called. With tick-spin (Wake::spin), the context
/// polls the last 200 us before each tick.
void measure_lateness(Session& session) {
    const bool spin = session.bench_case().wake == Wake::spin;
    Components components("", std::chrono::microseconds(spin ? 200 : 0));
    tick_for(components, lateness_ticks(session.budget()));
    const TickRecord& record = components.part("From").record;
    for (const std::int64_t late : record.lateness_ns()) session.add_result(static_cast<double>(late));
    session.set_tick_counts(record.counts());
}

/// Measures the difference between the mean period and 1 ms.
void drift(Session& session) {
    Components components("");
    tick_for(components, drift_ticks(session.budget()));
    Parts& parts = components.part("From");
    const auto ticks =
        dynamic_cast<RTC_exp::PeriodicExecutionContext&>(*parts.getOwnContexts().at(0)).tickStatistics();
    // The context's own counts, so that each period can be accounted for.
    fmt::print(stderr, "rtm: {} cycles, {} overruns, {} periods skipped\n", ticks.cycles, ticks.overruns,
               ticks.skipped);
    session.add_result(std::abs(parts.record.mean_drift_ns()));
    session.set_tick_counts(parts.record.counts());
}

} // namespace

void add_rtm_cases(Registry& registry) {
    InProcessCases cases(registry, Group::tandem, "rtm");
    constexpr std::size_t long_bytes = 12, seq_bytes = 36; // as CDR, with the time stamp
    for (const char* interface : {"direct", "corba_cdr"}) {
        cases.add("write", long_bytes, Wake::none, write_long, interface);
        cases.add("write", seq_bytes, Wake::none, write_seq, interface);
    }
    cases.add("local-call", sizeof(double), Wake::none, call);
    for (const char* interface : {"direct", "corba_cdr"})
        cases.add("write-allocations", long_bytes + seq_bytes, Wake::none, count_allocations, interface,
                  Unit::count);
    cases.add("tick", sizeof(double), Wake::blocking, measure_lateness);
    cases.add("tick", sizeof(double), Wake::spin, measure_lateness);
    cases.add_tick_drift(drift);
}

} // namespace tandem::bench
