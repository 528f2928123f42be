// SPDX-License-Identifier: Apache-2.0
#include "host/crash/callback_scope.hpp"
#include "tests/host/opros/engine/running.hpp"
#include "tests/host/opros/fixtures/Watcher.h"

#include <ProvidedMethodInterface.h>
#include <ProvidedServicePort.h>
#include <RequiredServicePort.h>

using Catch::Contains;
using tandem::engine::Application;

namespace {

/// Writes an application of M, which the test makes fail, and W, a Watcher with the directory. W is listed last and
/// would be initialized first.
std::filesystem::path watched(const Folder& folder, const std::string& trouble,
                              const std::string& type = "<type>passive</type>") {
    folder.component("M", "maker.dll", type, "<property name=\"trouble\">" + trouble + "</property>");
    folder.component("W", "watcher", "<type>passive</type>");
    return folder.application(Folder::sub("M", "M.xml") + Folder::sub("W", "W.xml"));
}

ComponentDirectory& directory_of(Application& application) {
    return *dynamic_cast<Watcher&>(application.find_component("W")->component()).directory;
}

/// Records the states that it is told.
struct States final : LifecycleListener {
    void stateChanged(LifecycleState state) override { seen.push_back(state); }
    std::vector<LifecycleState> seen;
};

/// The port of a bridge, which calls methods in a thread that runs no component.
struct BridgePort final : RequiredServicePort {
    bool isDynamic() const override { return true; }
    std::string bindProvided(ProvidedServicePort* port) override {
        provided = port;
        return "";
    }
    ProvidedServicePort* provided = nullptr;
};

/// A call that notes what a crash report would name while the method runs.
struct NotingCall final : EncodedCall {
    opros::archive::iarchive* argument(int) override {
        if (const auto running = tandem::crash::running_callback())
            named = std::string(running->component) + "." + running->port + "." + running->name;
        return nullptr;
    }
    opros::archive::oarchive& result() override { throw std::logic_error("note has no result"); }
    opros::archive::oarchive* written_argument(int) override { return nullptr; }
    std::string named;
};

} // namespace

TEST_CASE("a crash report names component, port and method of a call from a bridge") {
    const Folder folder;
    folder.component("P", "printer");
    folder.component("W", "watcher", "<type>passive</type>");
    Application application(folder.application(Folder::sub("P", "P.xml") + Folder::sub("W", "W.xml")),
                            test_options(folder));
    BridgePort port;
    REQUIRE(directory_of(application).connect("W", port, "P", "math") == "");
    REQUIRE(port.provided != nullptr);
    NotingCall by_method, by_name;
    CHECK(port.provided->getMethod("note")->provided()->call(by_method) == OPROS_SUCCESS);
    CHECK(port.provided->callService("note", by_name) == OPROS_SUCCESS);
    CHECK(by_method.named == "P.math.note");
    CHECK(by_name.named == "P.math.note");
    directory_of(application).disconnect(port);
    CHECK(port.provided == nullptr);
}

TEST_CASE("a component that gets the directory is initialized after all others") {
    const Folder folder;
    Application application(watched(folder, "none"), test_options(folder));
    CHECK(recorder(application, "W").calls == std::vector<std::string>{"M is ready"});
    CHECK(directory_of(application).names() == std::vector<std::string>{"M", "W"});
    CHECK(directory_of(application).type("M") == "M");
    CHECK(directory_of(application).find("N") == nullptr);
    CHECK(directory_of(application).transition("N", TRANSITION_START) == "there is no component N");
}

TEST_CASE("a directory makes transitions while its application runs, and listeners are notified of each") {
    const Folder folder;
    Application application(watched(folder, "none"), test_options(folder));
    auto& directory = directory_of(application);
    States states;
    directory.find("M")->addLifecycleListener(&states);
    CHECK(directory.transition("M", TRANSITION_START) == "the application has not started yet");
    application.start();
    CHECK(directory.transition("M", TRANSITION_START) == ""); // it is ACTIVE already
    CHECK(directory.transition("M", TRANSITION_STOP) == "");
    CHECK(directory.transition("M", TRANSITION_STOP) == "");
    CHECK(directory.transition("M", TRANSITION_START) == "");
    CHECK(directory.transition("M", TRANSITION_RECOVER) == "component M is ACTIVE, not in ERROR");
    directory.find("M")->stopOnError();
    CHECK(directory.transition("M", TRANSITION_START) == "component M is in ERROR; reset it first");
    CHECK(directory.transition("M", TRANSITION_STOP) == "component M is in ERROR; reset it first");
    CHECK(directory.transition("M", TRANSITION_RECOVER) == "");
    CHECK(states.seen == std::vector<LifecycleState>{OPROS_CS_ACTIVE, OPROS_CS_INACTIVE, OPROS_CS_ACTIVE,
                                                     OPROS_CS_ERROR, OPROS_CS_READY});
    CHECK(directory.transition("M", TRANSITION_DESTROY) == "");
    CHECK(directory.transition("M", TRANSITION_START) == "component M is DESTROYED");
    directory.find("M")->removeLifecycleListener(&states);
    application.stop();
    CHECK(directory.transition("M", TRANSITION_START) == "the application ends");
    CHECK(states.seen.size() == 6);
}

TEST_CASE("a stop reaches a component that is not ACTIVE but would start by itself") {
    const Folder folder;
    Application application(watched(folder, "none"), test_options(folder));
    application.start();
    auto& directory = directory_of(application);
    auto& watcher = dynamic_cast<Watcher&>(*directory.find("W"));
    REQUIRE(directory.transition("W", TRANSITION_STOP) == "");
    for (const auto expected : {OPROS_CS_INACTIVE, OPROS_CS_ERROR}) {
        if (expected == OPROS_CS_ERROR) directory.find("W")->fail();
        watcher.restart_wanted = true;
        CHECK(directory.transition("W", TRANSITION_STOP) == "");
        CHECK_FALSE(watcher.restart_wanted);
        CHECK(state(application, "W") == expected);
    }
}

TEST_CASE("a component whose start by a directory fails goes to ERROR and can be recovered") {
    const Folder folder;
    Application application(watched(folder, "none"), test_options(folder));
    application.start();
    auto& directory = directory_of(application);
    CHECK(directory.transition("M", TRANSITION_STOP) == "");
    CHECK(directory.setProperty("M", "trouble", "start fails"));
    CHECK_THAT(directory.transition("M", TRANSITION_START),
               Contains("component M: onStart failed, it returned code"));
    CHECK(state(application, "M") == OPROS_CS_ERROR);
    CHECK(directory.transition("M", TRANSITION_RECOVER) == "");
    CHECK(directory.setProperty("M", "trouble", "none"));
    CHECK(directory.transition("M", TRANSITION_START) == "");
    CHECK(state(application, "M") == OPROS_CS_ACTIVE);
}

TEST_CASE("a component whose start has failed with its application is recovered and started by a directory") {
    const Folder folder;
    Application application(watched(folder, "start fails"), test_options(folder));
    application.start();
    auto& directory = directory_of(application);
    CHECK(state(application, "M") == OPROS_CS_ERROR);
    CHECK(directory.transition("M", TRANSITION_RECOVER) == "");
    CHECK(directory.setProperty("M", "trouble", "none"));
    CHECK(directory.transition("M", TRANSITION_START) == "");
    CHECK(state(application, "M") == OPROS_CS_ACTIVE);
    application.step("M");
    CHECK(recorder(application, "M").executions == 1);
}

TEST_CASE("a directory does not stop a component within its cycle, and sets properties between two") {
    const Folder folder;
    auto options = test_options(folder, false);
    options.grace = std::chrono::seconds(1);
    Application application(
        watched(folder, "execute waits for stop", "<type>periodic</type><period>5</period>"), options);
    application.start();
    auto& directory = directory_of(application);
    auto& maker = recorder(application, "M");
    REQUIRE(eventually([&] { return maker.executions == 1; }));
    CHECK_THAT(directory.transition("M", TRANSITION_STOP),
               Contains("component M has not returned from onExecute for 5 s"));
    CHECK(state(application, "M") == OPROS_CS_ACTIVE);
    CHECK(directory.setProperty("M", "a", "new"));
    CHECK(directory.find("M")->getProperty("a").empty()); // onExecute is still running
    application.stop();
    CHECK(application.stuck_components().empty());
}

TEST_CASE("a property that a directory sets reaches a running component before its next cycle") {
    const Folder folder;
    Application application(watched(folder, "none", "<type>periodic</type><period>5</period>"),
                            test_options(folder, false));
    application.start();
    CHECK(directory_of(application).setProperty("M", "trouble", "stops itself"));
    CHECK(eventually([&] { return state(application, "M") == OPROS_CS_ERROR; }));
    CHECK_FALSE(directory_of(application).setProperty("N", "a", "b"));
}
