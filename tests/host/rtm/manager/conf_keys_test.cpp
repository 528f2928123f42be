// SPDX-License-Identifier: Apache-2.0
// The check of rtc.conf against the table of keys, files that are not a configuration, and the log settings.
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include "host/rtm/runtime/configuration/openrtm_modules.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/support/comma_locale.hpp"
#include <filesystem>
#include <fstream>

using namespace testing;

namespace {

// The warnings of check_and_normalize_settings() for a file with this text, whose settings are read into `conf`.
std::vector<std::string> check_text(const std::string& text, coil::Properties& conf) {
    const auto file = std::filesystem::temp_directory_path() / ("tandem_keys." + std::to_string(getpid()));
    std::ofstream(file) << text;
    RTC::SettingOrigins origins;
    RTC::read_conf_file(file, conf, &origins);
    std::filesystem::remove(file);
    return RTC::check_and_normalize_settings(conf, origins);
}
std::vector<std::string> check_text(const std::string& text) {
    coil::Properties conf;
    return check_text(text, conf);
}

} // namespace

TEST_CASE("Every known key passes without a warning, and so do keys of components") {
    std::string text;
    for (const auto& key : RTC::conf_keys()) {
        std::string name = key.name;
        name = coil::replaceString(coil::replaceString(name, "**", "x.y"), "*", "x");
        const char* const values[] = {"any", "YES",  "0.5",   "1000",          "100",
                                      "7",   "0, 1", "DEBUG", "process_unique"};
        text += name + ": " + values[key.value] + "\n";
    }
    text += "example.ConsoleIn.config_file: a.conf\nmy.ConsoleIn0.conf.default.gain: 3\n";
    CHECK(check_text(text).empty());
}

TEST_CASE("Values of known keys have a decimal point, whatever locale a component has set") {
    const tandem::test::CommaLocale locale;
    coil::Properties conf;
    CHECK(check_text("exec_cxt.periodic.rate: 0.5\nmanager.peer_check_interval: 1.25\n", conf).empty());
    CHECK_THROWS_WITH(check_text("exec_cxt.periodic.rate: 0,5\n"),
                      Catch::Contains("is 0,5, expected a rate in Hz"));
}

TEST_CASE("An unknown key is named with file, line and the nearest known key") {
    const auto lines =
        check_text("# rtc.conf\nmanager.components.precreat: A\nexec_ctx.periodic.rate: 10\nrate: 5\n");
    REQUIRE(lines.size() == 3);
    using Catch::Contains;
    CHECK_THAT(lines[0], Contains(":3: ") && Contains("did you mean exec_cxt.periodic.rate?"));
    CHECK_THAT(lines[1], Contains(":2: ") && Contains("did you mean manager.components.precreate?"));
    CHECK_THAT(lines[2], Contains(":4: unknown key rate"));
}

TEST_CASE("Misspelt keys and wrong values of one kind of execution context, or of a single one, are reported "
          "like those of all") {
    using Catch::Contains;
    const auto lines =
        check_text("ec.PeriodicExecutionContext.rate: 100\nec.PeriodicExecutionContext.rte: 100\n"
                   "ec.PeriodicExecutonContext.rate: 100\nec.ec0.sync_transiton: NO\nec.rate: 100\n"
                   "ec.OpenHRPExecutionContext.cycles: 3\n");
    const std::vector<std::string> expected{
        "unknown key ec.OpenHRPExecutionContext.cycles; did you mean ec.OpenHRPExecutionContext.",
        "unknown key ec.PeriodicExecutionContext.rte; did you mean ec.PeriodicExecutionContext.rate?",
        "unknown key ec.PeriodicExecutonContext.rate; did you mean ec.PeriodicExecutionContext.rate?",
        "unknown key ec.ec0.sync_transiton; did you mean ec.ec0.sync_transition?",
        "unknown key ec.rate; did you mean ec.PeriodicExecutionContext.rate?"};
    REQUIRE(lines.size() == expected.size());
    for (std::size_t i = 0; i < lines.size(); ++i) CHECK_THAT(lines[i], Contains(expected[i]));
    CHECK_THROWS_WITH(check_text("\nec.PeriodicExecutionContext.rate: abc\n"),
                      Contains(":2: ec.PeriodicExecutionContext.rate is abc, expected a rate in Hz above 0"));
    // A context type of a library has additional options, and a context may have any name.
    CHECK(
        check_text("ec.FieldbusContext.bus: can0\nec.FieldbusContext.cycle.us: 500\nec.ec1.cpu_affinity: 0\n"
                   "ec.PeriodicExecutionContext0.rate: 5\n")
            .empty());
}

TEST_CASE("Misspelt settings of ports are reported, and those that a library may have are accepted") {
    using Catch::Contains;
    const auto lines = check_text("port.inport.in.bufer.length: 3\nport.inprt.in.buffer.length: 3\n"
                                  "port.outport.arm.pose.publisher.push_polcy: all\n"
                                  "port.inport.buffer.length: 3\nport.corba.conection_limit: 1\n"
                                  "port.corbaport.svc.conection_limit: 1\n");
    const std::vector<std::string> expected{
        "unknown key port.corba.conection_limit; did you mean port.corba.connection_limit?",
        "unknown key port.corbaport.svc.conection_limit; did you mean port.corbaport.svc.connection_limit?",
        "unknown key port.inport.buffer.length; did you mean port.inport.dataport.buffer.length?",
        "unknown key port.inport.in.bufer.length; did you mean port.inport.in.buffer.length?",
        "unknown key port.inprt.in.buffer.length; did you mean port.inport.in.buffer.length?",
        "unknown key port.outport.arm.pose.publisher.push_polcy; did you mean "
        "port.outport.arm.pose.publisher.push_policy?"};
    REQUIRE(lines.size() == expected.size());
    for (std::size_t i = 0; i < lines.size(); ++i) CHECK_THAT(lines[i], Contains(expected[i]));
    CHECK(check_text("port.inport.in.buffer.length: 3\nport.inport.arm.pose.buffer.write.full_policy: block\n"
                     "port.outport.dataport.publisher.push_policy: all\nport.inport.in.buffer.channel: c\n"
                     "port.outport.out.fieldbus.address: 7\nport.inport.in.vendor: x\n"
                     "port.corba.connection_limit: 1\nport.connection.strictness: strict\n")
              .empty());
    CHECK_THROWS_WITH(check_text("port.inport.in.buffer.length: eight\n"),
                      Contains(":1: port.inport.in.buffer.length is eight, expected an integer"));
}

TEST_CASE("A value that its key cannot have is refused with file, line and the expected values") {
    using Catch::Contains;
    CHECK_THROWS_WITH(check_text("\nmanager.shutdown_auto: maybe\n"),
                      Contains(":2: manager.shutdown_auto is maybe, expected YES or NO"));
    CHECK_THROWS_WITH(check_text("exec_cxt.periodic.rate: 0\n"), Contains("expected a rate in Hz above 0"));
    CHECK_THROWS_WITH(check_text("exec_cxt.periodic.rate: 100Hz\n"), Contains("is 100Hz"));
    CHECK_THROWS_WITH(check_text("exec_cxt.transition_timeout: soon\n"), Contains("expected seconds"));
    CHECK_THROWS_WITH(check_text("exec_cxt.cpu_affinity: 0, one\n"), Contains("processor numbers"));
    CHECK_THROWS_WITH(check_text("logger.log_level: LOUD\n"), Contains("LOUD"));
    CHECK_THROWS_WITH(check_text("manager.components.naming_policy: pretty\n"), Contains("process_unique"));
    CHECK(check_text("corba.endpoints:\nmanager.shutdown_auto:\n").empty());
}

TEST_CASE("Each key refuses each value that it cannot have") {
    const std::string long_text(1000, 'x');
    int refused = 0;
    for (const auto& key : RTC::conf_keys()) {
        if (key.value == RTC::ConfKey::text) continue;
        std::string name = coil::replaceString(coil::replaceString(key.name, "**", "x.y"), "*", "x");
        for (const std::string value : {"-1", "nan", "1e300", "-inf", "0x", "yes no", "\x95\x5c\x82", ";",
                                        "1,,-2", "99999999999999999999", long_text.c_str()}) {
            CAPTURE(name, value);
            const bool may_be_negative =
                key.value == RTC::ConfKey::integer || key.value == RTC::ConfKey::milliseconds;
            const bool fits = may_be_negative && value == "-1";
            if (fits) continue;
            CHECK_THROWS_WITH(check_text(name + ": " + value + "\n"),
                              Catch::Contains(":1: " + name + " is ") && Catch::Contains(", expected "));
            ++refused;
        }
    }
    CHECK(refused > 200);
}

TEST_CASE(
    "Files that are not a configuration are refused with one line, and files of other systems are read") {
    using Catch::Contains;
    coil::Properties conf;
    CHECK(check_text("\xef\xbb\xbfmanager.name: a\r\n# \x95\x5c\r\nmanager.shutdown_auto: NO\r\n", conf)
              .empty());
    CHECK(conf.getProperty("manager.name") == "a");
    CHECK(conf.getProperty("manager.shutdown_auto") == "NO");
    CHECK(check_text("test.A.title: \x83\x65\x83\x58\x83\x67\n").empty()); // Shift-JIS is kept
    CHECK(check_text("manager.name: no end of line").empty());
    CHECK(check_text("Mobile Robot.Base0.conf.default.speed: 2\n", conf).empty()); // a category with a blank
    CHECK(conf.getProperty("Mobile Robot.Base0.conf.default.speed") == "2");
    CHECK_THROWS_WITH(check_text(std::string("m\0a\0:\0 \0b\0\n", 9)), Contains("expected `key: value`"));
    CHECK_THROWS_WITH(check_text(std::string(900000, 'x') + "\n"),
                      Contains(":1: expected") && Contains("..."));
    CHECK_THROWS_WITH(check_text(std::string(1100000, '#')), Contains("more than 1 MB"));
    std::string many;
    for (int i = 0; i < 10001; ++i) many += "a.b.c" + std::to_string(i) + ": 1\n";
    CHECK_THROWS_WITH(check_text(many), Contains(":10001: more than 10000 settings"));
    std::string deep = "a";
    for (int i = 0; i < 400000; ++i) deep += ".a";
    CHECK(check_text(deep + ": 1\n").empty());
    CHECK_THROWS_WITH(RTC::read_conf_file("/dev/zero", conf), Contains("more than 1 MB"));
    CHECK_THROWS_WITH(RTC::read_conf_file("/", conf), Contains("not a regular file"));
}

TEST_CASE("The keys without effect, and no others, are in the table of DIFFERENCES.md") {
    std::ifstream in(TANDEM_RTM_FOLDER "/DIFFERENCES.md");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string table = text.substr(text.find("accepted and do nothing"));
    for (const auto& key : RTC::conf_keys()) {
        CAPTURE(key.name);
        CHECK((table.find("`" + std::string(key.name) + "`") != std::string::npos) == !key.used);
    }
}

TEST_CASE("Other words for yes and no are understood") {
    coil::Properties conf;
    CHECK(check_text("manager.shutdown_auto: false\nmanager.is_master: On\n", conf).empty());
    CHECK(conf.getProperty("manager.shutdown_auto") == "NO");
    CHECK(conf.getProperty("manager.is_master") == "YES");
}

TEST_CASE("The log goes to several files with a level and a date format") {
    const auto folder = std::filesystem::temp_directory_path() / ("tandem_log." + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    coil::Argv argv(
        {"test", "-o", "naming.enable:NO", "-o", "logger.log_level:WARN", "-o", "logger.date_format:%Y|%Q|%q",
         "-o",
         "logger.file_name:" + (folder / "rtc%p.log").string() + ", " + (folder / "second-%M.log").string(),
         "-o", "manager.componnents.precreate:A"});
    auto& manager = RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), RTC::Manager::Options());
    RTC::Logger rtclog("me");
    RTC_INFO(("not this"));
    RTC_WARN(("but this"));
    for (const auto& name : {"rtc" + std::to_string(getpid()) + ".log", std::string("second-manager.log")}) {
        std::ifstream in(folder / name);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        CAPTURE(name, text);
        CHECK(text.find("not this") == std::string::npos);
        CHECK(text.find("[warn] me: but this\n") != std::string::npos);
        CHECK(text.find("option -o: unknown key manager.componnents.precreate") != std::string::npos);
        CHECK(text.find_first_of('|') == 5);
        CHECK(text.find("] ", 0) == std::string("[2026|123|123456").size());
    }
    manager.shutdown();
    std::filesystem::remove_all(folder);
}

TEST_CASE("The modules of OpenRTM-aist are in the table of DIFFERENCES.md") {
    std::ifstream in(TANDEM_RTM_FOLDER "/DIFFERENCES.md");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string table = text.substr(text.find("## Modules of OpenRTM-aist"));
    const std::size_t errors = table.find("an error that says");
    const std::size_t passed_over = table.find("passed over");
    for (const auto& module : RTC::openrtm_modules()) {
        CAPTURE(module.name);
        const std::size_t at = table.find("`" + module.name + "`");
        CHECK(at < (module.can_be_left_out ? passed_over : errors));
        CHECK((at > passed_over) == !module.can_be_left_out);
        CHECK(RTC::find_openrtm_module("/opt/" + module.name + ".so") == &module);
    }
    CHECK(RTC::find_openrtm_module("MyModule.so") == nullptr);
}

TEST_CASE("A misspelt property of a connector is named with what was probably meant, and those of libraries "
          "are not") {
    using RTC::connector_property_error;
    CHECK(connector_property_error("dataport.dataflow_typ", "push") ==
          "unknown key dataflow_typ; did you mean dataflow_type?");
    CHECK(connector_property_error("dataport.inport.bufer.length", "4") ==
          "unknown key inport.bufer.length; did you mean buffer.length?");
    CHECK(connector_property_error("port.connection.strictnes", "strict") ==
          "unknown key port.connection.strictnes; did you mean port.connection.strictness?");
    CHECK(connector_property_error("dataport.buffer.length", "four") ==
          "buffer.length is four, expected an integer");
    for (const std::string known :
         {"dataflow_type", "interface_type", "subscription_type", "push_rate", "publisher.push_policy",
          "outport.buffer.length", "serializer.cdr.endian", "corba_cdr.inport_ior", "my_library.way"})
        CHECK(connector_property_error("dataport." + known, "") == "");
    CHECK(connector_property_error("port.connection.strictness", "strict") == "");
}

TEST_CASE("One line names the settings that have no effect, with their places, and no others") {
    const RTC::SettingOrigins origins{{"logger.clock_type", "rtc.conf:3"},
                                      {"timer.enable", "option -o"},
                                      {"manager.name", "rtc.conf:1"},
                                      {"manager.modules.C++.load_paths", "rtc.conf:2"}};
    CHECK_THAT(RTC::settings_without_effect(origins),
               Catch::StartsWith("accepted without effect: logger.clock_type (rtc.conf:3)") &&
                   Catch::Contains("timer.enable (option -o)") && !Catch::Contains("manager."));
    CHECK(RTC::settings_without_effect({{"manager.name", "rtc.conf:1"}}).empty());
}
