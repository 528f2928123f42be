// SPDX-License-Identifier: Apache-2.0
// Bad plugins among good ones, in the hosts as a user starts them.
#include "host/process/run_command.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

namespace {

struct Run {
    int exit_code;
    std::string errors;
    long lines() const { return std::count(errors.begin(), errors.end(), '\n'); }
    long lines_with(const std::string& text) const {
        std::istringstream in(errors);
        long count = 0;
        for (std::string line; std::getline(in, line);) count += line.find(text) != std::string::npos ? 1 : 0;
        return count;
    }
};

// Runs the host and collects its standard error. A host that becomes ready is stopped.
Run run(const std::string& command) {
    const std::string ready = "case $line in ready*) kill -TERM $host;; esac";
    tandem::process::CommandOptions options;
    options.timeout = std::chrono::seconds(100);
    const auto end =
        tandem::process::run_command({"/bin/bash", "-c",
                                      "coproc " + command + "; host=$COPROC_PID; while read -r line; do " +
                                          ready + "; done <&${COPROC[0]}; wait $host"},
                                     options);
    REQUIRE_FALSE(end.timed_out);
    return {end.exit_code(), end.errors};
}

const std::vector<std::string> bad_ones{"static_constructor_crashes",
                                        "static_constructor_hangs",
                                        "entry_throws",
                                        "entry_hangs",
                                        "entry_exits",
                                        "symbol_missing",
                                        "no_entry",
                                        "device_api",
                                        "another_tandem",
                                        "another_tandem_in_part",
                                        "before_the_numbers",
                                        "helper_of_another_tandem"};

} // namespace

TEST_CASE("opros_host refuses a bad plugin in one line at the library's name") {
    const std::string bad = GENERATE(from_range(bad_ones));
    const Folder folder;
    folder.component("Bad", ZOO "/opros/" + bad + ".so");
    const auto result = run(std::string(OPROS_HOST) + " --probe-timeout 1 " +
                            folder.application(Folder::sub("Bad", "Bad.xml")).string());
    INFO(result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.lines() == 1);
    CHECK_THAT(result.errors,
               Catch::Contains("Bad.xml:3: library ") || Catch::Contains("Bad.xml:3: getComponent()"));
    CHECK_THAT(result.errors, Catch::Contains(bad));
}

TEST_CASE("opros_host keeps running the good plugins without the bad one") {
    const std::string bad = GENERATE(from_range(bad_ones));
    const Folder folder;
    folder.component("Good", OPROS_PLUGIN);
    folder.component("Bad", ZOO "/opros/" + bad + ".so");
    const auto result =
        run(std::string(OPROS_HOST) + " --probe-timeout 1 " +
            folder.application(Folder::sub("Bad", "Bad.xml") + Folder::sub("Good", "Good.xml")).string());
    INFO(result.errors);
    CHECK(result.exit_code == 0);
    CHECK(result.lines_with("Bad") == 1);
    CHECK(result.lines_with("[error] ") == 1);
    CHECK_THAT(result.errors,
               Catch::Contains("Bad.xml:3: ") && Catch::Contains(bad) && Catch::Contains("stopping on"));
}

TEST_CASE("a component that calls exit while opros_host runs others ends it with its own code") {
    const Folder folder;
    folder.component("Good", OPROS_PLUGIN);
    folder.component("Bad", ZOO "/opros/execute_exits.so", "<type>periodic</type><period>1</period>");
    const auto application =
        folder.application(Folder::sub("Bad", "Bad.xml") + Folder::sub("Good", "Good.xml"));
    const auto end = tandem::process::run_command({OPROS_HOST, application.string()});
    INFO(end.errors);
    REQUIRE_FALSE(end.timed_out);
    CHECK(end.exit_code() == 7);
}

TEST_CASE("rtm_host refuses a bad module in one line that names it") {
    const std::string bad = GENERATE(
        from_range(bad_ones), values<std::string>({"rtc_constructor_throws", "rtc_destructor_crashes"}));
    const Folder folder;
    const auto conf = folder.write("rtc.conf", "manager.modules.load_path: " ZOO "/rtm\n"
                                               "manager.modules.preload: " +
                                                   bad + ".so\n");
    const auto result = run(std::string(RTM_HOST) + " --probe-timeout 1 -f " + conf.string());
    INFO(result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.lines() == 1);
    CHECK_THAT(result.errors,
               Catch::StartsWith("rtm_host: ") && Catch::Contains("rtc.conf: manager.modules.preload: "));
    CHECK_THAT(result.errors, Catch::Contains(bad));
}

// As a module of OpenRTM-aist whose project forgets a source: OpenRTM-aist runs it.
TEST_CASE("rtm_host runs a component whose module calls an undefined function, and names the function") {
    const Folder folder;
    const auto conf = folder.write("rtc.conf", "manager.modules.load_path: " ZOO "/rtm\n"
                                               "manager.modules.preload: rtc_lacks_a_function.so\n"
                                               "manager.components.precreate: Incomplete\n"
                                               "manager.components.preactivation: Incomplete0\n");
    const auto result = run(std::string(RTM_HOST) + " -f " + conf.string());
    INFO(result.errors);
    CHECK(result.exit_code == 0);
    CHECK(result.lines_with("nobody_defines_this") == 1);
    CHECK_THAT(result.errors,
               Catch::Contains("rtc_lacks_a_function.so: undefined symbol: ") &&
                   Catch::Contains(" is loaded, but a call of this function will end the host"));
}

TEST_CASE("rtm_host warns of a component whose destructor hangs, runs it and leaves without it") {
    const Folder folder;
    const auto conf = folder.write("rtc.conf", "manager.modules.load_path: " ZOO "/rtm\n"
                                               "manager.modules.preload: rtc_destructor_hangs.so\n"
                                               "manager.components.precreate: Endless\n"
                                               "manager.components.preactivation: Endless0\n");
    const auto result = run(std::string(RTM_HOST) + " --probe-timeout 8 --grace 2 -f " + conf.string());
    INFO(result.errors);
    CHECK(result.exit_code == 1); // a component was left behind
    CHECK_THAT(result.errors, Catch::Contains("the destructor of Endless does not return; the host"));
    CHECK_THAT(result.errors,
               Catch::Contains("the destructor of Endless0 does not return; the host continues"));
    CHECK_THAT(result.errors, Catch::Contains("exiting without waiting for the destructor of Endless0"));
}

TEST_CASE(
    "a plugin built against the headers of another Tandem is refused before its code runs, with the remedy") {
    const auto [bad, number] =
        GENERATE(table<std::string, std::string>({{"another_tandem", " 999999, here it is "},
                                                  {"another_tandem_in_part", " and 999999, here it is "},
                                                  {"before_the_numbers", " number, here it is "}}));
    const Folder folder;
    folder.component("Bad", ZOO "/opros/" + bad + ".so");
    const auto application = folder.application(Folder::sub("Bad", "Bad.xml"));
    const auto conf = folder.write("rtc.conf", "manager.modules.preload: " ZOO "/rtm/" + bad + ".so\n");
    for (const std::string probed : {"", " --no-probe"}) {
        const auto opros = run(OPROS_HOST + probed + " " + application.string());
        CHECK(opros.exit_code == 1);
        CHECK_THAT(opros.errors,
                   Catch::Contains("Bad.xml:3: library " ZOO "/opros/" + bad + ".so was built against") &&
                       Catch::Contains("OPRoS ABI ") && Catch::Contains(number) &&
                       Catch::EndsWith("build it again: tandem opros build DIR\n"));
        const auto rtm = run(RTM_HOST + probed + " -f " + conf.string());
        CHECK(rtm.exit_code == 1);
        CHECK_THAT(rtm.errors, Catch::Contains("library " ZOO "/rtm/" + bad + ".so was built against") &&
                                   Catch::Contains("RTM ABI ") && Catch::Contains(number) &&
                                   Catch::EndsWith("build it again: tandem rtm build DIR\n"));
    }
}

TEST_CASE("a library that a plugin needs is named when it was built against the headers of another Tandem") {
    const Folder folder;
    folder.component("Bad", ZOO "/opros/helper_of_another_tandem.so");
    const auto conf =
        folder.write("rtc.conf", "manager.modules.preload: " ZOO "/rtm/helper_of_another_tandem.so\n");
    const auto check_message = [](const std::string& line, const std::string& model) {
        CHECK_THAT(line, Catch::Contains("libzoo_old_helper.so, which " ZOO "/" + model +
                                         "/helper_of_another_tandem.so needs, was built against"));
    };
    for (const std::string probed : {"", " --no-probe"}) {
        const std::string application = folder.application(Folder::sub("Bad", "Bad.xml"));
        check_message(run(OPROS_HOST + probed + " " + application).errors, "opros");
        check_message(run(RTM_HOST + probed + " -f " + conf.string()).errors, "rtm");
    }
}

TEST_CASE(
    "a program of a component that was built against the headers of another Tandem ends with one line") {
    const auto result = run(ZOO "/zoo_old_program");
    CHECK(result.exit_code == 1);
    CHECK(result.lines() == 1);
    CHECK_THAT(result.errors, Catch::StartsWith("program " ZOO "/zoo_old_program was built against") &&
                                  Catch::EndsWith("build it again\n"));
}

TEST_CASE("a host recognizes a plugin of the wrong model") {
    const Folder folder;
    folder.component("Bad", RTM_PLUGIN);
    const auto opros =
        run(std::string(OPROS_HOST) + " " + folder.application(Folder::sub("Bad", "Bad.xml")).string());
    CHECK_THAT(opros.errors, Catch::Contains("is an RTC module (exports HWCompInit)"));
    const auto conf = folder.write("rtc.conf", "manager.modules.preload: " OPROS_PLUGIN "\n");
    CHECK_THAT(run(std::string(RTM_HOST) + " -f " + conf.string()).errors,
               Catch::Contains("is an OPRoS component (exports getComponent)"));
}
