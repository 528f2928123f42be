// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/engine/running.hpp"
#include "tests/host/opros/runtime/archive_source.hpp"

#include <InputDataPortInterface.h>

using tandem::engine::Application;

namespace {

InputDataPortInterface& input(Application& application, const std::string& port) {
    return dynamic_cast<InputDataPortInterface&>(*application.find_component("S")->component().getPort(port));
}

void push(Application& application, const std::string& port, double value) {
    opros_any any(std::vector<double>(1, value));
    REQUIRE(input(application, port).push(any) == OPROS_SUCCESS);
}

std::filesystem::path sink(const Folder& folder, const std::string& rest = "") {
    folder.component("S", "sink", "<type>aperiodic</type>");
    folder.component("M", "maker", "<type>periodic</type><period>1</period>");
    return folder.application(Folder::sub("S", "S.xml") + rest);
}

/// One value at a time, as a source outside gives them.
class Source : public ArchiveSource {
  public:
    opros::archive::iarchive* next() override {
        if (left == 0) return nullptr;
        bytes_ = std::stringstream();
        opros::archive::binary_oarchive out(&bytes_);
        out << std::vector<double>(1, 7);
        archive_ = std::make_unique<opros::archive::binary_iarchive>(&bytes_);
        return archive_.get();
    }
    void done() override { --left; }
    std::atomic<int> left{0};

  private:
    std::stringstream bytes_;
    std::unique_ptr<opros::archive::binary_iarchive> archive_;
};

} // namespace

TEST_CASE("an aperiodic component is executed once at the start and then when data arrive") {
    const Folder folder;
    Application application(sink(folder), test_options(folder, false));
    application.start();
    Recorder& s = recorder(application, "S");
    REQUIRE(eventually([&] { return s.executions == 1; }));
    push(application, "numbers", 5);
    REQUIRE(eventually([&] { return s.last_number == 5; }));
    CHECK(s.executions == 2);
    application.stop();
    CHECK_THAT(application.executor_stats().at(0), Catch::Contains("S: on arrival, 2 cycles"));
}

TEST_CASE("an aperiodic component that takes one value per cycle gets all values") {
    const Folder folder;
    Application application(sink(folder), test_options(folder, false));
    for (int i = 1; i <= 10; ++i) push(application, "numbers", i);
    application.start();
    Recorder& s = recorder(application, "S");
    CHECK(eventually([&] { return s.updates >= 10; }));
    CHECK(s.last_number == 10);
}

TEST_CASE("an aperiodic component that does not take its values is executed again only when more arrive") {
    const Folder folder;
    Application application(sink(folder), test_options(folder, false));
    application.start();
    Recorder& s = recorder(application, "S");
    REQUIRE(eventually([&] { return s.executions == 1; }));
    push(application, "chosen", 1);
    REQUIRE(eventually([&] { return s.executions == 2; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(s.executions == 2);
    push(application, "chosen", 1);
    CHECK(eventually([&] { return s.executions == 3; }));
}

TEST_CASE("an aperiodic component is executed after each event") {
    const Folder folder;
    const auto file = sink(folder, Folder::sub("M", "M.xml"));
    folder.application(Folder::sub("S", "S.xml") + Folder::sub("M", "M.xml"),
                       Folder::connect("event", "M", "news", "S", "news"));
    Application application(file, test_options(folder, false));
    application.start();
    Recorder& s = recorder(application, "S");
    CHECK(eventually([&] { return s.events > 3 && s.executions > 3; }));
}

TEST_CASE("an aperiodic component is executed when a value waits in a source") {
    const Folder folder;
    Source source;
    Application application(sink(folder), test_options(folder, false));
    REQUIRE(input(application, "numbers").addSource(&source) == OPROS_SUCCESS);
    application.start();
    Recorder& s = recorder(application, "S");
    REQUIRE(eventually([&] { return s.executions == 1; }));
    source.left = 1;
    CHECK(eventually([&] { return s.last_number == 7; }));
    application.stop();
    input(application, "numbers").removeSource(&source);
}

TEST_CASE("an aperiodic component whose source signals its values sleeps until one comes") {
    class Signalling : public Source {
      public:
        opros::archive::iarchive* next() override {
            ++polls;
            return Source::next();
        }
        bool setListener(DataPortListener* to) override {
            listener = to;
            return true;
        }
        std::atomic<DataPortListener*> listener{nullptr};
        std::atomic<int> polls{0};
    } source;
    const Folder folder;
    Application application(sink(folder), test_options(folder, false));
    REQUIRE(input(application, "numbers").addSource(&source) == OPROS_SUCCESS);
    application.start();
    Recorder& s = recorder(application, "S");
    REQUIRE(eventually([&] { return s.executions == 1; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); // the first cycle has ended
    const int polls = source.polls;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    CHECK(source.polls - polls <= 5); // 200, were it polled
    source.left = 1;
    source.listener.load()->arrived();
    CHECK(eventually([&] { return s.last_number == 7; }));
    application.stop();
    input(application, "numbers").removeSource(&source);
}

TEST_CASE("an aperiodic component that depends on another one is executed after it") {
    const Folder folder;
    const auto file = sink(folder);
    folder.application(Folder::sub("S", "S.xml") + Folder::sub("M", "M.xml"), "",
                       "<coordination><depends source=\"S\" target=\"M\"/></coordination>");
    Application application(file, test_options(folder, false));
    application.start();
    CHECK(eventually([&] { return recorder(application, "S").executions > 3; }));
    application.stop();
    CHECK(recorder(application, "S").executions <= recorder(application, "M").executions);
}

TEST_CASE("the profile's queue is used for a port whose code has chosen none") {
    const std::string kind = GENERATE("<queueing_policy>last</queueing_policy>",
                                      "<queuing_policy>LAST</queuing_policy><queue_size>1</queue_size>",
                                      "<policy>FIFO</policy><policy_param name=\"size\">1</policy_param>",
                                      "<queue_size>1</queue_size>");
    const Folder folder;
    const std::string queue = "<usage>input</usage>" + kind + "</data_port>";
    folder.write("S.xml", "<component_profile><name>S</name><execution_environment><library_name>sink"
                          "</library_name></execution_environment><execution_semantics><type>passive</type>"
                          "</execution_semantics><ports><data_port><name>numbers</name>" +
                              queue + "<data_port><name>chosen</name>" + queue +
                              "<data_port><name>nowhere</name>" + queue + "</ports></component_profile>");
    Application application(folder.application(Folder::sub("S", "S.xml")), test_options(folder));
    for (int i = 0; i < 5; ++i) {
        push(application, "numbers", i);
        push(application, "chosen", i);
    }
    CHECK(input(application, "numbers").getSize() == 1);
    CHECK(input(application, "chosen").getSize() == 3);
}
