// SPDX-License-Identifier: Apache-2.0
// What RT-Components of one process cost each other: writes, service calls, allocations, and a 1 ms period,
// as the manager connects and runs them. Counterparts: opros/... of the other model, cyclictest,
// floor/hand-loop.
#include "apps/bench/harness/allocation_count.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/harness/tick_record.hpp"
#include "apps/bench/harness/time_each.hpp"

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

constexpr std::int64_t period_ns = 1'000'000;

class Echo : public POA_Bench::Echo, public PortableServer::RefCountServantBase {
  public:
    CORBA::Double twice(CORBA::Double value) override { return 2 * value; }
};

/// All kinds of ports, and a record of its ticks.
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
        record.tick(std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec);
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

/// Two of them in this process's manager, From and To, connected by `interface`.
class Components {
  public:
    explicit Components(const std::string& interface, std::chrono::nanoseconds spin = {})
        : manager_(start(spin)) {
        coil::Properties profile;
        for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Parts");
        manager_.registerFactory(profile, RTC::Create<Parts>, RTC::Delete<Parts>);
        for (const char* name : {"From", "To"})
            manager_.createOrThrow(fmt::format("Parts?instance_name={}", name));
        if (interface.empty()) return;
        for (const char* port : {"long", "seq"})
            manager_.connectOrThrow(
                fmt::format("From.{0}_out?port=To.{0}_in&interface_type={1}", port, interface));
        manager_.connectOrThrow("From.required?port=To.provided");
        manager_.activateComponentOrThrow("To");
    }
    ~Components() { manager_.shutdown(); }

    Parts& part(const char* name) { return dynamic_cast<Parts&>(*manager_.getComponent(name)); }
    RTC::Manager& manager() { return manager_; }

  private:
    static RTC::Manager& start(std::chrono::nanoseconds spin) {
        coil::Argv argv(
            {"bench", "-i", "-f", "/none", "-o", "naming.enable:NO", "-o", "logger.log_level:ERROR"});
        RTC::Manager::Options options;
        options.tick_spin = spin;
        return RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), options);
    }
    RTC::Manager& manager_;
};

void write_long(Session& session) {
    Components components(session.bench_case().detail);
    Parts& from = components.part("From");
    Parts& to = components.part("To");
    time_each_call(session, [&](double) {
        ++from.out_long.data;
        from.long_out.write();
    });
    while (to.long_in.isNew()) to.long_in.read();
    if (to.in_long.data != from.out_long.data) throw std::runtime_error("the last value has not come");
}

void write_seq(Session& session) {
    Components components(session.bench_case().detail);
    Parts& from = components.part("From");
    Parts& to = components.part("To");
    time_each_call(session, [&](double) {
        from.out_seq.data[0] += 1;
        from.seq_out.write();
    });
    while (to.seq_in.isNew()) to.seq_in.read();
    if (to.in_seq.data[0] != from.out_seq.data[0]) throw std::runtime_error("the last value has not come");
}

void call(Session& session) {
    Components components("direct");
    Parts& from = components.part("From");
    double value = 0;
    time_each_call(session, [&](double) {
        value += 1;
        if (from.echo->twice(value) != 2 * value) throw std::runtime_error("wrong result of a call");
    });
}

/// Of 100,000 writes that are read, after 1000 of them.
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

/// Runs From for so many periods, and stops.
void tick_for(Components& components, std::uint64_t periods) {
    components.part("From").record.prepare(period_ns, periods, rt::grid_origin.count());
    components.manager().activateComponentOrThrow("From");
    std::this_thread::sleep_for(std::chrono::nanoseconds(period_ns) * periods);
    components.part("From").deactivate(0);
    if (components.part("From").record.ticks() == 0) throw std::runtime_error("the component has not ticked");
}

/// How much later than its time onExecute is called.
void lateness(Session& session) {
    const bool spin = session.bench_case().wake == Wake::spin;
    Components components("", std::chrono::microseconds(spin ? 200 : 0));
    tick_for(components, std::min<std::uint64_t>(session.budget().samples,
                                                 session.budget().samples >= 50'000 ? 10'000 : 1'000));
    const TickRecord& record = components.part("From").record;
    for (const std::int64_t late : record.lateness_ns()) session.add_result(static_cast<double>(late));
    session.set_tick_counts(record.counts());
}

/// By how much the mean period differs from 1 ms; each tick is accounted for.
void drift(Session& session) {
    Components components("");
    tick_for(components, session.budget().samples >= 50'000 ? 100'100 : 1'000);
    Parts& parts = components.part("From");
    const auto ticks =
        dynamic_cast<RTC_exp::PeriodicExecutionContext&>(*parts.getOwnContexts().at(0)).tickStatistics();
    fmt::print(stderr, "rtm: {} cycles, {} overruns, {} periods skipped\n", ticks.cycles, ticks.overruns,
               ticks.skipped);
    session.add_result(std::abs(parts.record.mean_drift_ns()));
    session.set_tick_counts(parts.record.counts());
}

} // namespace

void add_tandem_rtm_cases(Registry& registry) {
    Case entry;
    entry.subject = "rtm";
    entry.placement = Placement::alone;
    const auto add = [&](const char* operation, std::size_t bytes, const char* detail,
                         void (*run)(Session&)) {
        entry.operation = operation;
        entry.bytes = bytes;
        entry.detail = detail;
        entry.run = run;
        registry.cases.push_back(entry);
    };
    entry.wake = Wake::none;
    for (const char* interface : {"direct", "corba_cdr"}) {
        add("write", 12, interface, write_long);
        add("write", 36, interface, write_seq);
    }
    add("local-call", sizeof(double), "", call);
    entry.unit = Unit::count;
    for (const char* interface : {"direct", "corba_cdr"})
        add("write-allocations", 48, interface, count_allocations);
    entry.unit = Unit::ns;
    entry.wake = Wake::blocking;
    add("tick", sizeof(double), "", lateness);
    entry.wake = Wake::spin;
    add("tick", sizeof(double), "", lateness);
    entry.wake = Wake::blocking;
    entry.extra_seconds = 110;
    add("tick-drift", sizeof(double), "", drift);
}

} // namespace tandem::bench
