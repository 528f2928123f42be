// SPDX-License-Identifier: Apache-2.0
// Which clients may control, and which requests are valid. browser/drive_test.mjs drives.
#include "http_client.hpp"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace tandem::monitor::test;
using namespace tandem::shm::test;

namespace {

const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// A client at /api/control that has shown its token.
struct Controller : Live {
    explicit Controller(const RunningMonitor& monitor) : Live(monitor, 0, "/api/control") {
        CHECK(ask({{"token", monitor.token}})["ok"] == true);
    }
    nlohmann::json ask(const nlohmann::json& request) {
        send(request.dump());
        return next();
    }
};

/// The child process of a process; 0: there is none.
pid_t find_child(pid_t parent) {
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        std::ifstream status(entry.path() / "status");
        for (std::string line; std::getline(status, line);)
            if (line == "PPid:\t" + std::to_string(parent)) return std::stoi(entry.path().filename());
    }
    return 0;
}

} // namespace

TEST_CASE("without --control the monitor is read-only") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name);
    CHECK(monitor.token.empty());
    CHECK(get(monitor, "/api/control", "GET", upgrade + "Origin: http://" + monitor.host() + "\r\n").status ==
          403);
    CHECK(state(monitor)["control"]["allowed"] == false);
}

TEST_CASE("pages of other hosts cannot control, even with the token") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name, "--control");
    for (const char* origin : {"", "Origin: http://example.org\r\n", "Origin: null\r\n"})
        CHECK(get(monitor, "/api/control", "GET", upgrade + origin).status == 403);
    CHECK(get(monitor, "/api/control").status == 426);
    CHECK(Controller(monitor).ask({{"op", "?"}})["ok"] == false);
}

TEST_CASE("a client with a wrong token is disconnected, and its requests are not carried out") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    REQUIRE(monitor.token.size() == 32);
    const std::string wrong[] = {R"({"token":""})",
                                 R"({"token":")" + monitor.token.substr(1) + R"("})",
                                 R"({"token":")" + monitor.token + R"(0"})",
                                 R"({"token":")" + std::string(32, '0') + R"("})",
                                 R"({"token":17})",
                                 R"({"op":"rtm","command":"list"})",
                                 "nonsense"};
    for (const auto& hello : wrong) {
        INFO(hello);
        Live client(monitor, 0, "/api/control");
        client.send(hello);
        CHECK(client.next() == nlohmann::json{{"op", "token"}, {"ok", false}});
        CHECK_THROWS(client.next());
    }
    CHECK(state(monitor)["control"]["recording"] == "");
    CHECK(get(monitor, "/api/state").body.find(monitor.token) == std::string::npos);
    CHECK(monitor.runs());
}

TEST_CASE("two monitors have two tokens") {
    const Pair pair;
    CHECK(RunningMonitor(pair.link.name, "--control").token !=
          RunningMonitor(pair.link.name, "--control").token);
}

TEST_CASE(
    "malformed requests and arguments that look like options are refused, and the next request is answered") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    Controller client(monitor);
    const nlohmann::json refused[] = {
        {{"op", "exit"}},
        {{"op", "rtm"}},
        {{"op", 5}},
        {{"op", "rtm"}, {"command", "exit"}, {"arguments", {"A0"}}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", {"--help"}}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", nlohmann::json::array()}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", {std::string(400, 'a')}}},
        {{"op", "rtm"}, {"command", "conf"}, {"arguments", {"A0", "x=\n"}}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", "A0"}},
        {{"op", "record"}, {"on", true}, {"links", {"-o"}}},
        {{"op", "opros"}, {"command", "new"}, {"arguments", {"A"}}},
        {{"op", "rtm"}, {"command", "connect"}, {"arguments", {"a.b", "c.d"}}, {"properties", {"--help"}}},
        {{"op", "rtm"}, {"command", "conf"}, {"arguments", {"A0"}}, {"set", "-x"}},
        {{"op", "rtm"}, {"command", "disconnect"}, {"arguments", {"a.b"}}, {"connection", 5}},
        {{"op", "drive"}, {"link", pair.link.name}, {"x", 0}, {"y", 900}},
        {{"op", "drive"}, {"link", "?"}, {"x", "left"}, {"y", 900}},
        nlohmann::json::array(),
    };
    for (auto request : refused) {
        if (request.is_object()) request["id"] = 5; // by which the client knows what was refused
        INFO(request.dump());
        const auto reply = client.ask(request);
        CHECK(reply["ok"] == false);
        if (request.is_object()) CHECK(reply["id"] == 5);
    }
    const auto answered =
        client.ask({{"op", "rtm"}, {"id", 7}, {"command", "activate"}, {"arguments", {"NoSuchComponent0"}}});
    CHECK(answered["id"] == 7);
    CHECK(answered["ok"] == false);
    CHECK_THAT(answered["text"].get<std::string>(), Catch::Contains("NoSuchComponent0"));
    const auto library = client.ask({{"op", "opros"}, {"command", "info"}, {"arguments", {"/tmp/X.so"}}});
    CHECK(library["text"] == "unknown command: info"); // it would run the library's code
    // Longer than a request may be: the monitor closes the connection, perhaps before all has been sent.
    CHECK_THROWS((client.send(std::string(20'000, 'x')), client.next()));
    CHECK(monitor.runs());
}

TEST_CASE("too deeply nested JSON from a Foxglove client with the token is refused, and the next request is "
          "answered") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    Live client(monitor, 0, "/?token=" + monitor.token, "foxglove.websocket.v1");
    CHECK(client.next()["capabilities"].size() == 5);
    const auto answer = [&](const std::string& request) {
        client.send(request);
        for (auto message = client.next();; message = client.next())
            if (message["op"] == "status" || message["op"] == "parameterValues") return message.dump();
    };
    const std::string deep(100'000, '['), end(100'000, ']');
    CHECK_THAT(
        answer(R"({"op":"setParameters","parameters":[{"name":"/a/b/c","value":)" + deep + end + "}]}"),
        Catch::Contains("64 levels"));
    CHECK_THAT(answer(deep), Catch::Contains("64 levels"));
    CHECK_THAT(answer("{"), Catch::Contains("expected JSON"));
    CHECK_THAT(answer(R"({"op":"advertise","channels":5})"), Catch::Contains("expected "));
    CHECK_THAT(answer(R"({"op":"setParameters","parameters":[{"name":"/a/b/c","value":1}]})"),
               Catch::Contains("unknown component of a link"));
    CHECK_THAT(answer(R"({"op":"getParameters","parameterNames":[],"id":"7"})"),
               Catch::Contains(R"("parameters":[])"));
    CHECK(monitor.runs());
}

TEST_CASE("a recording of a link that does not exist is refused") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    Controller client(monitor);
    const auto reply =
        client.ask({{"op", "record"}, {"on", true}, {"links", {pair.link.name, "no-such-link"}}});
    CHECK(reply["ok"] == false);
    CHECK(reply["text"] == "link 'no-such-link' does not exist; tandem shm list shows existing links");
    CHECK(state(monitor)["control"]["recording"] == "");
}

TEST_CASE("without names, all links that the monitor shows are recorded, even if they are more than a "
          "request may name") {
    std::vector<std::unique_ptr<Pair>> pairs;
    std::vector<std::string> names;
    for (int i = 0; i < 17; ++i) names.push_back(pairs.emplace_back(std::make_unique<Pair>())->link.name);
    std::vector<std::string> more(names.begin() + 1, names.end());
    more.emplace_back("--control");
    RunningMonitor monitor(names.front(), more);
    Controller client(monitor);
    const auto refused = client.ask({{"op", "record"}, {"on", true}, {"links", names}});
    CHECK(refused["ok"] == false);
    CHECK_THAT(refused["text"].get<std::string>(),
               Catch::Contains("names 17 links, but at most 16 are allowed"));
    const auto reply = client.ask({{"op", "record"}, {"on", true}});
    REQUIRE(reply["ok"] == true);
    const auto recorder = find_child(monitor.pid());
    REQUIRE(recorder > 0);
    std::ifstream file("/proc/" + std::to_string(recorder) + "/cmdline");
    const std::string command(std::istreambuf_iterator<char>(file), {});
    for (const auto& name : names) CHECK_THAT(command, Catch::Contains(name));
    CHECK(client.ask({{"op", "record"}, {"on", false}})["ok"] == true);
    CHECK(eventually([&] { return state(monitor)["control"]["recording"] == ""; }));
    std::filesystem::remove(reply["text"].get<std::string>());
}

TEST_CASE("a recording that the page has started and that is killed is in the verdict") {
    const Pair pair;
    pair.first->publish();
    pair.second->publish();
    RunningMonitor monitor(pair.link.name, "--control");
    Controller client(monitor);
    const auto reply = client.ask({{"op", "record"}, {"on", true}, {"links", {pair.link.name}}});
    REQUIRE(reply["ok"] == true);
    const auto recorder = find_child(monitor.pid());
    REQUIRE(recorder > 0);
    kill(recorder, SIGKILL);
    CHECK(eventually([&] { return state(monitor)["verdict"]["level"] == "unrecorded"; }));
    CHECK_THAT(state(monitor)["verdict"]["reason"].get<std::string>(),
               Catch::Contains("tandem record was killed by signal 9"));
    std::filesystem::remove(reply["text"].get<std::string>());
}

TEST_CASE("recordings are listed and downloaded with the token, and nothing else of their folder") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    const auto folder = std::filesystem::read_symlink("/proc/" + std::to_string(monitor.pid()) + "/cwd");
    const std::string name = "tandem-20200102-030405.mcap";
    std::ofstream(folder / name) << std::string(300'000, 'm');
    const auto listed = Controller(monitor).ask({{"op", "recordings"}})["recordings"];
    CHECK(std::count_if(listed.begin(), listed.end(), [&](const auto& each) {
              return each["file"] == name && each["bytes"] == 300'000;
          }) == 1);
    const std::string query = "?token=" + monitor.token;
    const auto whole = get(monitor, "/api/recordings/" + name + query);
    CHECK(whole.status == 200);
    CHECK(whole.body == std::string(300'000, 'm'));
    CHECK(get(monitor, "/api/recordings/" + name).status == 403);
    CHECK(get(monitor, "/api/recordings/" + name + "?token=0").status == 403);
    CHECK(get(monitor, "/api/recordings/" + name + query, "POST").status == 405);
    for (const char* other :
         {"", "../", "tandem-20200102-030406.mcap", "..%2f", "tandem-2020010a-030405.mcap"})
        CHECK(get(monitor, std::string("/api/recordings/") + other + query).status == 404);
    std::filesystem::remove(folder / name);
    std::filesystem::create_symlink("/etc/passwd", folder / name);
    CHECK(get(monitor, "/api/recordings/" + name + query).status == 404);
    std::filesystem::remove(folder / name);
}

TEST_CASE("new lines of the hosts' logs are sent once, if the logs are files of this user") {
    const Pair pair; // both of its sides are this process
    const auto log = std::filesystem::temp_directory_path() / ("tandem-log-" + std::to_string(getpid()));
    const int errors = dup(STDERR_FILENO),
              file = open(log.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_APPEND, 0600);
    REQUIRE(file >= 0);
    const auto write_line = [&](const std::string& text) {
        REQUIRE(write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    };
    write_line("first\n[2026-01-02 03:04:05.678] [error] Arm: it is stuck\nhalf a li");
    RunningMonitor monitor(pair.link.name, "--control");
    Controller client(monitor);
    dup2(file, STDERR_FILENO);
    const auto ask = [&](const nlohmann::json& from) {
        return client.ask({{"op", "log"}, {"from", from}})["log"];
    };
    const auto first = ask(nlohmann::json::object());
    write_line("ne\n");
    REQUIRE(first.size() == 1);
    const std::string id = first[0]["id"];
    const auto second = ask({{id, first[0]["next"]}}), third = ask({{id, second[0]["next"]}});
    dup2(errors, STDERR_FILENO);
    CHECK(first[0]["text"] == "first\n[2026-01-02 03:04:05.678] [error] Arm: it is stuck\n");
    CHECK_THAT(first[0]["hosts"][0].get<std::string>(), Catch::Contains(std::to_string(getpid())));
    CHECK(second[0]["text"] == "half a line\n");
    CHECK(third[0]["text"] == "");
    close(file);
    close(errors);
    std::filesystem::remove(log);
}
