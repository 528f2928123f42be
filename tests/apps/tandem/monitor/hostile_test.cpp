// SPDX-License-Identifier: Apache-2.0
// Hostile clients: broken requests and frames, many connections, readers that do not read. The monitor's memory stays bounded,
// it serves the next client, and the hosts are not affected. TANDEM_STRESS=N makes it longer, up to 10^5 attacks.
#include "http_client.hpp"

#include "shm/os/file_descriptor.hpp"
#include "shm/ring/ring_reader.hpp"
#include "shm/ring/ring_writer.hpp"

#include <nlohmann/json.hpp>

#include <netinet/in.h>
#include <random>
#include <stdexcept>
#include <sys/socket.h>
#include <system_error>

using namespace tandem::monitor::test;
using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr long max_memory_kb = 600 << 10; // the sanitizer keeps what is freed for a while, and its own tables
#else
constexpr long max_memory_kb = 200 << 10;
#endif

/// Bytes that no client should send, different for each number.
class Attacker {
  public:
    Attacker(const RunningMonitor& monitor, const std::string& link) : monitor_(monitor), link_(link) {}

    /// One connection, cut off at the end so that its port is free again.
    void attack() {
        const FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(monitor_.port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            throw std::system_error(errno, std::generic_category(), "connect");
        const linger cut{1, 0};
        setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &cut, sizeof cut);
        if (const int kind = below(8); kind < 3) {
            send(socket.get(), broken_request());
            if (kind == 0) answer(socket.get(), moment); // the others do not wait for one
            return;
        }
        send(socket.get(), upgrade());
        if (answer(socket.get(), {5, 0}).find("101") == std::string::npos) return;
        ++upgraded;
        for (int frames = 1 + below(3); frames > 0 && send(socket.get(), broken_frame()); --frames) {
        }
        if (below(4) == 0) answer(socket.get(), moment);
    }

    std::size_t upgraded = 0; ///< attacks that got as far as frames

  private:
    static constexpr timeval moment{0, 10'000};

    int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }
    std::string noise(int most) {
        std::string text(static_cast<std::size_t>(below(most)), '\0');
        for (char& c : text) c = static_cast<char>(below(256));
        return text;
    }
    /// A sound text with some bytes changed, repeated or cut off.
    std::string damaged(std::string text) {
        for (int i = below(4); i >= 0 && !text.empty(); --i) {
            const auto at = static_cast<std::size_t>(below(static_cast<int>(text.size())));
            if (const int how = below(3); how == 0)
                text[at] = static_cast<char>(below(256));
            else if (how == 1)
                text.insert(at, text.substr(at, 40));
            else
                text.resize(at);
        }
        return text;
    }
    std::string broken_request() {
        static const char* const paths[] = {"/", "/api/state", "/metrics", "/api/live", "/%00", "*"};
        static const char* const methods[] = {"GET", "POST", "CONNECT", "PRI"};
        if (below(4) == 0) return noise(600);
        return damaged(std::string(methods[below(4)]) + " " + paths[below(6)] + " HTTP/1.1\r\nHost: " +
                       monitor_.host() + "\r\nContent-Length: " + std::to_string(below(100)) +
                       "\r\nTransfer-Encoding: chunked\r\n\r\n" + noise(100));
    }
    std::string upgrade() {
        const std::string targets[] = {"/api/live", "/api/control", "/", "/?token=" + monitor_.token};
        const int target = below(4);
        return "GET " + targets[target] + " HTTP/1.1\r\nHost: " + monitor_.host() + "\r\nOrigin: http://" +
               monitor_.host() +
               "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
               (target >= 2 ? "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n" : "\r\n");
    }
    /// A frame of RFC 6455: mostly one whose payload is a damaged request, else one whose header is wrong.
    std::string broken_frame() {
        const std::string payloads[] = {
            R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":1},{"id":4294967296,"channelId":-1}]})",
            R"({"op":"unsubscribe","subscriptionIds":[0,0,"x",99999999999999999999]})",
            R"({"op":"subscribeConnectionGraph"})",
            R"({"token":")" + monitor_.token + R"("})",
            R"({"op":"drive","link":"x","x":1e999,"y":null})",
            R"({"op":"record","on":false,"links":[]})",
            std::string(3000, '['),
            R"({"op":"advertise","channels":[{"id":1,"topic":"/)" + link_ +
                R"(/speed","encoding":"json","schemaName":""}]})",
            R"({"op":"unadvertise","channelIds":[1,{},-1]})",
            R"({"op":"getParameters","parameterNames":["/)" + link_ + R"(/Plant/x",5],"id":"a"})",
            R"({"op":"setParameters","parameters":[{"name":"/)" + link_ +
                R"(/Plant/x","value":[[1]]}],"id":{}})",
            R"({"op":"subscribeParameterUpdates","parameterNames":["/x/y/z",""]})",
            std::string("\x01\x01\0\0\0[5]", 8),
            std::string("\x02\x01\0\0\0\x01\0\0\0\x04\0\0\0json{}", 19)};
        if (below(3) == 0) return header(below(16), below(256), below(2) == 0) + noise(300);
        const std::string payload = damaged(payloads[below(14)]);
        std::string frame = header(1 + below(2), static_cast<int>(payload.size()), true);
        return frame + payload; // masked with zeros
    }
    std::string header(int opcode, int length, bool mask) {
        std::string text{static_cast<char>((below(4) == 0 ? below(16) << 4 : 0x80) | opcode)};
        const int form = length < 126 ? length : 126;
        text += static_cast<char>((mask ? 0x80 : 0) | (below(16) == 0 ? 127 : form));
        if (form == 126) text += {static_cast<char>(length >> 8), static_cast<char>(length)};
        return mask ? text + std::string(4, '\0') : text;
    }
    /// Returns false if the server has closed the connection before it received all bytes.
    static bool send(int socket, const std::string& bytes) {
        for (std::size_t sent = 0; sent < bytes.size();) {
            const auto now = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (now < 0) return false;
            sent += static_cast<std::size_t>(now);
        }
        return true;
    }
    /// Returns the bytes that arrive within that time.
    static std::string answer(int socket, timeval bound) {
        char bytes[2000];
        setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &bound, sizeof bound);
        const auto got = recv(socket, bytes, sizeof bytes, 0);
        return got > 0 ? std::string(bytes, static_cast<std::size_t>(got)) : std::string();
    }

    const RunningMonitor& monitor_;
    const std::string link_;
    std::mt19937 random_{1}; // NOLINT(cert-msc51-cpp): the same attacks each time
};

/// A link whose port carries numbers, and what its reader gets of them.
struct RunningLink {
    Pair pair;
    std::vector<RingHandle> rings = add_ports(*pair.first, {"speed"});
    RingWriter writer{rings[0]};
    RingReader reader{*pair.second->find_ring(Side::first, tandem::link::ring_name("speed"))};
    double sent = 0;

    /// Whether a message gets through.
    bool works() {
        sent += 1;
        return writer.write(std::as_bytes(std::span(&sent, 1)), now_ns()) && reader.read() != nullptr;
    }
};

} // namespace

TEST_CASE("broken requests and frames neither end nor bloat the monitor, and its links continue") {
    RunningLink link;
    RunningMonitor monitor(link.pair.link.name, "--control");
    Attacker attacker(monitor, link.pair.link.name);
    const std::size_t attacks = stress(500, 100'000);
    std::size_t broken = 0;
    for (std::size_t i = 0; i < attacks; ++i) {
        attacker.attack();
        if (!link.works()) ++broken;
    }
    CHECK(broken == 0);
    CHECK(attacker.upgraded > attacks / 10);
    CHECK(monitor.runs());
    CHECK(eventually([&] { return get(monitor, "/").status == 200; }));
    CHECK(state(monitor)["links"][0]["name"] == link.pair.link.name);
    CHECK(state(monitor)["control"]["recording"] == "");
    CHECK(monitor.peak_kb() < max_memory_kb);
    if (attacks > 500)
        WARN(attacks << " attacks, " << attacker.upgraded << " with frames, peak " << monitor.peak_kb()
                     << " kB");
}

TEST_CASE("200 silent or half-open connections do not block other clients") {
    RunningLink link;
    RunningMonitor monitor(link.pair.link.name);
    std::vector<std::unique_ptr<Connection>> connections;
    for (int i = 0; i < 200; ++i) {
        connections.push_back(std::make_unique<Connection>(monitor));
        try {
            if (i % 2 == 0) connections.back()->send("GET / HTTP/1.1\r\nHost: ");
        } catch (const std::runtime_error&) { // cut off already
        }
        if (i % 20 == 0) CHECK(get(monitor, "/").status == 200);
    }
    CHECK(link.works());
    CHECK(get(monitor, "/").status == 200);
    CHECK(connections[1]->answer().status == 429); // it had to give way
    CHECK(monitor.peak_kb() < max_memory_kb);
    CHECK(monitor.runs());
}

TEST_CASE("slow readers of a big link, as many as one user may have, cost bounded memory") {
    const Pair pair(small(8 << 20));
    std::vector<std::string> names;
    for (int i = 0; i < 400; ++i) names.push_back("port" + std::to_string(i));
    add_ports(*pair.first, names);
    RunningMonitor monitor(pair.link.name);
    std::vector<std::unique_ptr<Live>> slow;
    for (int i = 0; i < 23; ++i) slow.push_back(std::make_unique<Live>(monitor, 4096));
    Live page(monitor);
    for (int i = 0; i < 20; ++i) CHECK(page.next()["links"][0]["ports"].size() == 400);
    CHECK(monitor.peak_kb() < max_memory_kb);
    CHECK(monitor.runs());
}
