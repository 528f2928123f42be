// SPDX-License-Identifier: Apache-2.0
// Manager::shutdown() in code of a component.
#include "tests/host/rtm/host_process.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <array>
#include <atomic>

namespace {

std::vector<std::string> host_with_ender(const std::string& place) {
    std::vector<std::string> arguments{"-f", "/dev/null"};
    for (const std::string setting :
         {"manager.modules.load_path:" TANDEM_TEST_PLUGINS, "manager.modules.preload:TestComponents.so",
          "manager.components.preactivation:Ender0", "manager.shutdown_auto:NO",
          "manager.shutdown_on_nortcs:NO", "exec_cxt.periodic.rate:200"}) {
        arguments.push_back("-o");
        arguments.push_back(setting);
    }
    arguments.push_back("-o");
    arguments.push_back("manager.components.precreate:Ender?in=" + place);
    return arguments;
}

std::atomic<bool> was_deactivated{false}, was_finalized{false}, was_deleted{false};

/// Ends the manager in its first cycle.
class OneCycle : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    ~OneCycle() override { was_deleted = true; }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        RTC::Manager::instance().shutdown();
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        was_deactivated = true;
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onFinalize() override {
        was_finalized = true;
        return RTC::RTC_OK;
    }
};

/// Ends the manager in a thread that its destructor joins.
class EndsInThread : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    ~EndsInThread() override {
        if (thread_.joinable()) thread_.join();
        was_deleted = true;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (!thread_.joinable()) thread_ = std::thread([] { RTC::Manager::instance().shutdown(); });
        return RTC::RTC_OK;
    }

  private:
    std::thread thread_;
};

/// Takes a while to be deactivated, and then writes to a pipe.
class SlowToStop : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        return ::write(pipe_to_test, "d", 1) == 1 ? RTC::RTC_OK : RTC::RTC_ERROR;
    }
    static inline int pipe_to_test = -1;
};

/// Without a main loop: another thread requests the end, and this one exits as soon as it notices.
[[noreturn]] void exit_on_request() {
    testing::ManagerFixture fixture(false);
    testing::register_component_type<SlowToStop>(fixture.manager(), "SlowToStop");
    auto& component = fixture.create<SlowToStop>("SlowToStop");
    fixture.manager().runManager(true);
    fixture.activate(component);
    std::thread([] { RTC::Manager::instance().shutdown(); }).detach();
    while (!RTC::Manager::terminationRequested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::exit(0);
}

} // namespace

TEST_CASE("A program without a main loop that exits when an end was requested waits for the end") {
    std::array<int, 2> ends{};
    REQUIRE(pipe(ends.data()) == 0);
    const pid_t child = fork();
    if (child == 0) {
        SlowToStop::pipe_to_test = ends[1];
        exit_on_request();
    }
    close(ends[1]);
    char deactivated = 0;
    CHECK(read(ends[0], &deactivated, 1) == 1);
    CHECK(deactivated == 'd');
    close(ends[0]);
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE(
    "A component that shuts its manager down gets all callbacks of the end, and the host ends cleanly") {
    const std::string place = GENERATE("initialize", "set-up", "activated", "execute", "finalize",
                                       "destructor", "task", "thread", "service");
    CAPTURE(place);
    testing::HostProcess host(host_with_ender(place));
    CHECK(host.wait_for_exit() == 0);
    INFO(host.output << host.errors);
    CHECK(host.errors.find("does not return") == std::string::npos);
    CHECK(host.output.find("shutdown returned\n") != std::string::npos);
    std::size_t at = 0;
    for (const char* line : {"deactivated\n", "finalized\n", "deleted\n"}) {
        at = host.output.find(line, at);
        CAPTURE(line);
        REQUIRE(at != std::string::npos);
    }
}

TEST_CASE("A component that shuts its manager down ends cleanly in a program without a main loop") {
    testing::ManagerFixture fixture(false);
    testing::register_component_type<OneCycle>(fixture.manager(), "OneCycle");
    auto& component = fixture.create<OneCycle>("OneCycle");
    fixture.manager().runManager(true);
    fixture.activate(component);
    for (int i = 0; i < 20000 && !was_deleted; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(was_deactivated);
    CHECK(was_finalized);
    CHECK(was_deleted);
    CHECK(fixture.manager().shutdown()); // waits for the end that the component has requested
}

TEST_CASE("A thread of a component may shut the manager down before the main loop begins") {
    testing::ManagerFixture fixture(false);
    testing::register_component_type<EndsInThread>(fixture.manager(), "EndsInThread");
    fixture.manager().activateManager();
    fixture.activate(fixture.create<EndsInThread>("EndsInThread"));
    for (int i = 0; i < 20000 && !was_deleted; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    fixture.manager().runManager(); // returns, since an end was requested
    CHECK(was_deleted);
    CHECK(fixture.manager().shutdown()); // was in order: the destructor has returned in time
}
