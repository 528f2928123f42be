// SPDX-License-Identifier: Apache-2.0
// A service call between RT-Components of two processes of a machine, `double twice(double)`. The managers are those of rtm_host.
// To be compared with peer/omniorb/call, which is a call of CORBA alone.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/measurements/time_each_call.hpp"

#include "BenchEchoSkel.h"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>

#include <cstdio>
#include <stdexcept>
#include <thread>

namespace tandem::bench {

namespace {

constexpr std::size_t text_bytes = 4096; // of the provider's port, as an IOR

class Echo : public POA_Bench::Echo {
  public:
    CORBA::Double twice(CORBA::Double value) override { return 2 * value; }
};

class Party : public RTC::DataFlowComponentBase {
  public:
    explicit Party(RTC::Manager* manager) : DataFlowComponentBase(manager) {}
    RTC::ReturnCode_t onInitialize() override {
        provided.registerProvider("echo", "Bench::Echo", servant_);
        required.registerConsumer("echo", "Bench::Echo", echo);
        addPort(provided);
        addPort(required);
        return RTC::RTC_OK;
    }
    RTC::CorbaPort provided{"provided"}, required{"required"};
    RTC::CorbaConsumer<Bench::Echo> echo;

  private:
    Echo servant_;
};

/// The manager of this process with an active component.
class Host {
  public:
    Host() : manager_(start()) {
        coil::Properties profile;
        for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Party");
        manager_.registerFactory(profile, RTC::Create<Party>, RTC::Delete<Party>);
        manager_.createOrThrow("Party?instance_name=Party");
        manager_.activateComponentOrThrow("Party");
    }
    ~Host() { manager_.shutdown(); }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    Party& party() { return dynamic_cast<Party&>(*manager_.getComponent("Party")); }
    CORBA::ORB_ptr orb() { return manager_.theORB(); }

  private:
    static RTC::Manager& start() {
        coil::Argv argv(
            {"bench", "-i", "-f", "/none", "-o", "naming.enable:NO", "-o", "logger.log_level:ERROR"});
        return RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), RTC::Manager::Options());
    }
    RTC::Manager& manager_;
};

void connect(Host& host, const char* provider) {
    const CORBA::Object_var object = host.orb()->string_to_object(provider);
    RTC::ConnectorProfile profile;
    profile.name = "calls";
    profile.ports.length(2);
    profile.ports[0] = RTC::PortService::_duplicate(host.party().required.getPortRef());
    profile.ports[1] = RTC::PortService::_narrow(object.in());
    if (host.party().required.connect(profile) != RTC::RTC_OK)
        throw std::runtime_error("the service ports of the two processes are not connected");
}

/// A calls. `between(value)` is not timed.
template <class Between>
void measure_calls_between_hosts(Session& session, Between&& between) {
    Host host;
    char* const shared = reinterpret_cast<char*>(session.memory().data());
    if (!session.is_side_a()) {
        const CORBA::String_var text = host.orb()->object_to_string(host.party().provided.getPortRef());
        std::snprintf(shared, text_bytes, "%s", text.in());
    }
    session.arrive_and_wait();
    if (session.is_side_a()) {
        connect(host, shared);
        Bench::Echo_ptr echo = host.party().echo._ptr();
        time_each_call(
            session,
            [&](double value) {
                if (echo->twice(value) != 2 * value) throw std::runtime_error("wrong result of a call");
            },
            between);
    }
    session.arrive_and_wait();
}

void measure_calls(Session& session) {
    measure_calls_between_hosts(session, [](double) {});
}

/// Calls 500 times a second, like a control loop, so that both processes have slept before each call.
void measure_paced_calls(Session& session) {
    measure_calls_between_hosts(session,
                                [](double) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); });
}

} // namespace

void add_rtm_call_cases(Registry& registry) {
    Case call{.subject = "rtm-hosts", .operation = "call", .bytes = sizeof(double), .wake = Wake::blocking};
    call.run = measure_calls;
    registry.add(call);
    call.operation = "paced-call";
    call.run = measure_paced_calls;
    registry.add(call);
}

} // namespace tandem::bench
