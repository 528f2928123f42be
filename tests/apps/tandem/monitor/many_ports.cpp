// SPDX-License-Identifier: Apache-2.0
// many_ports NAME LINKS PORTS RATE [refuse]: a system of LINKS x PORTS data ports, NAME-0, NAME-1 ..., for the test of the page. The
// first sides are in this process, the second ones in a child; each port sends RATE messages a second. With `refuse` the child
// has not connected sensor0, and the type of a further port is unknown to it. Ends with its standard input.
#include "host/process/published/refused_connections.hpp"
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"
#include "shm/segment.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <csignal>
#include <poll.h>

namespace {

using namespace tandem;

volatile std::sig_atomic_t ended = 0; // by SIGTERM

shm::JoinOptions sparse() {
    shm::JoinOptions options;
    options.arena_bytes = 8 << 20;
    options.sparse = true;
    return options;
}

std::unique_ptr<shm::Segment> join(const std::string& name, shm::Side side) {
    return shm::Segment::join(name, side, sparse());
}

/// The link's ports belong to five components of the first side, which sends all messages.
std::vector<shm::RingHandle> add_ports(shm::Segment& first, int ports, bool refuse) {
    link::PortTable table;
    std::vector<shm::RingHandle> rings;
    for (int i = 0; i < 5; ++i) table.components.push_back({"Plant" + std::to_string(i)});
    for (int i = 0; i < ports; ++i) {
        link::Port port;
        port.kind = link::PortKind::data_out;
        port.name = "sensor" + std::to_string(i);
        port.type = "Reading";
        port.signature = "{value}d{count}u";
        port.component = "Plant" + std::to_string(i % 5);
        table.ports.push_back(port);
        rings.push_back(first.add_ring(link::ring_name(port.name), {.max_record = 100, .capacity = 16384}));
    }
    if (refuse) {
        link::Port port;
        port.kind = link::PortKind::data_out;
        port.name = "camera";
        port.type = "Picture";
        port.signature = "?{Picture cannot cross the link: give it save() and load()}";
        port.component = "Plant0";
        table.ports.push_back(port);
    }
    const auto bytes = link::encode(table);
    link::write_published_table(
        first.add_blob(link::table_name, link::published_table_bytes(bytes.size(), false)), bytes, 1);
    first.publish();
    return rings;
}

bool input_has_ended() {
    pollfd input{0, POLLIN, 0};
    char byte = 0;
    return poll(&input, 1, 0) > 0 && read(0, &byte, 1) <= 0;
}

void receive(const std::string& name, int links, int ports, bool refuse) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::optional<process::OwnRefusedConnection> refused;
    if (refuse)
        refused.emplace(
            "Plant0.sensor0", "Logger0.level",
            "rtc.conf:12: type mismatch: port 'sensor0' has signature '{value}d{count}u', Logger0.level "
            "has 'f'; member value is double there and float here");
    std::vector<std::unique_ptr<shm::Segment>> sides;
    std::vector<std::unique_ptr<shm::RingReader>> readers;
    for (int i = 0; i < links; ++i) {
        sides.push_back(join(name + "-" + std::to_string(i), shm::Side::second));
        sides.back()->publish();
        for (int j = 0; j < ports; ++j)
            readers.push_back(std::make_unique<shm::RingReader>(
                *sides.back()->find_ring(shm::Side::first, link::ring_name("sensor" + std::to_string(j)))));
    }
    while (ended == 0) {
        for (auto& reader : readers)
            while (reader->read()) {
            }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

int run(const std::string& name, int links, int ports, int rate, bool refuse) {
    std::vector<std::unique_ptr<shm::Segment>> sides;
    std::vector<shm::RingWriter> writers;
    for (int i = 0; i < links; ++i) {
        sides.push_back(join(name + "-" + std::to_string(i), shm::Side::first));
        for (const auto& ring : add_ports(*sides.back(), ports, refuse)) writers.emplace_back(ring);
    }
    const pid_t child = fork();
    if (child == 0) {
        receive(name, links, ports, refuse);
        _exit(0); // without the ends of the other side
    }
    std::printf("%zu ports\n", writers.size());
    std::fflush(stdout);
    auto next = std::chrono::steady_clock::now();
    for (std::uint32_t count = 0; ended == 0 && !input_has_ended(); ++count) {
        std::vector<std::byte> bytes;
        wire::CdrWriter out(bytes);
        out.put(std::sin(count / 50.0));
        out.put(count);
        for (auto& writer : writers) writer.write(bytes, wire::wall_clock_stamp());
        next += std::chrono::microseconds(1'000'000 / rate);
        std::this_thread::sleep_until(next);
    }
    kill(child, SIGTERM);
    waitpid(child, nullptr, 0);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 5 && argc != 6) return 2;
    std::signal(SIGTERM,
                [](int) { ended = 1; }); // both processes leave their links, so that no segment stays
    try {
        return run(argv[1], std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]), argc == 6);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "many_ports: %s\n", error.what());
        return 1;
    }
}
