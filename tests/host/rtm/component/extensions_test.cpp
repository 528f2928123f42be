// SPDX-License-Identifier: Apache-2.0
// The extensions that modules add to a manager: context types, log streams, tasks, names, numbering policies.
#include "tests/host/rtm/manager_fixture.hpp"
#include <chrono>
#include <rtm/ExtTrigExecutionContext.h>
#include <rtm/LogstreamBase.h>
#include <rtm/NamingManager.h>
#include <thread>

using namespace testing;

namespace {

std::string received; // by all log streams of this test
bool init_succeeds = true;

struct Lines : RTC::LogstreamBase, coil::LogStreamBuffer {
    bool init(const coil::Properties& prop) override {
        prefix = prop.getProperty("prefix");
        return init_succeeds;
    }
    RTC::StreambufType* getStreamBuffer() override { return this; }
    void write(int level, const std::string& name, const std::string& date, const std::string& mes) override {
        if (!date.empty())
            received += prefix + name + "/" + RTC::Logger::getLevelString(level) + "/" + mes + ";";
    }
    std::string prefix;
};

void register_lines() {
    RTC::LogstreamFactory::instance().addFactory("lines", coil::Creator<RTC::LogstreamBase, Lines>,
                                                 coil::Destructor<RTC::LogstreamBase, Lines>);
}

struct NamedContext : RTC::ExtTrigExecutionContext {};

struct Tens : RTM::NumberingPolicyBase {
    std::string onCreate(void*) override { return std::to_string(next += 10); }
    void onDelete(void*) override {}
    int next = 0;
};

} // namespace

TEST_CASE("an execution context type of a library is created when a component asks for it") {
    RTC::ExecutionContextFactory::instance().addFactory(
        "NamedContext", coil::Creator<RTC::ExecutionContextBase, NamedContext>,
        coil::Destructor<RTC::ExecutionContextBase, NamedContext>);
    ManagerFixture fixture(false);
    auto& counter = fixture.create<Counter>("Counter?execution_contexts=NamedContext(mine)");
    REQUIRE(counter.getOwnContexts().size() == 1);
    CHECK(dynamic_cast<NamedContext*>(counter.getOwnContexts()[0]) != nullptr);
}

TEST_CASE("a log stream of a library gets every line from activation to shutdown") {
    register_lines();
    {
        ManagerFixture fixture(true, {"logger.logstream.lines.prefix:>"});
        RTC::Logger("before").write(RTC::Logger::RTL_WARN, "a");
        fixture.manager().activateOrThrow();
        RTC::Logger("during").write(RTC::Logger::RTL_WARN, "b");
    }
    RTC::Logger("after").write(RTC::Logger::RTL_WARN, "c");
    CHECK(received == ">during/RTL_WARN/b;");
}

TEST_CASE("a log stream that is not configured is not created") {
    register_lines();
    ManagerFixture fixture;
    fixture.manager().activateOrThrow();
    RTC::Logger("during").write(RTC::Logger::RTL_WARN, "b");
    CHECK(received.empty());
}

TEST_CASE("a log stream whose init fails is an error that names its key") {
    register_lines();
    init_succeeds = false;
    ManagerFixture fixture(true, {"logger.logstream.lines.prefix:>"});
    CHECK_THROWS_WITH(fixture.manager().activateOrThrow(), Catch::Contains("logger.logstream.lines"));
}

TEST_CASE("a removed stream gets no more lines, and a stream that logs does not get its own lines") {
    struct Echo : Lines {
        void write(int level, const std::string& name, const std::string& date,
                   const std::string& mes) override {
            Lines::write(level, name, date, mes);
            RTC::Logger("echo").write(level, mes);
        }
    };
    Echo echo;
    auto& streams = RTC::Logger::processStreams();
    streams.addStream(&echo);
    RTC::Logger("x").write(RTC::Logger::RTL_ERROR, "1");
    CHECK(streams.getBuffers().size() == 1);
    CHECK(streams.removeStream(&echo));
    CHECK_FALSE(streams.removeStream(&echo));
    RTC::Logger("x").write(RTC::Logger::RTL_ERROR, "2");
    CHECK(received == "x/RTL_ERROR/1;");
}

TEST_CASE("a task runs in the manager's thread until it is removed") {
    ManagerFixture fixture(false, {"manager.shutdown_auto:NO", "manager.shutdown_on_nortcs:NO"});
    RTC::Manager& manager = fixture.manager();
    std::atomic<int> runs{0};
    RTC::Manager::TaskId id = nullptr;
    id = manager.addTask(
        [&] {
            if (++runs < 3) return;
            manager.invoke([&] { RTC::Manager::removeTask(id); });
            manager.invoke([] { RTC::Manager::terminate(); }, std::chrono::milliseconds(500));
        },
        std::chrono::milliseconds(1));
    manager.runManager();
    const int after_removal = runs;
    CHECK(after_removal >= 3);
    CHECK(after_removal <= 4); // one may have been due already
}

TEST_CASE("a factory names its instances by the numbering policy that it was given") {
    ManagerFixture fixture;
    coil::Properties profile;
    profile.setProperty("type_name", "Counter");
    RTC::FactoryCXX factory(profile, RTC::Create<Counter>, RTC::Delete<Counter>, new Tens);
    RTC::RTObject_impl* component = factory.create(&fixture.manager());
    REQUIRE(component != nullptr);
    CHECK(std::string(component->getInstanceName()) == "Counter10");
    factory.destroy(component);
}

TEST_CASE("the naming manager finds components of this process and lists what it has bound") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    RTC::NamingManager& naming = *fixture.manager().getNaming();
    const RTC::RTCList found = naming.string_to_component("Counter0");
    REQUIRE(found.length() == 1);
    CHECK(found[0]->_is_equivalent(RTC::RTObject_var(counter.getObjRef()).in()));
    CHECK(naming.string_to_component("Nobody0").length() == 0);
    CHECK(naming.getObjects().empty());
    naming.bindObject("test.cxt/Counter0.rtc", &counter);
    CHECK(naming.getObjects() == std::vector<RTC::RTObject_impl*>{&counter});
    naming.unbindAll();
    CHECK(naming.getObjects().empty());
}
