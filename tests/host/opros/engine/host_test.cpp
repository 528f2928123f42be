// SPDX-License-Identifier: Apache-2.0
// opros_host as a process.
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <sys/wait.h>
#include <thread>

namespace {

/// A child process whose standard output and error are read together.
class Process {
  public:
    explicit Process(const std::vector<std::string>& arguments) {
        int out[2];
        REQUIRE(pipe(out) == 0);
        pid_ = fork();
        if (pid_ == 0) {
            dup2(out[1], STDOUT_FILENO);
            dup2(out[1], STDERR_FILENO);
            close(out[0]);
            std::vector<char*> argv;
            for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
            argv.push_back(nullptr);
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(out[1]);
        read_end_ = out[0];
    }
    ~Process() {
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
        if (read_end_ >= 0) close(read_end_);
    }

    /// Reads until the text has come, the process ends, or 60 s are over.
    bool prints(const std::string& text) {
        while (output.find(text) == std::string::npos) {
            pollfd readable{read_end_, POLLIN, 0};
            char chunk[512];
            if (poll(&readable, 1, 60000) <= 0) return false;
            const ssize_t got = read(read_end_, chunk, sizeof chunk);
            if (got <= 0) return false;
            output.append(chunk, static_cast<std::size_t>(got));
        }
        return true;
    }
    void signal(int number) { kill(pid_, number); }
    /// Behaves like a stalled reader of the log: fills the pipe, and reads no more.
    void stall() {
        const int writer =
            open(("/proc/self/fd/" + std::to_string(read_end_)).c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        REQUIRE(writer >= 0);
        for (const std::string page(4096, '.'); write(writer, page.data(), page.size()) > 0;) {
        }
        close(writer);
    }
    /// Returns the exit code without reading; nothing if the host runs on for a minute.
    std::optional<int> exit_code_unread() {
        int status = 0;
        for (int i = 0; i < 6000; ++i) {
            if (waitpid(pid_, &status, WNOHANG) == pid_) {
                pid_ = -1;
                return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return std::nullopt;
    }
    /// Behaves like a reader of the log that ends.
    void stop_reading() {
        close(read_end_);
        read_end_ = -1;
    }
    /// Sends the signal again and again until the process has ended, for 30 s at most. Returns the signal that ended
    /// it, or 0.
    int signal_until_ended(int number) {
        int status = 0;
        for (int i = 0; i < 600; ++i) {
            signal(number);
            if (waitpid(pid_, &status, WNOHANG) == pid_) {
                pid_ = -1;
                return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return 0;
    }
    int exit_code() {
        if (read_end_ >= 0) prints("text that no program prints");
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    std::string output;

  private:
    pid_t pid_;
    int read_end_;
};

std::filesystem::path one_component(const Folder& folder, const std::string& library,
                                    const std::string& trouble = "") {
    folder.component("M", library, "<type>periodic</type><period>10</period>",
                     "<property name=\"trouble\">" + trouble + "</property>");
    return folder.application(Folder::sub("M", "M.xml"));
}

} // namespace

TEST_CASE("the host prints ready when all components have started and stops them in order on a signal") {
    const int number = GENERATE(SIGINT, SIGTERM, SIGHUP);
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, one_component(folder, "maker.dll")});
    REQUIRE(host.prints("ready\n"));
    host.signal(number);
    CHECK(host.exit_code() == 0);
}

TEST_CASE("the host accepts all its options") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", "/nowhere", "--plugin-path", FIXTURES, "--cpu", "0",
                  "--tick-spin", "50", "--wait-mode", "same-core", "--low-latency-idle", "--parent-death",
                  "--lockstep", folder.path() / "step", one_component(folder, "maker")});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 0);
}

TEST_CASE("bad input is reported in one line on standard error, with exit code 1") {
    const Folder folder;
    Process host({OPROS_HOST, one_component(folder, "nothing.dll")});
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output, Catch::StartsWith("opros_host: ") &&
                                Catch::Contains("M.xml:3: library 'nothing.dll' not found"));
    CHECK(std::count(host.output.begin(), host.output.end(), '\n') == 1);
    Process missing({OPROS_HOST, "/nowhere/app.xml"});
    CHECK(missing.exit_code() == 1);
    CHECK_THAT(missing.output, Catch::Contains("/nowhere/app.xml"));
}

TEST_CASE("a wrong device library is reported in one line that says what the file is") {
    const Folder folder;
    folder.component("M", "maker", "<type>passive</type>",
                     "<property name=\"ApiName\">printer</property><property name=\"DllName\">Text</property>"
                     "<property name=\"ArmApiName\">Nowhere</property>");
    folder.write("Text.so", "int main() {}\n");
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, folder.application(Folder::sub("M", "M.xml"))});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 0);
    CHECK_THAT(host.output,
               Catch::Contains("[warn] opros_host: ApiName printer: library ") &&
                   Catch::Contains("libprinter.so is an OPRoS component (exports getComponent), "
                                   "expected a device API, which exports GetAPI (extern \"C\")"));
    CHECK_THAT(host.output,
               Catch::Contains("[warn] opros_host: DllName Text: ") && Catch::Contains("Text.so"));
    CHECK_THAT(host.output,
               Catch::Contains("M.xml:5: property ArmApiName: device library 'Nowhere' not found: looked for "
                               "Nowhere.so, libNowhere.so"));
}

TEST_CASE("events that come to a port without an owner are named once") {
    const Folder folder;
    folder.component("M", "maker", "<type>periodic</type><period>10</period>");
    folder.component("S", "sink", "<type>passive</type>", "<property name=\"owner\">none</property>");
    Process host({OPROS_HOST, "--plugin-path", FIXTURES,
                  folder.application(Folder::sub("M", "M.xml") + Folder::sub("S", "S.xml"),
                                     Folder::connect("event", "M", "news", "S", "news"))});
    REQUIRE(host.prints("component S: events come to port 'news' and are lost, because it has no owner; call "
                        "its setOwner(this) where the port is added\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 0);
    CHECK(host.output.find("has no owner") == host.output.rfind("has no owner"));
}

TEST_CASE("a call of an unconnected method in onStart is reported in one line") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, one_component(folder, "maker", "start calls")});
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output, Catch::Contains("component M: onStart failed, it made a call that failed: "
                                            "required method add is not connected\n"));
}

TEST_CASE("a host whose component hangs in onExecute names it and exits") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "0.1",
                  one_component(folder, "maker", "execute hangs")});
    REQUIRE(host.prints("ready\n"));
    REQUIRE(host.prints("M hangs\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output, Catch::Contains("component M does not return from onExecute within 0.1 s"));
}

TEST_CASE("signals within one second are one request to stop and everything is stopped in order") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, one_component(folder, "maker")});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGINT);
    host.signal(SIGTERM);
    host.signal(SIGHUP);
    CHECK(host.exit_code() == 0);
    CHECK_THAT(host.output, Catch::Contains("M is gone\n"));
}

TEST_CASE("a host whose log is no longer read keeps running, and ends cleanly") {
    const Folder folder;
    signal(SIGPIPE, SIG_DFL); // what the host inherits
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, one_component(folder, "maker")});
    REQUIRE(host.prints("ready\n"));
    host.stop_reading();
    host.signal(SIGTERM); // the component writes that it is gone
    CHECK(host.exit_code() == 0);
}

TEST_CASE("one signal ends a host whose log is full and not read") {
    const Folder folder;
    // The component itself prints a line at its end, and blocks while doing so.
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "0.2", one_component(folder, "maker")});
    REQUIRE(host.prints("ready\n"));
    host.stall();
    host.signal(SIGTERM);
    CHECK(host.exit_code_unread() == 1);
}

TEST_CASE("a second signal ends a host whose component does not stop") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "3600",
                  one_component(folder, "maker", "stop hangs")});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    REQUIRE(host.prints("M hangs\n"));
    CHECK(host.signal_until_ended(SIGINT) == SIGINT);
}

TEST_CASE("a host whose component hangs in the set-up can be ended") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "0.1",
                  one_component(folder, "maker", "initialize hangs")});
    REQUIRE(host.prints("M hangs\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output, Catch::Contains("onInitialize of component M does not return within 0.1 s"));
}

TEST_CASE("a host says which slow callback it waits for, and continues when the callback has returned") {
    const Folder folder;
    Process host(
        {OPROS_HOST, "--plugin-path", FIXTURES, one_component(folder, "maker", "start and stop are slow")});
    REQUIRE(host.prints("ready\n"));
    CHECK_THAT(host.output,
               Catch::Contains("onStart of component M has taken 2 s so far; Ctrl-C ends the host\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 0);
    CHECK_THAT(
        host.output,
        Catch::Contains("onStop of component M has taken 2 s so far; the host waits for it up to 10 s\n") &&
            Catch::Contains("M is gone\n"));
}

TEST_CASE("a host whose component hangs during shutdown names it and the callback and exits") {
    const auto [where, callback] = GENERATE(
        table<std::string, std::string>({{"stop hangs", "onStop"},
                                         {"destroy hangs", "onDestroy"},
                                         {"its destructor hangs", "its destructor"},
                                         {"its static destructors hang", "its static destructors"}}));
    const Folder folder;
    Process host(
        {OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "0.1", one_component(folder, "maker", where)});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output,
               Catch::Contains("component M does not return from " + callback + " within 0.1 s"));
}

TEST_CASE("a library that stays loaded and hangs after main() is named and the host exits") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "0.1",
                  one_component(folder, "lasting_maker", "its static destructors hang")});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output,
               Catch::Contains("the library hangs\nopros_host: component M does not return from "
                               "its static destructors within 0.1 s; the host exits without it\n"));
}

TEST_CASE("a component that hangs in its destructor does not keep others from being destroyed") {
    const Folder folder;
    folder.component("M", "maker", "<type>passive</type>",
                     "<property name=\"trouble\">its destructor hangs</property>");
    folder.component("Hardware", "maker", "<type>passive</type>");
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "0.1",
                  folder.application(Folder::sub("M", "M.xml") + Folder::sub("Hardware", "Hardware.xml"))});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output, Catch::Contains("M hangs\n") && Catch::Contains("Hardware is gone\n"));
}

TEST_CASE("a failed set-up ends the host even when a component hangs in its destructor") {
    const Folder folder;
    folder.component("M", "maker", "<type>passive</type>",
                     "<property name=\"trouble\">its destructor hangs</property>");
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--grace", "0.1", "--strict",
                  folder.application(Folder::sub("M", "M.xml"),
                                     Folder::connect("data", "M", "numbers", "M", "none"))});
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output, Catch::Contains("M hangs\n") && Catch::Contains("'none'"));
}

TEST_CASE("a library that has not been built is named with the command that builds it") {
    const Folder folder;
    folder.write("arm/src/arm.cpp", "");
    folder.write("arm/profile/Arm.xml", "");
    std::filesystem::rename(one_component(folder, "ArmComp").parent_path() / "M.xml",
                            folder.path() / "arm/profile/Arm.xml");
    const std::string arm = (folder.path() / "arm").string();
    Process host({OPROS_HOST, folder.application(Folder::sub("M", arm + "/profile/Arm.xml"))});
    CHECK(host.exit_code() == 1);
    CHECK_THAT(host.output, Catch::Contains("library 'ArmComp' not found: looked for ") &&
                                Catch::Contains("; tandem opros build " + arm + " builds it\n"));
}

TEST_CASE("mistakes in properties are reported when the host starts") {
    const Folder folder;
    folder.component("M", "maker", "<type>periodic</type><period>10</period>",
                     "<property name=\"Size\" type=\"int\">three</property>");
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, folder.application(Folder::sub("M", "M.xml"))});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 0);
    CHECK_THAT(host.output,
               Catch::Contains("M.xml:5: property Size is 'three', expected a whole number (type int)\n") &&
                   Catch::Contains(
                       "component M asks for property trouble, which its profile does not have; it gets an "
                       "empty text\n"));
}

TEST_CASE("a device library that the application overrides is not looked for") {
    const Folder folder;
    folder.component(
        "S", "sensing", "<type>passive</type>",
        "<property name=\"DllName\">GriiperAPI</property><property name=\"scale\">4.5</property>");
    Process host(
        {OPROS_HOST, "--plugin-path", FIXTURES,
         folder.application(Folder::sub(
             "S", "S.xml", "<properties><property name=\"DllName\">own_device</property></properties>"))});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 0);
    CHECK_THAT(host.output, !Catch::Contains("GriiperAPI"));
}

TEST_CASE("the host prints what its executors have counted with --stats") {
    const Folder folder;
    Process host({OPROS_HOST, "--plugin-path", FIXTURES, "--stats", one_component(folder, "maker")});
    REQUIRE(host.prints("ready\n"));
    host.signal(SIGTERM);
    CHECK(host.exit_code() == 0);
    CHECK_THAT(host.output, Catch::Contains("executor of M: every 10 ms, "));
}
