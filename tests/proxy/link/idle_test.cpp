// SPDX-License-Identifier: Apache-2.0
// The threads of an idle link sleep, and wake up for each event.
#include "tests/proxy/link/link_side.hpp"

#include "proxy/link/protocol/control.hpp"
#include "tests/support/context_switches.hpp"

#include <algorithm>
#include <fcntl.h>
#include <map>
#include <sys/mman.h>

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;

namespace {

/// Both sides, of which the first has an event-driven consumer.
struct IdleLink {
    explicit IdleLink(const std::string& what)
        : name(unique_name(what)), a(adaptor(name)), b(interceptor(name)) {
        b->on_call = [this](const Request& request) {
            if (request.operation != control::listen) return Reply{CallStatus::ok, bytes_of("done")};
            for (const auto& port : control::decode_port_names(request.arguments))
                b->link.writer(port).set_peer_listens(true);
            return Reply{};
        };
        a->link.open();
        b->link.open();
        wait_until_up(*a, *b);
    }
    void listen() {
        a->link.set_arrival_listener(a->link.reader("reference"), [this] { ++arrivals; });
        REQUIRE(a->link.request_rings({"reference"}, soon).status == CallStatus::ok);
    }
    bool works() {
        const int before = arrivals;
        return send(b->link.writer("reference"), 1) && eventually([&] { return arrivals > before; }) &&
               a->link.call({"p", "o", "", {}}, soon).text() == "done";
    }

    const std::string name;
    std::unique_ptr<LinkSide> a, b;
    std::atomic<int> arrivals{0};
};

/// Context switches of the link's threads in this process, by thread.
std::map<std::string, long> count_switches() {
    auto counts = tandem::test::count_context_switches(getpid());
    std::erase_if(counts, [](const auto& thread) { return !thread.first.starts_with("tandem-"); });
    return counts;
}

} // namespace

TEST_CASE("the threads of an idle link are not woken, even after work or while the peer is away") {
    IdleLink link("idle");
    const std::string after = GENERATE("joining", "listening", "work", "the peer's departure");
    CAPTURE(after);
    if (after != "joining") link.listen();
    if (after == "work") REQUIRE(link.works());
    if (after == "the peer's departure") {
        link.b.reset();
        REQUIRE(eventually([&] { return link.a->went == 1; }));
    }
    // Supervisor, worker, tasks. Each gives itself its name once it runs.
    const std::size_t threads = after == "the peer's departure" ? 3 : 6;
    CHECK(eventually([&] { return count_switches().size() >= threads; }));
    // An event has consequences for a second, see PeerSupervisor; a loaded machine delays them.
    CHECK(eventually([] {
        const auto before = count_switches();
        std::this_thread::sleep_for(1500ms); // longer than any period that these threads have had
        return count_switches() == before;
    }));
    if (link.b && after != "joining") CHECK(link.works());
}

TEST_CASE("an idle link whose file is truncated, superseded or removed joins the next generation and works") {
    IdleLink link("lost");
    const std::string path = shm::segment_path(link.name, shm::list_generations(link.name).at(0));
    SECTION("truncated to nothing") { REQUIRE(truncate(path.c_str(), 0) == 0); }
    SECTION("truncated after the headers") {
        REQUIRE(truncate(path.c_str(), shm::layout::arenas_begin) == 0);
    }
    SECTION("removed") { REQUIRE(unlink(path.c_str()) == 0); }
    CHECK(eventually([&] { return link.a->downs == 1 && link.b->downs == 1; }));
    CHECK(eventually([&] { return link.a->link.is_up() && link.b->link.is_up(); }));
    link.listen();
    CHECK(link.works());
}

TEST_CASE("a message sent before the peer rings for its port is noticed when the ringing starts") {
    IdleLink link("before");
    REQUIRE(send(link.b->link.writer("reference"), 1));
    link.listen();
    CHECK(eventually([&] { return link.arrivals == 1; }));
}

TEST_CASE("a ring that another process damages while it is idle takes the link down with the next message") {
    IdleLink link("damaged");
    const std::string path = shm::segment_path(link.name, shm::list_generations(link.name).at(0));
    {
        // The ring "reference" lies at the beginning of the second side's arena; another process would map it, too.
        const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
        REQUIRE(fd >= 0);
        const auto bytes = static_cast<std::size_t>(std::filesystem::file_size(path));
        void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
        REQUIRE(memory != MAP_FAILED);
        const auto* const header = static_cast<const shm::layout::SegmentHeader*>(memory);
        auto* const ring = static_cast<char*>(memory) + header->arena_offset[1];
        std::fill(ring, ring + 65536, '\x5b');
        munmap(memory, bytes);
        ::close(fd);
    }
    CHECK(eventually([&] {
        send(link.b->link.writer("reference"), 1);
        receive(link.a->link.reader("reference"));
        return link.a->downs + link.b->downs > 0;
    }));
    CHECK(eventually([&] { return link.a->link.is_up() && link.b->link.is_up(); }));
    link.listen();
    CHECK(link.works());
}
