// SPDX-License-Identifier: Apache-2.0
// `tandem run` in a terminal, for components that read the keyboard.
#include "host/process/child_process.hpp"
#include "tests/integration/scratch_folder.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace {

enum class In { opros = 1, rtm = 2, both = 3 };

/// A folder with components that read keys, and a terminal in which a shell runs.
class Terminal {
  public:
    Terminal(In hosts, const std::string& how) {
        if (hosts != In::rtm) write_application(how);
        if (hosts != In::opros) write_rtc_conf(how);
        const winsize size{24, 90, 0, 0};
        int terminal = -1;
        shell_ = forkpty(&terminal, nullptr, nullptr, &size);
        REQUIRE(shell_ >= 0);
        if (shell_ == 0) {
            setenv("TANDEM_PLUGIN_PATH", TEST_PLUGINS, 1);
            setenv("PS1", "$ ", 1);
            execl("/bin/sh", "sh", "-i", static_cast<char*>(nullptr)); // which has job control
            _exit(127);
        }
        terminal_ = tandem::process::FileDescriptor(terminal);
        tcgetattr(terminal, &settings_);
    }
    ~Terminal() {
        terminal_ = tandem::process::FileDescriptor();
        kill(shell_, SIGHUP);
        waitpid(shell_, nullptr, 0);
    }

    void run(const std::string& options = "") {
        type(TANDEM_PROGRAM " run " + folder_.path().string() + options + "; echo code $?-\n");
        REQUIRE(says("all hosts are ready"));
    }
    void type(const std::string& keys) {
        REQUIRE(write(terminal_.get(), keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
    }
    bool says(const std::string& text, std::size_t from = 0) {
        for (int i = 0; i < 1500; ++i) {
            char buffer[4096];
            pollfd event{terminal_.get(), POLLIN, 0};
            while (poll(&event, 1, 0) > 0 && (event.revents & POLLIN)) {
                const auto size = read(terminal_.get(), buffer, sizeof buffer);
                if (size <= 0) break;
                output_.append(buffer, static_cast<std::size_t>(size));
            }
            if (output_.find(text, from) != std::string::npos) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        UNSCOPED_INFO(output_);
        return false;
    }
    bool answers(const std::string& keys, const std::string& text) {
        type(keys);
        return says(text);
    }
    /// Waits until tandem run has changed the settings of the terminal.
    bool is_taken() {
        for (int i = 0; i < 1500 && is_as_before(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return !is_as_before();
    }
    pid_t pid_of(const std::string& host) {
        const std::string text = host + " started, pid ";
        REQUIRE(says(text));
        return std::stoi(output_.substr(output_.find(text) + text.size()));
    }
    /// The process in the foreground: tandem run while it runs.
    pid_t foreground() const { return tcgetpgrp(terminal_.get()); }
    bool is_as_before() const {
        termios now{};
        tcgetattr(terminal_.get(), &now);
        return std::memcmp(&now, &settings_, sizeof now) == 0;
    }
    void resize(unsigned short columns) const {
        const winsize size{24, columns, 0, 0};
        ioctl(terminal_.get(), TIOCSWINSZ, &size);
    }
    const std::string& output() const { return output_; }
    const std::filesystem::path& folder() const { return folder_.path(); }
    std::size_t count(const std::string& text) const {
        std::size_t found = 0;
        for (std::size_t at = 0; (at = output_.find(text, at)) != std::string::npos; ++at) ++found;
        return found;
    }

  private:
    void write_application(const std::string& how) const {
        std::filesystem::create_directory(folder_.path() / "opros");
        std::filesystem::copy_file(TEST_SOURCES "/opros/KeyComp.xml", folder_.path() / "opros/KeyComp.xml");
        std::ofstream(folder_.path() / "opros/app.xml")
            << "<package_profile><name>app</name><subcomponents><subcomponent><name>Keys</name>"
               "<reference>KeyComp.xml</reference><properties><property name=\"how\">"
            << how << "</property></properties></subcomponent></subcomponents></package_profile>\n";
    }
    void write_rtc_conf(const std::string& how) const {
        std::filesystem::create_directory(folder_.path() / "rtm");
        std::ofstream(folder_.path() / "rtm/rtc.conf")
            << "manager.modules.load_path: " TEST_PLUGINS "\nmanager.modules.preload: KeyRtc.so\n"
            << "manager.components.precreate: KeyRtc?how=" << how
            << "\nmanager.components.preactivation: KeyRtc0\nexec_cxt.periodic.rate: 100\n";
    }

    ScratchFolder folder_;
    pid_t shell_ = -1;
    tandem::process::FileDescriptor terminal_;
    termios settings_{};
    std::string output_;
};

} // namespace

TEST_CASE("a component of either host gets each key of the terminal without Enter, until Ctrl-C") {
    const In host = GENERATE(In::opros, In::rtm);
    const std::string how = GENERATE("wait_for_key", "look_for_key");
    CAPTURE(static_cast<int>(host), how);
    Terminal terminal(host, how);
    terminal.run();
    terminal.type("w");
    CHECK(terminal.says("| key w\r\n"));
    terminal.type("a\x04"); // Ctrl-D is a key like others
    CHECK(terminal.says("| key a\r\n"));
    terminal.type("d");
    CHECK(terminal.says("| key d\r\n"));
    terminal.type("\x03");
    CHECK(terminal.says("code 0-"));
    CHECK(terminal.count("does not return") == 0);
    CHECK(terminal.is_as_before());
}

TEST_CASE("a component reads edited lines of the terminal and sees its width") {
    Terminal terminal(GENERATE(In::opros, In::rtm), "wait_for_line");
    terminal.run();
    terminal.type("hullx\x7fo\n");
    CHECK(terminal.says("| line hullo, 90 columns\r\n"));
    terminal.resize(70);
    terminal.type("go\n");
    CHECK(terminal.says("| line go, 70 columns\r\n"));
    terminal.type("\x03");
    CHECK(terminal.says("code 0-"));
}

TEST_CASE("both hosts get each line of the terminal, which is shown once") {
    Terminal terminal(In::both, "wait_for_line");
    terminal.run();
    terminal.type("forward\n");
    CHECK(terminal.says("opros_host | line forward,"));
    CHECK(terminal.says("rtm_host   | line forward,"));
    CHECK(terminal.count("forward") == 3);
    terminal.type("\x03");
    CHECK(terminal.says("code 0-"));
}

TEST_CASE("a component that closes its input does not end its host") {
    Terminal terminal(GENERATE(In::opros, In::rtm), "close_input");
    terminal.run();
    CHECK(terminal.says("| cycle 100.\r\n")); // a second later
    terminal.type("\x03");
    CHECK(terminal.says("code 0-"));
}

TEST_CASE("the settings of the terminal are restored when a host or tandem run is ended by a signal") {
    Terminal terminal(In::opros, "wait_for_key");
    terminal.run();
    REQUIRE(terminal.answers("w", "| key w\r\n"));
    REQUIRE_FALSE(terminal.is_as_before());
    const int number = GENERATE(SIGKILL, SIGTERM, SIGHUP, SIGQUIT);
    CAPTURE(number);
    kill(number == SIGKILL ? terminal.pid_of("opros_host") : terminal.foreground(), number);
    CHECK(terminal.says(number == SIGKILL ? "code 1-" : "code 0-"));
    CHECK(terminal.is_as_before());
}

TEST_CASE("a host that is started again gets the keys of the terminal") {
    Terminal terminal(In::rtm, "wait_for_key");
    terminal.run(" --restart 1");
    REQUIRE(terminal.answers("w", "| key w\r\n"));
    kill(terminal.pid_of("rtm_host"), SIGKILL);
    REQUIRE(terminal.says("started again"));
    REQUIRE(terminal.says("all hosts are ready", terminal.output().find("started again")));
    terminal.type("a");
    CHECK(terminal.says("| key a\r\n"));
    terminal.type("\x03");
    CHECK(terminal.says("code 0-"));
}

TEST_CASE("Ctrl-Z gives the terminal back to the shell, and fg gives it to the components again") {
    Terminal terminal(In::opros, "wait_for_key");
    terminal.run();
    REQUIRE(terminal.answers("w", "| key w\r\n"));
    terminal.type("\x1a");
    REQUIRE(terminal.says("Stopped"));
    CHECK(terminal.is_as_before());
    terminal.type("echo typed to the $((1 + 1))nd program\n");
    CHECK(terminal.says("typed to the 2nd program"));
    terminal.type("fg\n");
    REQUIRE(terminal.is_taken());
    terminal.type("a");
    CHECK(terminal.says("| key a\r\n"));
    terminal.type("\x03");
    CHECK(terminal.says("all hosts have ended"));
    CHECK(terminal.says("\n$ ", terminal.output().find("all hosts have ended")));
    CHECK(terminal.is_as_before());
}

TEST_CASE("a run in the background leaves the terminal to the shell") {
    Terminal terminal(In::opros, "wait_for_key");
    terminal.run(" & :");
    CHECK(terminal.is_as_before());
    terminal.type("echo typed to the $((1 + 1))nd program\n");
    CHECK(terminal.says("typed to the 2nd program"));
    terminal.type("fg\n");
    REQUIRE(terminal.is_taken());
    terminal.type("a");
    CHECK(terminal.says("| key a\r\n"));
    terminal.type("\x03");
    CHECK(terminal.says("all hosts have ended"));
}

TEST_CASE("Ctrl-C ends a component that waits for input without a terminal") {
    Terminal terminal(GENERATE(In::opros, In::rtm), "wait_for_key");
    const std::string fifo = terminal.folder() / "input";
    REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
    const tandem::process::FileDescriptor writer(open(fifo.c_str(), O_RDWR | O_CLOEXEC)); // stays open
    terminal.run(" < " + fifo);
    terminal.type("\x03");
    CHECK(terminal.says("all hosts have ended"));
    CHECK(terminal.says("code 0-"));
    CHECK(terminal.count("does not return") == 0);
}
