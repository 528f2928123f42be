// SPDX-License-Identifier: Apache-2.0
// Components with every kind of port are created, connected, run and deleted many times: neither memory nor
// descriptors leak. TANDEM_STRESS=10 makes it 1000 rounds.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include "tests/support/stress.hpp"
#include <cstdlib>
#include <rtm/CORBA_RTCUtil.h>

using namespace testing;

namespace {

int life_count() { return tandem::test::stress(100); }

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
constexpr long quarantine =
    16384; // kB that the sanitizer keeps: freed memory (ASAN_OPTIONS of its preset) or shadows
#else
constexpr long quarantine = 0;
#endif

long kilobytes(const char* pid) {
    std::ifstream status("/proc/" + std::string(pid) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.compare(0, 6, "VmRSS:") == 0) return std::stol(line.substr(6));
    return -1;
}

std::size_t open_descriptors() {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

RTC::ReturnCode_t connect(RTC::RTObject_ptr a, const char* port_a, RTC::RTObject_ptr b, const char* port_b) {
    RTC::PortService_var first = CORBA_RTCUtil::get_port_by_name(a, port_a),
                         second = CORBA_RTCUtil::get_port_by_name(b, port_b);
    return CORBA_RTCUtil::connect("c", coil::Properties(), first.in(), second.in());
}

const char* const types[] = {"Counter", "Accumulator", "CalculatorProvider", "CalculatorConsumer"};

} // namespace

TEST_CASE("Components that are created, connected and deleted leak nothing") {
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:1000"});
    auto life = [&](int number) {
        const char* const flow = number % 2 == 0 ? "push" : "pull";
        const char* const type = number % 3 == 0 ? "direct" : "corba_cdr";
        auto& counter = fixture.create<Counter>("Counter");
        auto& accumulator = fixture.create<Accumulator>("Accumulator");
        auto& provider = fixture.create<CalculatorProvider>("CalculatorProvider");
        auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
        fixture.connect(std::string("Counter0.out?port=Accumulator0.in&dataflow_type=") + flow +
                        "&interface_type=" + type);
        fixture.connect("CalculatorConsumer0.calculator?port=CalculatorProvider0.calculator");
        const std::vector<RTC::RTObject_impl*> all{&counter, &accumulator, &provider, &consumer};
        for (auto* one : all) REQUIRE(ManagerFixture::activate(*one) == RTC::RTC_OK);
        REQUIRE(eventually([&] { return accumulator.received_ > 0; }));
        for (auto* one : all) REQUIRE(one->deactivate(0) == RTC::RTC_OK);
        for (auto* one : all) REQUIRE(one->exit() == RTC::RTC_OK);
        fixture.manager().cleanupComponents();
    };
    for (int i = 0; i < 30; ++i) life(i); // what is allocated once
    const std::size_t open = open_descriptors();
    const long memory = kilobytes("self");
    const int n = life_count();
    for (int i = 0; i < n; ++i) life(i);
    INFO("kB before " << memory << ", after " << kilobytes("self"));
    CHECK(eventually(
        [&] { return open_descriptors() == open; })); // a tool that looks for managers here comes and goes
    CHECK(kilobytes("self") < memory + 1000 + 2 * n + quarantine);
}

TEST_CASE("Components that a tool creates and deletes leak nothing") {
    // The host's threads come and go. With a malloc arena for each, the size would depend on how many exist at the same time.
    setenv("MALLOC_ARENA_MAX", "1", 1);
    RemoteHost other("Counter", unused_port(), {"exec_cxt.periodic.rate:1000"});
    unsetenv("MALLOC_ARENA_MAX");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto* orb = fixture.manager().theORB();
    RTM::Manager_var manager = other.manager(orb);
    auto life = [&](int number) {
        std::vector<RTC::RTObject_var> all;
        for (const char* type : types) {
            const std::string arguments = std::string(type) + "?instance_name=a" + type;
            all.emplace_back(manager->create_component(arguments.c_str()));
            REQUIRE_FALSE(CORBA::is_nil(all.back().in()));
        }
        REQUIRE(connect(all[0].in(), "out", all[1].in(), "in") == RTC::RTC_OK);
        REQUIRE(connect(all[2].in(), "calculator", all[3].in(), "calculator") == RTC::RTC_OK);
        for (auto& one : all) REQUIRE(CORBA_RTCUtil::activate(one.in()) == RTC::RTC_OK);
        for (auto& one : all) REQUIRE(CORBA_RTCUtil::deactivate(one.in()) == RTC::RTC_OK);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (number % 2 == 0)
                REQUIRE(all[i]->exit() == RTC::RTC_OK);
            else
                REQUIRE(manager->delete_component((std::string("a") + types[i]).c_str()) == RTC::RTC_OK);
        }
    };
    const std::string pid = std::to_string(other.host.pid());
    for (int i = 0; i < 30; ++i) life(i);
    const std::size_t open = other.host.descriptor_count();
    const long memory = kilobytes(pid.c_str());
    const int n = life_count();
    for (int i = 0; i < n; ++i) life(i);
    RTC::RTCList_var left = manager->get_components();
    CHECK(left->length() == 1);
    INFO("kB before " << memory << ", after " << kilobytes(pid.c_str()));
    CHECK(eventually([&] { return other.host.descriptor_count() <= open + 1; }));
    CHECK(kilobytes(pid.c_str()) < memory + 2000 + 2 * n + quarantine);
}

TEST_CASE("Components are created and deleted by many threads at once") {
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:1000"});
    std::atomic<int> done{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 8; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 25; ++i) {
                const std::string number = std::to_string(t) + "_" + std::to_string(i);
                auto* counter =
                    fixture.manager().createComponent(("Counter?instance_name=c" + number).c_str());
                auto* accumulator = fixture.manager().createComponent("Accumulator");
                if (counter == nullptr || accumulator == nullptr) return;
                RTC::RTObject_var a = counter->getObjRef(), b = accumulator->getObjRef();
                const bool succeeded = connect(a.in(), "out", b.in(), "in") == RTC::RTC_OK &&
                                       CORBA_RTCUtil::activate(a.in()) == RTC::RTC_OK &&
                                       CORBA_RTCUtil::activate(b.in()) == RTC::RTC_OK &&
                                       a->exit() == RTC::RTC_OK && b->exit() == RTC::RTC_OK;
                if (succeeded) ++done;
            }
        });
    for (auto& thread : threads) thread.join();
    CHECK(done == 8 * 25);
    fixture.manager().cleanupComponents();
    CHECK(fixture.manager().getComponents().empty());
}
