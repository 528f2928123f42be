// SPDX-License-Identifier: Apache-2.0
// `tandem run`: both hosts of a folder that `tandem link profile` has written.
#include "host/process/child_process.hpp"
#include "host/process/output_pipe.hpp"
#include "tests/integration/joined_folder.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

using Catch::Contains;

namespace {

/// A folder `joined` of TalkerComp and EchoRtc, and `tandem run` on it.
class Run {
  public:
    Run() {
        folder_.add_component("TalkerComp");
        folder_.add_component("EchoRtc");
        link_ = folder_.path().filename().string();
        const auto written =
            folder_.tandem({"link", "profile", "TalkerComp", "EchoRtc", "--out", "joined", "--link", link_});
        INFO(written.output);
        REQUIRE(written.exit_code() == 0);
    }
    const ScratchFolder& folder() const { return folder_; }

    /// Makes the run write its standard output to this file instead of to output().
    void set_output(const std::string& file) { output_file_ = file; }
    void start(const std::vector<std::string>& arguments = {}) {
        std::vector<std::string> command{TANDEM_PROGRAM, "run", "joined"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        tandem::process::ChildOptions options;
        options.output = options.errors = pipe_.writer();
        const tandem::process::FileDescriptor file(
            output_file_.empty() ? -1 : open(output_file_.c_str(), O_WRONLY | O_CLOEXEC));
        if (file) options.output = file.get();
        options.folder = folder_.path().string();
        process_.emplace(command, options);
        pipe_.close_writer();
    }
    /// Waits until the output from `from` on has the text.
    bool says(const std::string& text, std::size_t from = 0) {
        for (int i = 0; i < 1500; ++i) {
            pipe_.read_available(output_);
            if (output_.find(text, from) != std::string::npos) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return false;
    }
    /// The process id that the run prints after this text.
    pid_t pid_after(const std::string& text) {
        REQUIRE(says(text));
        return std::stoi(output_.substr(output_.find(text) + text.size()));
    }
    void signal(int number) { ::kill(process_->pid(), number); }
    /// -1 if it was killed or does not end within a generous time.
    int exit_code() {
        for (int i = 0; i < 3000 && !process_->poll(); ++i) {
            pipe_.read_available(output_);
            process_->wait(std::chrono::milliseconds(20));
        }
        pipe_.read_available(output_);
        const auto& ended = process_->poll();
        return ended && !ended->signalled ? ended->code : -1;
    }
    const std::string& output() const { return output_; }
    bool left_in_shared_memory() const {
        for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
            if (entry.path().filename().string().find(link_) != std::string::npos) return true;
        return false;
    }

  private:
    ScratchFolder folder_;
    std::string link_, output_, output_file_;
    tandem::process::OutputPipe pipe_;
    std::optional<tandem::process::ChildProcess> process_;
};

/// The environment of a service of Type=notify with WatchdogSec=1: a socket, and its name in a variable.
class NotifySocket {
  public:
    explicit NotifySocket(const std::string& path) : fd_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.copy(address.sun_path, sizeof address.sun_path - 1);
        REQUIRE(bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
        const timeval limit{30, 0};
        setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        setenv("NOTIFY_SOCKET", path.c_str(), 1);
        setenv("WATCHDOG_USEC", "1000000", 1);
    }
    ~NotifySocket() {
        unsetenv("NOTIFY_SOCKET");
        unsetenv("WATCHDOG_USEC");
        close(fd_);
    }
    /// Returns the next message; empty if none comes within a generous time.
    std::string next() {
        char text[512];
        const auto length = recv(fd_, text, sizeof text, 0);
        return length > 0 ? std::string(text, static_cast<std::size_t>(length)) : "";
    }
    /// Behaves like a service manager that reads nothing for a while.
    void fill(const std::string& path) const {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.copy(address.sun_path, sizeof address.sun_path - 1);
        while (sendto(fd_, "x", 1, MSG_DONTWAIT, reinterpret_cast<const sockaddr*>(&address),
                      sizeof address) == 1) {
        }
    }
    /// Returns whether the message arrives, even after others.
    bool tells(const std::string& wanted) {
        for (std::string message; !(message = next()).empty();)
            if (message == wanted) return true;
        return false;
    }

  private:
    int fd_;
};

bool is_alive(pid_t pid) { return ::kill(pid, 0) == 0; }

/// Also true for an orphan that nobody reaps, as in a container without an init process.
bool has_ended(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text;
    std::getline(file, text);
    return text.empty() || text.find(") Z ") != std::string::npos;
}

} // namespace

TEST_CASE("tandem run joins two components, and Ctrl-C ends both hosts normally") {
    Run run;
    run.start();
    const pid_t rtm = run.pid_after("rtm_host started, pid "),
                opros = run.pid_after("opros_host started, pid ");
    CHECK(run.says("\nopros_host | reply: hello 5 at a time\n"));
    CHECK(run.says("\ntandem run: all hosts are ready; Ctrl-C ends them\n"));
    run.signal(SIGINT);
    CHECK(run.exit_code() == 0);
    INFO(run.output());
    CHECK_THAT(run.output(), Contains("tandem run: all hosts have ended\n"));
    CHECK_FALSE(is_alive(rtm));
    CHECK_FALSE(is_alive(opros));
    CHECK_FALSE(run.left_in_shared_memory());
}

TEST_CASE("tandem run continues if its log cannot be written, and reports the number of missing lines") {
    Run run;
    run.set_output("/dev/full");
    run.start({"--restart", "1"});
    REQUIRE(run.says("all hosts are ready"));
    // Once more, although the hosts have written lines by then.
    ::kill(run.pid_after("rtm_host started, pid "), SIGKILL);
    CHECK(run.says("tandem run: rtm_host started again (1 of 1), pid "));
    CHECK(run.says("all hosts are ready", run.output().find("started again")));
    run.signal(SIGINT);
    CHECK(run.exit_code() == 0);
    INFO(run.output());
    CHECK_THAT(run.output(),
               Contains("tandem run: ending the hosts\n") && Contains("all hosts have ended\n") &&
                   Contains(" lines of the log could not be written (No space left on device)\n"));
    CHECK_FALSE(run.left_in_shared_memory());
}

TEST_CASE("a component that prints continues while the output of tandem run is not read, which counts the "
          "lost lines") {
    Run run;
    const auto folder = run.folder().path() / "joined";
    std::filesystem::remove_all(folder / "opros");
    std::ofstream(folder / "rtm/rtc.conf") << "manager.modules.load_path: " TEST_PLUGINS "\n"
                                              "manager.modules.preload: PrinterRtc.so\n"
                                              "manager.components.precreate: PrinterRtc\n"
                                              "manager.components.preactivation: PrinterRtc0\n"
                                              "exec_cxt.periodic.rate: 1000\n";
    run.start();
    const auto printed = folder / "rtm/printed";
    for (int i = 0; i < 1500 && !std::filesystem::exists(printed); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(std::filesystem::exists(printed)); // 20 MB, of which the pipe holds 1 MB
    CHECK(run.says(" lines of the log could not be written (no process reads it)\n"));
    run.signal(SIGINT);
    CHECK(run.exit_code() == 0);
}

TEST_CASE("tandem run reports the signal of a killed host and ends the other one") {
    Run run;
    run.start();
    REQUIRE(run.says("reply: hello 1 "));
    REQUIRE(run.says("all hosts are ready"));
    const pid_t opros = run.pid_after("opros_host started, pid ");
    ::kill(run.pid_after("rtm_host started, pid "), SIGKILL);
    CHECK(run.exit_code() == 1);
    INFO(run.output());
    CHECK_THAT(run.output(), Contains(") was killed by signal 9 (Killed)\n"));
    CHECK_FALSE(is_alive(opros));
    CHECK_FALSE(run.left_in_shared_memory());
}

TEST_CASE("tandem run restarts a killed host up to the given number of times") {
    Run run;
    run.start({"--restart", "1"});
    REQUIRE(run.says("all hosts are ready"));
    ::kill(run.pid_after("rtm_host started, pid "), SIGKILL);
    REQUIRE(run.says("tandem run: rtm_host started again (1 of 1), pid "));
    // Searches more than the end of the output, because the new host may have printed the rest before the line above was read.
    const std::size_t restarted = run.output().find("rtm_host started again");
    CHECK(run.says("is up again", restarted));
    CHECK(run.says("reply: hello ", restarted));
    ::kill(run.pid_after("rtm_host started again (1 of 1), pid "), SIGKILL);
    CHECK(run.exit_code() == 1);
    CHECK_FALSE(run.left_in_shared_memory());
}

TEST_CASE("tandem run ends with the host's own message if a host cannot start") {
    Run run;
    std::ofstream(run.folder().path() / "joined/rtm/rtc.conf", std::ios::app)
        << "manager.components.precreate: NoSuchRtc\n";
    run.start({"--wait", "30"});
    CHECK(run.exit_code() == 1);
    INFO(run.output());
    CHECK_THAT(run.output(),
               Contains("rtm_host   | rtm_host: ") && Contains("there is no component type NoSuchRtc"));
    CHECK_THAT(run.output(), Contains(") exited with 1 before it was ready\n"));
    const std::string last = run.output().substr(run.output().rfind('\n', run.output().size() - 2) + 1);
    CHECK_THAT(last, Catch::StartsWith("tandem run: failed: rtm_host (pid ") &&
                         Contains("before it was ready: rtm_host: ") &&
                         Contains("there is no component type NoSuchRtc"));
    CHECK_THAT(run.output(), !Contains("| ready"));
}

TEST_CASE("tandem run names a component that has not started along with `all hosts are ready`") {
    Run run;
    std::filesystem::remove(run.folder().path() / "TalkerComp/TalkerComp.so");
    run.start();
    CHECK(run.says("; opros_host: ready, but TalkerComp has not started; Ctrl-C ends them\n"));
    run.signal(SIGINT);
    CHECK(run.exit_code() == 0);
}

TEST_CASE("hosts end cleanly when tandem run is killed, although their output is no longer read") {
    Run run;
    run.start();
    REQUIRE(run.says("all hosts are ready"));
    const pid_t hosts[] = {run.pid_after("rtm_host started, pid "),
                           run.pid_after("opros_host started, pid ")};
    run.signal(SIGKILL);
    const auto all_ended = [&] { return has_ended(hosts[0]) && has_ended(hosts[1]); };
    for (int i = 0; i < 1500 && !all_ended(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(all_ended());
    CHECK_FALSE(run.left_in_shared_memory());
}

TEST_CASE("tandem run does not wait for a host whose peer could not start") {
    Run run;
    std::ofstream(run.folder().path() / "joined/rtm/rtc.conf", std::ios::app)
        << "manager.components.precreate: NoSuchRtc\n";
    const auto application = run.folder().path() / "joined/opros/joined.xml";
    std::ifstream in(application);
    std::string xml{std::istreambuf_iterator<char>(in), {}};
    const std::string end = "</properties>";
    REQUIRE(xml.find(end) != std::string::npos);
    xml.insert(xml.find(end),
               "<property name=\"wait\">600</property>"); // far beyond the time that a host has to end
    std::ofstream(application) << xml;
    run.start();
    CHECK(run.exit_code() == 1);
    INFO(run.output());
    CHECK_THAT(run.output(),
               Contains("had not joined when this host was asked to stop") && !Contains("killed"));
    CHECK_FALSE(run.left_in_shared_memory());
}

TEST_CASE("tandem run --lockstep runs each component by its period, identically in every run") {
    std::string replies[2];
    for (auto& reply : replies) {
        Run run;
        std::ofstream(run.folder().path() / "joined/rtm/rtc.conf", std::ios::app)
            << "exec_cxt.periodic.rate: 200\n";
        run.start({"--lockstep", "--duration", "1"}); // TalkerComp says a word every 10 ms
        CHECK(run.exit_code() == 0);
        INFO(run.output());
        CHECK_THAT(run.output(), Contains("tandem run: lock-step finished: 200 ticks, 1 s\n"));
        for (std::size_t at = 0; (at = run.output().find("reply: ", at)) != std::string::npos; ++at)
            reply += run.output().substr(at, run.output().find('\n', at) - at + 1);
        CHECK_FALSE(run.left_in_shared_memory());
    }
    CHECK_THAT(replies[0], Contains("reply: hello 1 at a time\n") &&
                               Contains("reply: hello 99 at a time\n") && !Contains("hello 101"));
    CHECK(replies[0] == replies[1]);
}

TEST_CASE("tandem run as a service notifies systemd that it is ready, alive, and ending") {
    Run run;
    NotifySocket systemd((run.folder().path() / "notify").string());
    run.start({"--restart", "1"});
    CHECK(systemd.tells("READY=1"));
    CHECK(systemd.tells("WATCHDOG=1"));
    CHECK(systemd.tells("WATCHDOG=1"));
    const pid_t rtm = run.pid_after("rtm_host started, pid ");
    ::kill(rtm, SIGKILL);
    CHECK(systemd.tells("STATUS=rtm_host (pid " + std::to_string(rtm) + ") was killed by signal 9 (Killed)"));
    CHECK(systemd.tells("STATUS=all hosts are ready"));
    run.signal(SIGTERM);
    CHECK(systemd.tells("STOPPING=1"));
    CHECK(run.exit_code() == 0);
}

TEST_CASE("a service manager that does not read prevents tandem run neither from restarting a host nor from "
          "ending") {
    Run run;
    const std::string path = (run.folder().path() / "notify").string();
    const NotifySocket systemd(path);
    systemd.fill(path);
    run.start({"--restart", "1"});
    REQUIRE(run.says("all hosts are ready"));
    ::kill(run.pid_after("rtm_host started, pid "), SIGKILL);
    CHECK(run.says("tandem run: rtm_host started again (1 of 1), pid "));
    run.signal(SIGTERM);
    CHECK(run.exit_code() == 0);
}

TEST_CASE("tandem run reports what is missing in a folder") {
    ScratchFolder folder;
    std::filesystem::create_directories(folder.path() / "empty/opros");
    CHECK_THAT(folder.tandem({"run", "nowhere"}).output, Contains("tandem: nowhere is not a folder\n"));
    const auto empty = folder.tandem({"run", "empty"});
    CHECK(empty.exit_code() == 1);
    CHECK_THAT(empty.output,
               Contains("empty has neither an application profile in opros/ nor rtm/rtc.conf; tandem link "
                        "profile A B --output DIR writes both for two components\n"));
}

TEST_CASE("tandem run, doctor and link check name an unreadable file and start no hosts") {
    const JoinedFolder folder;
    const std::string application = "joined/opros/joined.xml", conf = "joined/rtm/rtc.conf";
    std::string expected;
    SECTION("a mistyped tag") {
        folder.edit(application, "<name>joined", "<nmae>joined");
        expected = "joined.xml:3: not well-formed XML: ";
    }
    SECTION("a tag mistyped twice") {
        folder.edit(application, "<name>joined</name>", "<nmae>joined</nmae>");
        expected = "joined.xml:2: <package_profile> lacks its <name>";
    }
    SECTION("a mistyped root element") {
        folder.edit(application, "<package_profile>", "<pakage_profile>");
        folder.edit(application, "</package_profile>", "</pakage_profile>");
        expected = "joined.xml:2 has <pakage_profile>; correct this";
    }
    SECTION("a truncated file") {
        std::filesystem::resize_file(folder.path() / application, 100);
        expected = "joined.xml:";
    }
    SECTION("a link to nothing") {
        std::filesystem::remove(folder.path() / application);
        std::filesystem::create_symlink("nowhere.xml", folder.path() / application);
        expected = "joined.xml cannot be read: no such file";
    }
    SECTION("a damaged profile beside the application") {
        std::ofstream(folder.path() / "joined/opros/Other.xml") << "<component_profile>";
        expected = "Other.xml:1: not well-formed XML: ";
    }
    SECTION("a line of rtc.conf without a separator") {
        folder.edit(conf, "naming.enable: NO", "naming.enable NO");
        expected = "rtc.conf:2: expected `key: value`, found `naming.enable NO`";
    }
    SECTION("an invalid value in rtc.conf") {
        folder.edit(conf, "naming.enable: NO", "naming.enable: perhaps");
        expected = "rtc.conf:2: naming.enable is perhaps, expected YES or NO";
    }
    SECTION("a folder in place of rtc.conf") {
        std::filesystem::remove(folder.path() / conf);
        std::filesystem::create_directory(folder.path() / conf);
        expected = "rtc.conf: cannot be read: not a regular file";
    }
    SECTION("an rtc.conf with another name") {
        std::filesystem::rename(folder.path() / conf, folder.path() / "joined/rtm/rtc2.conf");
        expected = "rtm has rtc2.conf, but no rtc.conf; ";
    }
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"run", "joined", "--wait", "20"},
                                               {"run", "joined", "--strict", "--wait", "20"},
                                               {"doctor", "joined"},
                                               {"link", "check", "joined"}}) {
        const auto result = folder.tandem(arguments);
        INFO(arguments[0] << ": " << result.output);
        CHECK(result.exit_code() == 1);
        CHECK_THAT(result.output, Contains(expected) && !Contains("started, pid"));
    }
}

TEST_CASE("tandem run treats XML files of other kinds as data of the components") {
    const JoinedFolder folder;
    std::ofstream(folder.path() / "joined/opros/map.xml") << "<map/>";
    CHECK(folder.tandem({"link", "check", "joined"}).exit_code() == 0);
}
