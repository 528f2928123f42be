// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/engine/running.hpp"

using tandem::engine::Application;

namespace {
std::filesystem::path maker_with(const Folder& folder, const std::string& semantics,
                                 const std::string& rest = "", const std::string& properties = "") {
    folder.component("A", "maker", semantics, properties);
    folder.component("B", "maker", semantics);
    return folder.application(Folder::sub("A", "A.xml") + Folder::sub("B", "B.xml"), "", rest);
}
} // namespace

TEST_CASE("executors run cycles until the application is stopped, and none afterwards") {
    const std::string semantics =
        GENERATE("<type>periodic</type><period>1</period>", "<type>periodic-shared</type><period>1</period>",
                 "<type>periodic-exclusive</type><period>1</period><phase>0.5</phase><priority>5</priority>",
                 "<type>aperiodic-loop</type>");
    const Folder folder;
    Application application(maker_with(folder, semantics), test_options(folder, false));
    application.start();
    Recorder& a = recorder(application, "A");
    Recorder& b = recorder(application, "B");
    CHECK(eventually([&] { return a.executions > 3 && b.executions > 3; }));
    application.stop();
    const int executions = a.executions;
    CHECK(a.updates == executions);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(a.executions == executions);
    CHECK(a.calls.back() == "stop");
}

TEST_CASE("executors of equal periods beyond the first 16 run, count and stop in few threads") {
    const Folder folder;
    folder.component("A", "maker", "<type>periodic</type><period>2</period>");
    std::string subcomponents;
    for (int i = 0; i < 40; ++i) subcomponents += Folder::sub("A" + std::to_string(i), "A.xml");
    const auto threads = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
    };
    Application application(folder.application(subcomponents), test_options(folder, false));
    const auto before = threads();
    application.start();
    const auto each = [&](int i) -> Recorder& { return recorder(application, "A" + std::to_string(i)); };
    for (int i = 0; i < 40; ++i) CHECK(eventually([&] { return each(i).executions > 10; }));
    CHECK(threads() - before < 40);
    application.stop();
    REQUIRE(application.executor_stats().size() == 40);
    for (const std::string& line : application.executor_stats())
        CHECK_THAT(line, Catch::Contains(": every 2 ms, ") && !Catch::Contains(" 0 ticks"));
    for (int i = 0; i < 40; ++i) {
        const int executions = each(i).executions;
        CHECK(each(i).updates == executions);
        CHECK(each(i).calls.back() == "stop");
    }
}

TEST_CASE("executors count their ticks, overruns and skipped periods") {
    const Folder folder;
    Application application(maker_with(folder, "<type>periodic-shared</type><period>1</period>"),
                            test_options(folder, false));
    application.start();
    CHECK(eventually([&] { return recorder(application, "A").executions > 3; }));
    application.stop();
    REQUIRE(application.executor_stats().size() == 1);
    CHECK_THAT(application.executor_stats()[0], Catch::StartsWith("executor of B, A: every 1 ms, ") &&
                                                    Catch::Contains("overruns") &&
                                                    Catch::Contains("skipped"));
}

TEST_CASE("a passive component is started and stopped but never executed") {
    const Folder folder;
    Application application(maker_with(folder, "<type>passive</type>"), test_options(folder, false));
    application.start();
    CHECK(state(application, "A") == OPROS_CS_ACTIVE);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    application.stop();
    CHECK(recorder(application, "A").executions == 0);
}

TEST_CASE("a component in ERROR does not stop the other component of its executor") {
    const std::string trouble = GENERATE("execute throws", "stops itself");
    const Folder folder;
    Application application(maker_with(folder, "<type>periodic-shared</type><period>1</period>", "",
                                       "<property name=\"trouble\">" + trouble + "</property>"),
                            test_options(folder, false));
    application.start();
    CHECK(eventually([&] { return state(application, "A") == OPROS_CS_ERROR; }));
    const int then = recorder(application, "B").executions;
    CHECK(eventually([&] { return recorder(application, "B").executions > then + 2; }));
}

TEST_CASE("a component that depends on another one gets a cycle for each cycle of the other") {
    const Folder folder;
    Application application(maker_with(folder, "<type>periodic-shared</type><period>1</period>",
                                       "<coordination><depends source=\"A\" target=\"B\"/></coordination>"),
                            test_options(folder, false));
    application.start();
    Recorder& a = recorder(application, "A");
    Recorder& b = recorder(application, "B");
    CHECK(eventually([&] { return a.executions > 3; }));
    application.stop();
    CHECK(a.executions <= b.executions);
}

TEST_CASE("events are delivered by the receiver's task queue") {
    const Folder folder;
    folder.component("M", "maker", "<type>periodic</type><period>1</period>");
    folder.component("P", "printer");
    Application application(folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"),
                                               Folder::connect("event", "M", "news", "P", "news")),
                            test_options(folder, false));
    application.start();
    CHECK(eventually([&] { return recorder(application, "P").events > 2; }));
}
