// SPDX-License-Identifier: Apache-2.0
// `tandem monitor` as a child process, and a client of its WebSockets. Without a header of Boost: all of them together take longer
// to compile than the tests that include this one.
#pragma once
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "tests/apps/tandem/program.hpp"

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <unistd.h>
#include <vector>

namespace tandem::monitor::test {

/// The program, showing one link, at a port that the kernel has chosen.
class RunningMonitor {
  public:
    /// `more`: further options. `errors`: descriptor for its standard error.
    explicit RunningMonitor(const std::string& link, const std::vector<std::string>& more = {},
                            int errors = STDERR_FILENO) {
        int ends[2];
        REQUIRE(pipe(ends) == 0);
        std::vector<const char*> arguments{TANDEM_PROGRAM, "monitor", link.c_str(), "--port", "0"};
        for (const auto& option : more) arguments.push_back(option.c_str());
        arguments.push_back(nullptr);
        child_ = std::make_unique<shm::test::Child>([&] {
            dup2(ends[1], 1);
            dup2(errors, STDERR_FILENO);
            ::close(ends[0]);
            ::close(ends[1]);
            execv(TANDEM_PROGRAM, const_cast<char* const*>(arguments.data()));
            return 98;
        });
        ::close(ends[1]);
        std::string url;
        for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) url += c;
        ::close(ends[0]);
        INFO(url);
        REQUIRE(url.rfind("http://127.0.0.1:", 0) == 0);
        port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
        if (const auto at = url.find("#token="); at != std::string::npos) token = url.substr(at + 7);
    }
    RunningMonitor(const std::string& link, const char* option)
        : RunningMonitor(link, std::vector<std::string>{option}) {}
    std::string host() const { return "127.0.0.1:" + std::to_string(port); }
    bool runs() { return !child_->ended(); }
    pid_t pid() const { return child_->pid(); }
    /// Memory that the process has used at most, kB.
    long peak_kb() const {
        std::ifstream file("/proc/" + std::to_string(child_->pid()) + "/status");
        for (std::string word; file >> word;)
            if (word == "VmHWM:") return file >> word, std::stol(word);
        return -1;
    }

    std::uint16_t port = 0;
    std::string token; ///< with --control

  private:
    std::unique_ptr<shm::test::Child> child_;
};

/// A page's WebSocket. `receive_buffer`: bytes that the kernel keeps for it, 0: as many as it likes.
class Live {
  public:
    explicit Live(const RunningMonitor& monitor, int receive_buffer = 0,
                  const std::string& target = "/api/live", const std::string& protocol = "");
    ~Live();
    nlohmann::json next();
    void send(const std::string& text);
    void send_binary(const std::string& bytes);

  private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

inline void publish_table(shm::Segment& side, const link::PortTable& table) {
    const auto bytes = link::encode(table);
    link::write_published_table(
        side.add_blob(link::table_name, link::published_table_bytes(bytes.size(), false)), bytes, 1);
    side.publish();
}

/// Publishes data ports of these names and signatures, whose messages the first side sends. Returns their rings.
inline std::vector<shm::RingHandle> add_ports(shm::Segment& first, const std::vector<std::string>& names,
                                              const std::string& signature = "d") {
    link::PortTable table;
    table.model = "OPRoS";
    std::vector<shm::RingHandle> rings;
    table.components.push_back({"Plant"});
    for (const auto& name : names) {
        link::Port port;
        port.kind = link::PortKind::data_out;
        port.name = name;
        port.type = "Number";
        port.signature = signature;
        port.component = "Plant";
        table.ports.push_back(port);
        rings.push_back(first.add_ring(link::ring_name(name), {.max_record = 100, .capacity = 4096}));
    }
    publish_table(first, table);
    return rings;
}

} // namespace tandem::monitor::test
