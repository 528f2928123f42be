// SPDX-License-Identifier: Apache-2.0
// Ports that components add and remove while the application runs.
#include "host/process/published/refused_connections.hpp"
#include "tests/host/opros/engine/running.hpp"

#include <InputDataPort.h>
#include <OutputDataPort.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <thread>

using tandem::engine::Application;

namespace {

std::filesystem::path two_components(const Folder& folder, const std::string& connections) {
    folder.component("M", "maker", "<type>passive</type>", "<property name=\"calls\">yes</property>");
    folder.component("P", "printer");
    return folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"), connections);
}

Component& component(Application& application, const std::string& name) {
    return application.find_component(name)->component();
}

std::size_t drain(InputDataPort<std::vector<double>>& port) {
    std::size_t count = 0;
    while (const std::unique_ptr<opros_any> value{port.pop()}) ++count;
    return count;
}

/// The reasons of the refused connections of this process, as another process can read them.
std::vector<std::string> refused_connections() {
    using tandem::process::RefusedConnections;
    std::vector<std::string> reasons;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code closed;
        const auto target = std::filesystem::read_symlink(entry.path(), closed).string();
        if (target.find(RefusedConnections::file_name) == std::string::npos) continue;
        const int file = open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
        RefusedConnections copy{};
        REQUIRE(pread(file, &copy, sizeof copy, 0) == static_cast<ssize_t>(sizeof copy));
        close(file);
        for (const auto& place : copy.place)
            if (place.taken != 0)
                reasons.push_back(std::string(place.from) + " " + place.to + " " + place.reason);
    }
    return reasons;
}

} // namespace

TEST_CASE("the connections of a port that is added late are made then, and end when it is removed") {
    const Folder folder;
    OutputDataPort<std::vector<double>> late;
    Application application(two_components(folder, Folder::connect("service", "M", "math", "P", "math") +
                                                       Folder::connect("data", "M", "late", "P", "numbers")),
                            test_options(folder));
    application.start();
    auto& maker = component(application, "M");
    const auto arrives = [&](double value) {
        late.push({value});
        application.step("P");
        return recorder(application, "P").last_number == value;
    };
    CHECK_FALSE(arrives(1));
    maker.addPort("late", &late);
    CHECK(arrives(2));
    CHECK(maker.removePort("late") == &late);
    CHECK(maker.getPort("late") == nullptr);
    CHECK_FALSE(arrives(3));
    REQUIRE(refused_connections().size() == 1);
    CHECK_THAT(refused_connections()[0], Catch::StartsWith("M.late P.numbers a port was removed"));
    maker.addPort("late", &late);
    CHECK(arrives(4));
    CHECK(refused_connections().empty());
    application.stop();
    application.shut_down();
    late.push({5}); // nothing is connected any more
}

TEST_CASE("a connection waits for both of its ports, and one that does not fit is refused when it is there") {
    const Folder folder;
    OutputDataPort<std::vector<double>> out;
    OutputDataPort<int> wrong;
    InputDataPort<std::vector<double>> in;
    Application application(two_components(folder, Folder::connect("data", "M", "out", "P", "in") +
                                                       Folder::connect("data", "M", "wrong", "P", "numbers")),
                            test_options(folder));
    application.start();
    component(application, "M").addPort("out", &out);
    out.push({1});
    component(application, "P").addPort("in", &in);
    out.push({2});
    CHECK(drain(in) == 1);
    component(application, "M").addPort("wrong", &wrong);
    wrong.push(3);
    application.step("P");
    CHECK(recorder(application, "P").last_number != 3);
}

TEST_CASE("a connection that was refused is made when one of its ports comes back with a type that fits") {
    const Folder folder;
    OutputDataPort<std::vector<double>> right;
    OutputDataPort<int> wrong;
    Application application(two_components(folder, Folder::connect("data", "M", "late", "P", "numbers")),
                            test_options(folder));
    application.start();
    auto& maker = component(application, "M");
    for (double value : {1.0, 2.0}) {
        maker.addPort("late", &wrong);
        wrong.push(3);
        REQUIRE(refused_connections().size() == 1);
        CHECK_THAT(refused_connections()[0],
                   Catch::StartsWith("M.late P.numbers ") && Catch::Contains("type mismatch"));
        maker.addPort("late", &right); // in the place of the other one
        CHECK(refused_connections().empty());
        right.push({value});
        application.step("P");
        CHECK(recorder(application, "P").last_number == value);
    }
}

TEST_CASE("a service that is removed and added again is called again, and in between the call fails") {
    const Folder folder;
    Application application(two_components(folder, Folder::connect("service", "M", "math", "P", "math")),
                            test_options(folder));
    application.start();
    auto& printer = component(application, "P");
    application.step("M");
    CHECK(recorder(application, "M").last_number == 1.5);
    Port* const math = printer.removePort("math");
    REQUIRE(math != nullptr);
    application.step("M"); // the call fails, which costs the cycle and nothing else
    CHECK(recorder(application, "M").last_number == 1.5);
    printer.addPort("math", math);
    application.step("M");
    CHECK(recorder(application, "M").last_number == 3.5);
}

TEST_CASE("values through other connections are complete while ports come and go") {
    const Folder folder;
    OutputDataPort<std::vector<double>> steady, late;
    InputDataPort<std::vector<double>> in(OPROS_FIFO, 200'000);
    Application application(two_components(folder, Folder::connect("data", "M", "steady", "P", "in") +
                                                       Folder::connect("data", "M", "late", "P", "in") +
                                                       Folder::connect("data", "M", "steady", "P", "other")),
                            test_options(folder));
    application.start();
    component(application, "M").addPort("steady", &steady);
    component(application, "P").addPort("in", &in);
    std::atomic<bool> ends{false};
    std::size_t sent = 0;
    std::thread sender([&] {
        for (; !ends && sent < 150'000; ++sent) steady.push({1});
    });
    InputDataPort<std::vector<double>> other(OPROS_LAST, 1);
    for (int i = 0; i < 200; ++i) {
        component(application, "M").addPort("late", &late);
        component(application, "P").addPort("other", &other);
        component(application, "M").removePort("late");
        component(application, "P").removePort("other");
    }
    ends = true;
    sender.join();
    CHECK(drain(in) == sent);
}
