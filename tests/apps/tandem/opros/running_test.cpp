// SPDX-License-Identifier: Apache-2.0
// `tandem opros list | info | start | stop | recover | conf` with running hosts.
#include "host/process/child_process.hpp"
#include "tests/apps/tandem/program.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sys/stat.h>
#include <thread>

using Catch::Contains;
using tandem::process::ChildProcess;
using tandem::test::Result;
using tandem::test::tandem_program;

namespace {

/// Hides this test's hosts from others. Hosts without such a folder are seen nevertheless, so some cases run alone.
struct OwnRuntimeFolder {
    OwnRuntimeFolder() {
        ::chmod(folder.path().c_str(), 0700);
        ::setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
    }
    ~OwnRuntimeFolder() { ::unsetenv("XDG_RUNTIME_DIR"); }
    Folder folder;
};

Result opros(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "opros");
    return tandem_program(arguments);
}

nlohmann::json listed_hosts() {
    const Result result = opros({"list", "--json"});
    return result.exit_code == 0 ? result.json() : nlohmann::json::array();
}

/// An opros_host with M, a maker.
struct Host {
    explicit Host(const std::string& trouble = "none") : process(command(folder, trouble)) {
        for (int i = 0; i < 3000 && !is_listed(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        REQUIRE(is_listed());
    }
    static std::vector<std::string> command(const Folder& folder, const std::string& trouble) {
        folder.component("M", "maker", "<type>periodic</type><period>5</period>",
                         "<property name=\"trouble\">" + trouble + "</property>");
        return {OPROS_HOST, "--plugin-path", FIXTURES,
                folder.application(Folder::sub("M", "M.xml")).string()};
    }
    bool is_listed() const {
        for (const auto& host : listed_hosts())
            if (host["pid"] == process.pid()) return true;
        return false;
    }
    Folder folder;
    ChildProcess process;
};

} // namespace

TEST_CASE("tandem opros lists, stops, starts and configures a component of a running host") {
    const OwnRuntimeFolder runtime;
    Host host;
    CHECK_THAT(opros({"list"}).output,
               Contains("M") && Contains("ACTIVE") && Contains("periodic, every 5 ms"));
    CHECK(opros({"stop", "M"}).output == "M INACTIVE\n");
    CHECK(opros({"conf", "M", "trouble", "start fails"}).output == "trouble=start fails\n");
    const Result failed = opros({"start", "M"});
    CHECK(failed.exit_code == 1);
    CHECK_THAT(failed.errors, Contains("component M: onStart failed"));
    CHECK_THAT(opros({"info", "M"}).output, Contains("state      ERROR") && Contains("onStart failed"));
    CHECK(opros({"recover", "M"}).output == "M READY\n");
    CHECK(opros({"conf", "M", "trouble=none", "--json"}).json()["properties"]["trouble"] == "none");
    CHECK(opros({"start", "M", "--json"}).json()[0]["state"] == "ACTIVE");
    const auto info = opros({"info", "M", "--json"}).json();
    CHECK(info["state"] == "ACTIVE");
    CHECK(info["last_error"] == "");
    CHECK(info["period_ms"] == 5);
}

TEST_CASE("a component of several hosts is named with its host") {
    const OwnRuntimeFolder runtime;
    Host first, second;
    const Result ambiguous = opros({"stop", "M"});
    CHECK(ambiguous.exit_code == 1);
    CHECK_THAT(ambiguous.errors, Contains("2 hosts have a component M: name one of"));
    CHECK(opros({"stop", std::to_string(second.process.pid()) + "/M"}).output == "M INACTIVE\n");
    for (const auto& host : listed_hosts())
        CHECK(host["components"][0]["state"] ==
              (host["pid"] == second.process.pid() ? "INACTIVE" : "ACTIVE"));
}

TEST_CASE("a name that no running component has is refused in one line", "[alone]") {
    const OwnRuntimeFolder runtime;
    CHECK_THAT(opros({"list"}).errors, Contains("no opros_host of this user is running"));
    CHECK_THAT(opros({"info", "M"}).errors, Contains("no opros_host of this user is running"));
    Host host;
    const Result unknown = opros({"recover", "N"});
    CHECK(unknown.exit_code == 1);
    CHECK_THAT(unknown.errors,
               Contains("no running opros_host has a component N") && Contains("there are: M"));
    const Result property = opros({"conf", "M", "troubel", "x"});
    CHECK(property.exit_code == 1);
    CHECK_THAT(property.errors, Contains("did you mean trouble?"));
}

TEST_CASE(
    "a component that hangs, and a host that is stopped, end a command after its time limit in one line",
    "[alone]") {
    const OwnRuntimeFolder runtime;
    Host host("execute hangs");
    const Result hangs = opros({"stop", "M", "--timeout", "0.5"});
    CHECK(hangs.exit_code == 1);
    CHECK_THAT(hangs.errors, Contains("stop has not ended within 0.5 s: onExecute has taken"));
    CHECK_THAT(opros({"list"}).output, Contains("ACTIVE (onExecute has taken"));
    ::kill(host.process.pid(), SIGSTOP);
    const Result stopped = opros({"list", "--timeout", "0.5"});
    CHECK(stopped.exit_code == 1);
    CHECK_THAT(stopped.errors, Contains("does not answer within 0.5 s"));
    ::kill(host.process.pid(), SIGCONT);
}

TEST_CASE("a host that was killed is not listed, and its socket is removed", "[alone]") {
    const OwnRuntimeFolder runtime;
    Host host;
    host.process.kill();
    CHECK(opros({"list"}).exit_code == 1);
    std::size_t sockets = 0;
    for (const auto& entry : std::filesystem::directory_iterator(runtime.folder.path() / "tandem"))
        sockets += entry.path().filename().string().rfind("opros.", 0) == 0 ? 1 : 0;
    CHECK(sockets == 0);
}
