// SPDX-License-Identifier: Apache-2.0
// Clients that take all places, and the clients that they keep out. Only root can create processes of other users. Other users
// skip the cases that need them, with one line.
#include "http_client.hpp"

#include "apps/tandem/monitor/web/places.hpp"
#include "shm/os/file_descriptor.hpp"
#include "tests/support/skip.hpp"

#include <grp.h>
#include <sys/mman.h>
#include <unistd.h>

using namespace tandem::monitor::test;
using namespace tandem::shm::test;
using tandem::monitor::Places;
using tandem::shm::FileDescriptor;

namespace {

/// Opens WebSockets until the monitor refuses one, at most `most`.
std::vector<std::unique_ptr<Live>> open_all(const RunningMonitor& monitor, std::size_t most = 100,
                                            const std::string& target = "/api/live") {
    std::vector<std::unique_ptr<Live>> pages;
    try {
        while (pages.size() < most) pages.push_back(std::make_unique<Live>(monitor, 0, target));
    } catch (const std::exception&) { // refused
    }
    return pages;
}

/// A process of another user that holds all WebSockets that it gets, until the end of the object.
class OtherUser {
  public:
    OtherUser(const RunningMonitor& monitor, uid_t user) {
        int ends[2];
        REQUIRE(pipe(ends) == 0);
        child_ = std::make_unique<Child>([&] {
            if (setgroups(0, nullptr) != 0 || setgid(user) != 0 || setuid(user) != 0) return 97;
            const auto pages = open_all(monitor);
            const auto count = static_cast<unsigned char>(pages.size());
            if (write(ends[1], &count, 1) != 1) return 96;
            for (;;) pause();
            return 0;
        });
        ::close(ends[1]);
        unsigned char count = 0;
        const bool told = read(ends[0], &count, 1) == 1;
        ::close(ends[0]);
        REQUIRE(told);
        held = count;
    }
    std::size_t held = 0; ///< WebSockets

  private:
    std::unique_ptr<Child> child_;
};

const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// Returns the answer to a request for a WebSocket.
Answer ask_for_page(const RunningMonitor& monitor, const std::string& target = "/api/live") {
    return get(monitor, target, "GET", upgrade + "Origin: http://" + monitor.host() + "\r\n");
}

constexpr auto only_root = "only root can start processes of other users";

} // namespace

TEST_CASE("the number of a user's WebSockets is limited, and pages and metrics are still served") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name);
    auto pages = open_all(monitor);
    CHECK(pages.size() == Places::max_of_a_peer);
    const Answer refused = ask_for_page(monitor);
    CHECK(refused.status == 429);
    CHECK_THAT(refused.body, Catch::Contains("close one"));
    CHECK(std::count(refused.body.begin(), refused.body.end(), '\n') == 1);
    for (const char* path : {"/", "/app.js", "/api/state", "/metrics"})
        CHECK(get(monitor, path).status == 200);
    CHECK(pages.back()->next()["links"].size() == 1);
    pages.clear();
    CHECK(eventually([&] { return ask_for_page(monitor).status == 101; }));
    CHECK(monitor.runs());
}

TEST_CASE("the first refused connection is logged with its user") {
    const Pair pair;
    const FileDescriptor errors(memfd_create("errors", MFD_CLOEXEC));
    const RunningMonitor monitor(pair.link.name, std::vector<std::string>{}, errors.get());
    const auto pages = open_all(monitor);
    for (int i = 0; i < 40; ++i) CHECK(ask_for_page(monitor).status == 429);
    std::string text(10'000, '\0');
    text.resize(
        static_cast<std::size_t>(std::max<ssize_t>(0, pread(errors.get(), text.data(), text.size(), 0))));
    CHECK_THAT(text, Catch::Contains("tandem: refused a connection of user ") &&
                         Catch::Contains("(" + std::to_string(geteuid()) + ") at 127.0.0.1:"));
    CHECK(std::count(text.begin(), text.end(), '\n') < 10);
}

TEST_CASE("the holder of the token gets a page although all places are taken") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name, "--control");
    const auto pages = open_all(monitor);
    CHECK(ask_for_page(monitor, "/api/live?token=" + std::string(32, '0')).status == 429);
    const auto own = open_all(monitor, 100, "/api/live?token=" + monitor.token);
    CHECK(own.size() == Places::reserved);
    CHECK(own.back()->next()["links"].size() == 1);
}

TEST_CASE("another user cannot keep this user out") {
    if (geteuid() != 0) TANDEM_SKIP(only_root);
    const Pair pair;
    const RunningMonitor monitor(pair.link.name);
    const OtherUser other(monitor, 65534);
    CHECK(other.held == Places::max_of_a_peer);
    CHECK(Live(monitor).next()["links"].size() == 1);
}

TEST_CASE("many other users cannot keep out the holder of the token") {
    if (geteuid() != 0) TANDEM_SKIP(only_root);
    const Pair pair;
    const RunningMonitor monitor(pair.link.name, "--control");
    const OtherUser first(monitor, 65534), second(monitor, 65533), third(monitor, 65532);
    CHECK(first.held + second.held + third.held == Places::max_open);
    const Answer refused = ask_for_page(monitor);
    CHECK(refused.status == 503);
    CHECK(get(monitor, "/").status == 200);
    Live page(monitor, 0, "/api/live?token=" + monitor.token),
        control(monitor, 0, "/api/control?token=" + monitor.token),
        foxglove(monitor, 0, "/?token=" + monitor.token, "foxglove.websocket.v1");
    CHECK(page.next()["links"].size() == 1);
    control.send(R"({"token":")" + monitor.token + R"("})");
    CHECK(control.next()["ok"] == true);
    CHECK(foxglove.next()["op"] == "serverInfo");
}
