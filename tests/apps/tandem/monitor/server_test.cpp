// SPDX-License-Identifier: Apache-2.0
#include "http_client.hpp"
#include "pattern.hpp"

#include <filesystem>
#include <set>
#include <unistd.h>

using namespace tandem::monitor::test;
using namespace tandem::shm::test;
using tandem::test::tandem_program;

TEST_CASE("the page and its scripts come from the server alone") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name);
    const Answer page = get(monitor, "/");
    CHECK(page.status == 200);
    CHECK(page.type == "text/html; charset=utf-8");
    CHECK(page.field("Content-Security-Policy").find("default-src 'self'") == 0);
    CHECK(page.body.find("//") == std::string::npos); // no address of another host
    CHECK(get(monitor, "/app.js").type == "text/javascript; charset=utf-8");
    CHECK(get(monitor, "/style.css").type == "text/css; charset=utf-8");
    // Each module that a script imports is served, and the page requests it directly instead of after the script has arrived.
    std::set<std::string> modules{"app"};
    std::vector<std::string> to_look_at{"app"};
    while (!to_look_at.empty()) {
        const std::string name = to_look_at.back();
        to_look_at.pop_back();
        INFO(name);
        const Answer module = get(monitor, "/" + name + ".js");
        CHECK(module.status == 200);
        CHECK((name == "app" ||
               page.body.find("<link rel=\"modulepreload\" href=\"" + name + ".js\">") != std::string::npos));
        const Pattern import("from '(\\.\\.?/[A-Za-z0-9_/]+)\\.js'");
        std::size_t at = 0;
        for (auto found = import.find(module.body, at); !found.empty();
             found = import.find(module.body, at)) {
            const std::string imported =
                (std::filesystem::path(name).parent_path() / found[1]).lexically_normal().string();
            if (modules.insert(imported).second) to_look_at.push_back(imported);
        }
    }
    std::size_t links = 0, after = 0;
    for (const Pattern link("rel=\"modulepreload\""); !link.find(page.body, after).empty();) ++links;
    // All but app.js, which the page runs, and lib/elk-api.js, which graph/elk.js loads.
    CHECK(links == modules.size());
    // A reverse proxy may show the page in a folder, so that no address begins at the root.
    std::size_t begin = 0;
    CHECK(Pattern("(href|src)=\"/").find(page.body, begin).empty());
}

TEST_CASE("only GET requests for existing pages are served") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name);
    for (const char* method : {"POST", "PUT", "DELETE", "HEAD", "OPTIONS"}) {
        INFO(method);
        Connection connection(monitor);
        connection.send(std::string(method) + " /api/state HTTP/1.1\r\nHost: " + monitor.host() +
                        "\r\nContent-Length: 2\r\n\r\n{}");
        const Answer answer = connection.answer();
        if (std::string(method) != "HEAD") CHECK(answer.status == 405);
        if (answer.status != 0) CHECK(answer.field("Allow") == "GET");
    }
    CHECK(get(monitor, "/etc/passwd").status == 404);
    CHECK(get(monitor, "/../../../../etc/passwd").status == 404);
    CHECK(get(monitor, "/%2e%2e/CMakeCache.txt").status == 404);
    CHECK(get(monitor, "/api/live").status == 426);
    CHECK(get(monitor, "/api/state", "GET", "Content-Length: 3\r\n").status == 413);
    CHECK(monitor.runs());
}

TEST_CASE("broken, too long and endless requests get a refusal or no answer") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name);
    const auto answer_to = [&](const std::string& bytes) {
        Connection connection(monitor);
        connection.send(bytes);
        return connection.answer().status;
    };
    CHECK(answer_to("nonsense\r\n\r\n") == 400);
    CHECK(answer_to("GET / HTTP/9.9\r\n\r\n") == 400);
    CHECK(answer_to(std::string("\x16\x03\x01\0\xff\r\n\r\n", 9)) == 400);
    CHECK(answer_to("GET / HTTP/1.1\r\nHost\r\n\r\n") == 400);
    CHECK(answer_to("GET / HTTP/1.1\r\nX: " + std::string(100'000, 'a')) == 431);
    CHECK(answer_to("GET /" + std::string(100'000, 'a')) == 431);
    CHECK(answer_to("GET / HTTP/1.1\r\nHost: " + monitor.host()) == 0); // closed after the time-out
    CHECK(get(monitor, "/").status == 200);
}

TEST_CASE("pages of other hosts get neither the state nor a WebSocket") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name);
    const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    const auto status = [&](const std::string& origin) {
        return get(monitor, "/api/live", "GET", upgrade + origin).status;
    };
    CHECK(status("") == 403);
    CHECK(status("Origin: http://example.org\r\n") == 403);
    CHECK(status("Origin: http://" + monitor.host() + ".example.org\r\n") == 403);
    CHECK(status("Origin: null\r\n") == 403);
    CHECK(Live(monitor).next()["links"].size() == 1);
}

namespace {

/// Returns the answer to a request whose headers are these.
Answer get_with(const RunningMonitor& monitor, const std::string& target, const std::string& headers) {
    Connection connection(monitor);
    connection.send("GET " + target + " HTTP/1.1\r\n" + headers + "\r\n");
    return connection.answer();
}

} // namespace

TEST_CASE("a name of another site that leads to this machine gets nothing, at whatever address it arrives") {
    const Pair pair;
    const std::string bind = GENERATE("127.0.0.1", "0.0.0.0");
    INFO(bind);
    const RunningMonitor monitor(pair.link.name, {"--bind", bind, "--control"});
    const std::string port = ":" + std::to_string(monitor.port),
                      upgrade =
                          "Origin: http://example.org" + port +
                          "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    for (const char* path :
         {"/", "/app.js", "/api/state", "/metrics", "/api/live", "/api/control", "/none"}) {
        INFO(path);
        for (const std::string& more : {std::string(), upgrade}) {
            const Answer answer = get_with(monitor, path, "Host: example.org" + port + "\r\n" + more);
            CHECK(answer.status == 403);
            CHECK_THAT(answer.body, Catch::Contains("--allow-host"));
        }
    }
    const std::string foxglove = upgrade + "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n";
    CHECK(get_with(monitor, "/", "Host: example.org" + port + "\r\n" + foxglove).status == 403);
    char name[256] = {};
    REQUIRE(gethostname(name, sizeof name - 1) == 0);
    CHECK(get_with(monitor, "/api/state", "Host: " + std::string(name) + port + "\r\n").status == 403);
    CHECK(get_with(monitor, "/api/state", "").status == 403);
    CHECK(get_with(monitor, "/api/state", "Host: localhost\r\nHost: example.org\r\n").status == 403);
    for (const char* host : {"localhost", "127.0.0.1", "[::1]"})
        CHECK(get_with(monitor, "/api/state", "Host: " + (host + port) + "\r\n").status == 200);
}

TEST_CASE("the option --allow-host lets clients use further names, including for WebSockets") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name, {"--allow-host", "robot.local", "--allow-host", "10.0.0.9"});
    const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    CHECK(get_with(monitor, "/metrics", "Host: robot.local:8080\r\n").status == 200);
    CHECK(get_with(monitor, "/", "Host: 10.0.0.9\r\n").status == 200);
    CHECK(get_with(monitor, "/", "Host: arm.local\r\n").status == 403);
    CHECK(get_with(monitor, "/api/live", "Host: robot.local\r\nOrigin: http://example.org\r\n" + upgrade)
              .status == 403);
    CHECK(get_with(monitor, "/api/live", "Host: robot.local\r\nOrigin: http://robot.local\r\n" + upgrade)
              .status == 101);
}

TEST_CASE("a port in use or a foreign address ends the monitor with one line") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name);
    const auto refused = [](const std::vector<std::string>& options, const std::string& part) {
        std::vector<std::string> arguments{"monitor"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto result = tandem_program(arguments);
        INFO(result.errors);
        CHECK(result.exit_code == 1);
        CHECK(result.output.empty());
        CHECK_THAT(result.errors, Catch::Contains(part));
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    };
    refused({"--port", std::to_string(monitor.port)},
            "port " + std::to_string(monitor.port) + ": Address already in use");
    refused({"--port", "0", "--bind", "203.0.113.7"}, "203.0.113.7");
    refused({"--port", "0", "--bind", "localhost."}, "expected an address such as 127.0.0.1 or ::1");
    refused({"--port", "0", "--allow-host", "http://robot"},
            "--allow-host http://robot: expected a host name");
    CHECK(tandem_program({"monitor", "--port", "65536"}).exit_code != 0);
}
