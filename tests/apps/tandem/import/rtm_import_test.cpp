// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/import_folder.hpp"
#include "tests/apps/tandem/program.hpp"
#include "tests/apps/tandem/shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

using Catch::Contains;
using tandem::test::tandem_program;

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// An installation with the module of the tests, as a folder `robot` with an rtc.conf.
struct Installation : Folder {
    explicit Installation(const std::string& conf) {
        write("robot/rtc.conf", conf);
        fs::create_directories(path() / "robot/modules");
        fs::copy_file(TEST_PLUGINS "/TestComponents.so", path() / "robot/modules/TestComponents.so");
    }
    fs::path robot() const { return path() / "robot"; }
    fs::path output() const { return path() / "moved"; }
    std::string written() const { return content(output() / "rtm/rtc.conf"); }
    tandem::test::Result import(std::vector<std::string> more = {}) const {
        std::vector<std::string> all{"rtm", "import", robot(), "-o", output()};
        all.insert(all.end(), more.begin(), more.end());
        return tandem_program(all);
    }
    /// The one line of an import that fails; nothing is left behind.
    std::string refused(const std::vector<std::string>& more = {}) const {
        const auto result = import(more);
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        CHECK(!fs::exists(output()));
        return result.errors;
    }
    tandem::test::CommandOutput run(const std::string& expected) const {
        return tandem::test::run_host(TANDEM_PROGRAM " run", output(), expected);
    }
};

const std::string pair_conf = "manager.modules.load_path: modules\n"
                              "manager.modules.preload: TestComponents.so\n"
                              "manager.components.precreate: Counter, Reporter\n";

std::string component(const std::string& name, const std::string& type, const std::string& inside = "",
                      const std::string& attributes = "") {
    return "<rts:Components rts:id=\"RTC:Vendor:test:" + type + ":1.0\" rts:instanceName=\"" + name +
           "\" rts:pathUri=\"localhost/" + name + ".rtc\" rts:activeConfigurationSet=\"default\" " +
           attributes + ">" + inside + "</rts:Components>\n";
}

std::string port(const std::string& end, const std::string& component, const std::string& name) {
    return "<rts:" + end + " rts:instanceName=\"" + component + "\" rts:portName=\"" + component + "." +
           name + "\" rts:componentId=\"RTC:Vendor:test:X:1.0\"/>";
}

std::string connection(const std::string& from, const std::string& from_port, const std::string& to,
                       const std::string& to_port, const std::string& properties = "") {
    return "<rts:DataPortConnectors rts:connectorId=\"1\" rts:name=\"c\" "
           "rts:dataType=\"IDL:RTC/TimedLong:1.0\" "
           "rts:interfaceType=\"corba_cdr\" rts:dataflowType=\"push\" rts:subscriptionType=\"flush\">" +
           port("sourceDataPort", from, from_port) + port("targetDataPort", to, to_port) + properties +
           "</rts:DataPortConnectors>\n";
}

std::string property(const std::string& name, const std::string& value) {
    return "<rtsExt:Properties rtsExt:name=\"" + name + "\" rtsExt:value=\"" + value + "\"/>";
}

std::string system_profile(const std::string& inside) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<rts:RtsProfile rts:id=\"RTSystem:V:S:1\" rts:version=\"0.2\" "
           "xmlns:rts=\"http://www.openrtp.org/namespaces/rts\" "
           "xmlns:rtsExt=\"http://www.openrtp.org/namespaces/rts_ext\">\n" +
           inside + "</rts:RtsProfile>\n";
}

} // namespace

TEST_CASE(
    "tandem rtm import converts an rtc.conf and an RTSystem profile into a folder that tandem run runs") {
    const Installation installation(pair_conf + "logger.file_name: ./log/rtc%p.log\n");
    installation.write(
        "robot/RTSystem.xml",
        system_profile(component("Counter0", "Counter",
                                 "<rts:ConfigurationSets rts:id=\"default\"><rts:ConfigurationData "
                                 "rts:name=\"step\" rts:data=\"3\"/></rts:ConfigurationSets>"
                                 "<rts:ConfigurationSets rts:id=\"__widget__\"><rts:ConfigurationData "
                                 "rts:name=\"step\" rts:data=\"text\"/></rts:ConfigurationSets>"
                                 "<rts:ExecutionContexts rts:id=\"0\" rts:kind=\"PERIODIC\" "
                                 "rts:rate=\"200.0\"/>") +
                       component("Reporter0", "Reporter") +
                       connection("Counter0", "out", "Reporter0", "in",
                                  property("dataport.serializer.cdr.endian", "little,big") +
                                      property("dataport.data_type", "IDL:RTC/TimedLong:1.0"))));
    const auto result = installation.import({"--activate"});
    INFO(result.output << result.errors << installation.written());
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(
        installation.written(),
        Contains("manager.components.preconnect: Counter0.out?port=Reporter0.in&interface_type=corba_cdr&"
                 "dataflow_type=push&subscription_type=flush\n") &&
            Contains("test.Counter0.conf.default.step: 3\n") &&
            Contains("test.Counter0.exec_cxt.periodic.rate: 200\n") && !Contains("widget"));
    CHECK_THAT(result.output,
               Contains("robot/rtc.conf:4: logger.file_name: ./log/rtc%p.log: the log goes to rtc%p.log"));
    CHECK_THAT(result.output, !Contains("to do: ") && Contains("next: tandem run"));
    const std::string page = BUILD_TREE "/share/doc/tandem/host/rtm/DIFFERENCES.md";
    CHECK_THAT(result.output, Contains("\nalways: " + page + " lists"));
    CHECK(std::filesystem::exists(page));
    const auto run = installation.run("received 10");
    INFO(run.output);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.output, Contains("received 10"));
}

TEST_CASE("tandem rtm import reports what in an rtc.conf has a different effect, by file and line") {
    const Installation installation("# comment\n" + pair_conf +
                                    "timer.tick: 0.1\n"
                                    "corba.http.password: secret\n"
                                    "manager.is_master: YES\n"
                                    "User Interface.Reporter0.config_file: conf/Reporter0.conf\n"
                                    "test.Counter0.config_file: nowhere.conf\n"
                                    "exec_cxt.periodic.type: ArtExecutionContext\n"
                                    "manager.components.preconnect: Counter0.out?port=Reporter0.in, "
                                    "Counter0.out?port=Gone0.in\n"
                                    "manager.components.preactivation: Counter0, Gone0\n");
    installation.write("robot/conf/Reporter0.conf", "conf.default.x: 1\n");
    const auto result = installation.import();
    INFO(result.output << result.errors << installation.written());
    REQUIRE(result.exit_code == 0);
    for (const char* line :
         {"rtc.conf:5: timer.tick: 0.1: left out: it has no effect here",
          "rtc.conf:7: manager.is_master: YES: port 2810 is open only at 127",
          "rtc.conf:8: User Interface.Reporter0.config_file: uses the copy ",
          "rtc.conf:9: test.Counter0.config_file: nowhere.conf: left out: the file does not exist",
          "rtc.conf:10: exec_cxt.periodic.type: ArtExecutionContext: not available",
          "rtc.conf:11: preconnect Counter0.out?port=Gone0.in: left out: no entry of precreate creates Gone0",
          "rtc.conf:12: preactivation Gone0: left out",
          "robot/rtc.conf: no corba.nameservers: no name server is used"})
        CHECK_THAT(result.output, Contains(line));
    CHECK_THAT(installation.written(), Contains("User Interface.Reporter0.config_file: Reporter0.conf\n") &&
                                           Contains("preconnect: Counter0.out?port=Reporter0.in\n") &&
                                           !Contains("timer.tick") && !Contains("Gone0") &&
                                           !Contains("ArtExecutionContext"));
    CHECK_THAT(result.output, Contains("rtc.conf:6: corba.http.password: ***: left out: it has no effect"));
    CHECK(content(installation.output() / "rtm/Reporter0.conf") == "conf.default.x: 1\n");
    CHECK(installation.run("ready").exit_code == 0);
}

TEST_CASE("tandem rtm import leaves out, by file and line, what rtm_host would refuse, and nothing else") {
    const Installation installation(
        "manager.modules.load_path: modules\n"
        "manager.modules.preload: TestComponents.so\n"
        "manager.components.precreate: Counter?manager_name=arm, Counter?instance_name=Counter0, "
        "Reporter?execution_contexts=LogicalTimeTriggeredEC(slow)&conf.default.x=1\n"
        "manager.components.preconnect: Counter0.out?port=Reporter0.in&interface_type=ros, "
        "Counter0.out?quick, "
        "Counter0?port=Reporter0.in\n"
        "manager.components.preactivation: Counter0, rtcname://localhost/Far0\n"
        "test.Counter0.config_file: Counter0.conf\n"
        "test.Counter.execution_contexts: ArtExecutionContext\n");
    installation.write("robot/Counter0.conf", "exec_cxt.periodic.type: ArtExecutionContext\n");
    const auto result = installation.import();
    INFO(result.output << result.errors << installation.written());
    REQUIRE(result.exit_code == 0);
    for (const char* line :
         {"rtc.conf:3: precreate Counter?manager_name=arm: manager_name left out: there are no slave "
          "managers",
          "rtc.conf:3: precreate Counter?instance_name=Counter0: left out: another entry creates Counter0",
          "execution_contexts LogicalTimeTriggeredEC(slow): not available: left out",
          "rtc.conf:4: preconnect Counter0.out?port=Reporter0.in&interface_type=ros: interface_type ros is "
          "not "
          "available: corba_cdr",
          "rtc.conf:4: preconnect Counter0.out?quick: left out: expected key=value, found quick",
          "rtc.conf:4: preconnect Counter0?port=Reporter0.in: left out: expected COMPONENT.PORT, found "
          "Counter0",
          "Counter0.conf:1: exec_cxt.periodic.type: ArtExecutionContext: not available",
          "rtc.conf:7: test.Counter.execution_contexts: ArtExecutionContext: not available"})
        CHECK_THAT(result.output, Contains(line));
    CHECK_THAT(installation.written(),
               Contains("precreate: Counter, \\\n    Reporter?conf.default.x=1\n") &&
                   Contains("preconnect: Counter0.out?port=Reporter0.in&interface_type=corba_cdr\n") &&
                   Contains("preactivation: Counter0, \\\n    rtcname://localhost/Far0\n") &&
                   Contains("test.Counter0.exec_cxt.periodic.type: PeriodicExecutionContext\n"));
}

TEST_CASE("tandem rtm import refuses a rate that rtm_host would refuse") {
    const std::string where = GENERATE("test.Counter0.exec_cxt.periodic.rate: 5O\n",
                                       "manager.components.precreate: Counter?exec_cxt.periodic.rate=5O\n",
                                       "test.Counter0.config_file: Counter0.conf\n");
    const Installation installation("manager.modules.preload: TestComponents.so\n" + where);
    installation.write("robot/Counter0.conf", "ec.slow.rate: 5O\n");
    CHECK_THAT(installation.refused(), Contains("rate is 5O, expected a rate in Hz") &&
                                           (Contains("rtc.conf:2: ") || Contains("Counter0.conf:1: ")));
}

TEST_CASE("tandem rtm import keeps topics, connections with one port, and the transport of a library") {
    const Installation installation(
        "manager.modules.load_path: modules\n"
        "manager.modules.preload: TestComponents.so, Post.so\n"
        "manager.components.precreate: Counter, Reporter\n"
        "manager.components.preconnect: Counter0.out?interface_type=post&topic=chat, "
        "Reporter0.in?interface_type=post&topic=chat\n"
        "port.outport.out.publish_topic: chat\n");
    const std::string post = (installation.robot() / "Post").string(),
                      modules = installation.robot() / "modules";
    installation.write(
        "robot/Post/Post.cpp",
        "#include <rtm/InPortProvider.h>\n#include <rtm/Manager.h>\n"
        "struct PostIn : RTC::InPortProvider { void init(coil::Properties&) override {}\n"
        "void setBuffer(RTC::BufferBase<RTC::ByteData>*) override {}\n"
        "void setListener(RTC::ConnectorInfo&, RTC::ConnectorListenersBase*) override {}\n"
        "void setConnector(RTC::InPortConnector*) override {} };\n"
        "extern \"C\" void PostInit(RTC::Manager*) {\n"
        "RTC::InPortProviderFactory::instance().addFactory(\"post\",\n"
        "coil::Creator<RTC::InPortProvider, PostIn>, coil::Destructor<RTC::InPortProvider, PostIn>); }\n");
    const auto built = tandem_program({"rtm", "build", post, "--output", modules});
    INFO(built.output << built.errors);
    REQUIRE(built.exit_code == 0);
    const auto result = installation.import();
    INFO(result.output << result.errors << installation.written());
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(installation.written(),
               Contains("preconnect: Counter0.out?interface_type=post&topic=chat, \\\n"
                        "    Reporter0.in?interface_type=post&topic=chat\n") &&
                   Contains("port.outport.out.publish_topic: chat\n"));
}

TEST_CASE("tandem rtm import takes a module that ignores the manager, and names the function that a library "
          "lacks") {
    const Installation installation("manager.modules.load_path: modules\n"
                                    "manager.modules.preload: Quiet.so, Renamed.so, Renamed.so(QuietInit)\n");
    const fs::path modules = installation.robot() / "modules";
    installation.write("robot/modules/Quiet.cpp", "extern \"C\" void QuietInit(void*) {}\n");
    REQUIRE(tandem::test::shell("c++ -shared -fPIC -o " + (modules / "Quiet.so").string() + " " +
                                (modules / "Quiet.cpp").string())
                .exit_code == 0);
    fs::copy_file(modules / "Quiet.so", modules / "Renamed.so");
    const auto result = installation.import();
    INFO(result.output << result.errors << installation.written());
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(result.output, !Contains("module Quiet") && !Contains("neither") &&
                                  Contains("module Renamed: library ") &&
                                  Contains("exports no function RenamedInit (extern \"C\")"));
    CHECK_THAT(installation.written(),
               Contains("preload: Quiet.so, \\\n    Renamed.so, \\\n    Renamed.so(QuietInit)\n"));
}

TEST_CASE("tandem rtm import names modules to build and their sources") {
    const Installation installation("manager.modules.preload: Arm.dylib, Hand.so, helper.py, RTPreemptEC.so, "
                                    "OpenSpliceTransport.so\n"
                                    "manager.components.precreate: Arm\n");
    installation.write("robot/rtc/ArmRTC/src/Arm.cpp",
                       "#include <rtm/Manager.h>\nextern \"C\" void ArmInit(RTC::Manager*) {}\n");
    installation.write("robot/Hand.so", "no library");
    const auto result = installation.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string rtm = (installation.output() / "rtm").string();
    CHECK_THAT(result.output,
               Contains("rtc.conf:1: module Arm: its library was not found; tandem rtm build ") &&
                   Contains("robot/rtc/ArmRTC --output " + rtm + "\n"));
    CHECK_THAT(result.output, Contains("module Hand: ") && Contains("FOLDER_OF_ITS_SOURCE"));
    CHECK_THAT(result.output, Contains("rtc.conf:1: preload helper.py: left out") &&
                                  Contains("preload RTPreemptEC.so: left out") &&
                                  Contains("preload OpenSpliceTransport.so: left out"));
    CHECK_THAT(installation.written(), Contains("preload: Arm.so, \\\n    Hand.so\n"));
}

TEST_CASE("components created by neither precreate nor a module stay in their processes and are connected by "
          "CORBA") {
    const Installation installation(pair_conf);
    installation.write("robot/system/DefaultSystem.xml",
                       system_profile(component("Counter0", "Counter") + component("Far0", "Far") +
                                      component("Further0", "Further") +
                                      component("All0", "All", "", "rts:compositeType=\"PeriodicECShared\"") +
                                      connection("Counter0", "out", "Far0", "in") +
                                      connection("Far0", "out", "Further0", "in") +
                                      connection("All0", "out", "Counter0", "in") +
                                      connection("Counter0", "out", "Reporter0", "in",
                                                 property("dataport.interface_type", "corba_cdr_udp") +
                                                     property("dataport.note", "a,b"))));
    const auto result = installation.import();
    INFO(result.output << result.errors << installation.written());
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(installation.written(), Contains("Counter0.out?port=rtcname://localhost/Far0.in&") &&
                                           !Contains("Further0") && !Contains("All0") && !Contains("udp") &&
                                           !Contains("a,b"));
    CHECK_THAT(
        result.output,
        Contains("DefaultSystem.xml:4: Far0 of type Far: created neither by precreate nor by a module here"));
    CHECK_THAT(
        result.output,
        Contains("DefaultSystem.xml:8: Far0.out to Further0.in: left out, because both ports are in other "
                 "processes; to connect them, run tandem rtm connect rtcname://localhost/Far0.out"));
    CHECK_THAT(result.output, Contains("DefaultSystem.xml:6: All0: composite PeriodicECShared: not created"));
    CHECK_THAT(result.output, Contains("DefaultSystem.xml:9: All0.out to Counter0.in: left out"));
    CHECK_THAT(result.output, Contains("interface_type corba_cdr_udp: not available"));
    CHECK_THAT(result.output, Contains("dataport.note a,b: left out"));
    CHECK_THAT(result.output,
               Contains("activation by a person: activate them with tandem rtm activate Counter0,"));
}

TEST_CASE("a component of the profile whose module exists is created in the host") {
    const Installation installation("manager.modules.load_path: modules\n");
    // The second one is written as Choreonoid does, with the instance's name in place of the type.
    installation.write("robot/RTSystem.xml", system_profile(component("Left", "TestComponents") +
                                                            component("TestComponents0", "TestComponents0")));
    const auto result = installation.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(installation.written(), Contains("preload: TestComponents.so\n") &&
                                           Contains("precreate: TestComponents?instance_name=Left, \\\n    "
                                                    "TestComponents?instance_name=TestComponents0\n"));
    CHECK_THAT(
        result.output,
        Contains("RTSystem.xml:3: Left of type TestComponents: runs in rtm_host, not as a separate program"));
}

TEST_CASE("tandem rtm import accepts a profile without an rtc.conf") {
    const Installation installation("");
    fs::remove(installation.robot() / "rtc.conf");
    installation.write("robot/Counter.cpp",
                       "#include <rtm/Manager.h>\nextern \"C\" void CounterInit(RTC::Manager*) {}\n");
    installation.write("robot/RTSystem.xml", system_profile(component("Counter0", "Counter")));
    const auto result = installation.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(installation.written(),
               Contains("precreate: Counter\n") && Contains("manager.shutdown_auto: NO\n"));
    CHECK_THAT(result.output, Contains("RTSystem.xml: no rtc.conf: RTCs are in no name server"));
    CHECK_THAT(result.output,
               Contains("RTSystem.xml:3: module Counter: its library was not found; tandem rtm build " +
                        installation.robot().string() + " --output"));
}

TEST_CASE("tandem rtm import adds an InterceptorComp that shares all RTCs, and keeps the other host's part "
          "of the folder") {
    const Installation installation(pair_conf);
    installation.write("moved/opros/mine.xml", "mine");
    const auto result = installation.import({"--link", "robot", "--json"});
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(installation.written(), Contains("TestComponents.so, \\\n    InterceptorComp.so\n") &&
                                           Contains("InterceptorComp?link=robot&rtc=Counter0;Reporter0\n"));
    CHECK(content(installation.output() / "opros/mine.xml") == "mine");
    const auto json = result.json();
    CHECK(json["tasks"].empty());
    CHECK(json["differences"][0].contains("here"));
    const auto again = installation.import();
    CHECK(again.exit_code == 1);
    CHECK_THAT(again.errors, Contains("moved/rtm exists and is not empty"));
}

TEST_CASE("an import that is killed leaves no folder that the next one refuses or tandem run starts") {
    const Installation installation(pair_conf);
    const pid_t child = fork();
    if (child == 0) { // by _exit no destructor runs, as after SIGKILL
        const tandem::command::ImportFolder folder(installation.output(), installation.robot(), "rtm");
        std::ofstream(folder.path() / "rtc.conf") << "half";
        _exit(0);
    }
    int status = 1;
    waitpid(child, &status, 0);
    REQUIRE(status == 0);
    CHECK(!fs::exists(installation.output()));
    const auto result = installation.import({"--json"});
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string written = installation.output() / "rtm/rtc.conf";
    CHECK(result.json()["files"] == nlohmann::json::array({written}));
    CHECK(fs::exists(written));
    CHECK(std::distance(fs::directory_iterator(installation.path()), {}) == 2); // robot and moved
}

TEST_CASE("tandem rtm import refuses bad input with one line that names the place, and leaves no files") {
    CHECK_THAT(Installation("manager.name: a\nno setting\n").refused(),
               Contains("rtc.conf:2: expected `key: value`"));
    CHECK_THAT(Installation("\nexec_cxt.periodic.rate: fast\n").refused(),
               Contains("rtc.conf:2: exec_cxt.periodic.rate is fast"));
    CHECK_THAT(Installation("\n\nmanager.components.precreate: A:B\n").refused(), Contains("rtc.conf:3: "));
    CHECK_THAT(Installation(pair_conf).refused({"--link", "a b"}), Contains("link name 'a b': expected"));
    const auto refused = [](const std::string& text) {
        const Installation installation(pair_conf);
        installation.write("robot/RTSystem.xml", text);
        return installation.refused();
    };
    CHECK_THAT(refused("<rts:RtsProfile>\n<rts:Components>\n"),
               Contains("RTSystem.xml:") && Contains("not well-formed"));
    CHECK_THAT(refused(system_profile("")), Contains("RTSystem.xml:2: the system has no component"));
    CHECK_THAT(refused(system_profile("<rts:Components rts:id=\"RTC:V:C:T:1\"/>")),
               Contains("RTSystem.xml:3: <rts:Components> lacks its attribute instanceName"));
    CHECK_THAT(refused(system_profile("<rts:Components rts:instanceName=\"A0\" rts:id=\"A\"/>")),
               Contains("RTSystem.xml:3: id is 'A', expected RTC:"));
    CHECK_THAT(refused(system_profile(component("A0&#10;manager.name: b", "A"))),
               Contains("RTSystem.xml:3: instanceName 'A0?manager.name: b' has a character"));
    CHECK_THAT(refused(system_profile(component("A0", "A") + connection("A0", "out&amp;port=B", "A0", "in"))),
               Contains("RTSystem.xml:4: portName 'A0.out&port=B' has a character"));
    CHECK_THAT(refused(system_profile(component("A0", "A") + "<rts:DataPortConnectors rts:name=\"c\"/>")),
               Contains("RTSystem.xml:4: <rts:DataPortConnectors> lacks its <sourceDataPort>"));
    const Folder empty;
    const auto nothing = tandem_program({"rtm", "import", empty.path(), "-o", empty.path() / "moved"});
    CHECK(nothing.exit_code == 1);
    CHECK_THAT(nothing.errors, Contains("has neither an rtc.conf"));
    const Installation two(pair_conf);
    for (const char* name : {"robot/A.xml", "robot/system/B.xml"})
        two.write(name, system_profile(component("A0", "A")));
    CHECK_THAT(two.refused(),
               Contains("several RTSystem profiles: A.xml, system/B.xml; choose one with --system"));
    const Installation damaged(pair_conf);
    damaged.write("robot/RTSystem.xml", "<rts:RtsProfle>");
    CHECK_THAT(damaged.refused(), Contains("RTSystem.xml:1: not well-formed XML"));
}
