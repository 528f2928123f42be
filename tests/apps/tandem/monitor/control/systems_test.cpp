// SPDX-License-Identifier: Apache-2.0
// Pages with the token create, start and stop the systems of one folder. browser/build_test.mjs does so with components.
#include "../http_client.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

using namespace tandem::monitor::test;
using namespace tandem::shm::test;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A folder of systems, and a monitor that runs them.
struct SystemsFolder {
    SystemsFolder() {
        std::string name = (fs::temp_directory_path() / "tandem-systems-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~SystemsFolder() { fs::remove_all(path); }
    SystemsFolder(const SystemsFolder&) = delete;
    SystemsFolder& operator=(const SystemsFolder&) = delete;

    /// A system of an RTM host only.
    void add(const std::string& name, const std::string& settings = "") const {
        fs::create_directories(path / name / "rtm");
        std::ofstream(path / name / "rtm/rtc.conf") << "naming.enable: NO\nmanager.shutdown_auto: NO\n"
                                                    << settings;
    }
    std::vector<std::string> options() const { return {"--control", "--systems", path.string()}; }

    fs::path path;
};

/// A monitor that stops the systems that it has started. A test that fails would leave them running otherwise.
struct SystemsMonitor : RunningMonitor {
    explicit SystemsMonitor(const SystemsFolder& folder) : RunningMonitor("no-link", folder.options()) {}
    ~SystemsMonitor() {
        if (!runs()) return;
        kill(pid(), SIGTERM);
        eventually([this] { return !runs(); }, std::chrono::seconds(30));
    }
    SystemsMonitor(const SystemsMonitor&) = delete;
    SystemsMonitor& operator=(const SystemsMonitor&) = delete;
};

json ask(const RunningMonitor& monitor, json request) {
    Live client(monitor, 0, "/api/control");
    client.send(json{{"token", monitor.token}}.dump());
    client.next();
    request["op"] = "system";
    client.send(request.dump());
    return client.next();
}

json run_of(const RunningMonitor& monitor) {
    const json runs = state(monitor)["control"]["systems"];
    return runs.empty() ? json::object() : runs[0];
}

} // namespace

TEST_CASE("without --systems a client with the token runs no system") {
    const RunningMonitor monitor("no-link", "--control");
    const json reply = ask(monitor, {{"command", "list"}});
    CHECK(reply["ok"] == false);
    CHECK_THAT(reply["text"].get<std::string>(), Catch::Contains("--control --systems DIR"));
    CHECK(state(monitor)["control"]["systems"].is_null());
}

TEST_CASE("a missing folder of systems, or one without --control, ends the monitor with one line") {
    const auto missing = tandem::test::tandem_program(
        {"monitor", "no-link", "--port", "0", "--control", "--systems", "/tmp/no-such-folder"});
    CHECK(missing.exit_code == 1);
    CHECK(missing.errors == "tandem: /tmp/no-such-folder is not a folder: --systems needs an existing one\n");
    CHECK(tandem::test::tandem_program({"monitor", "no-link", "--systems", "/tmp"}).exit_code != 0);
}

TEST_CASE("no name leads out of the folder of systems") {
    const SystemsFolder folder, other;
    other.add("outside");
    fs::create_directory_symlink(other.path / "outside", folder.path / "linked");
    const SystemsMonitor monitor(folder);
    for (const std::string name :
         {"", ".", "..", "../outside", "a/b", "-x", "linked", "missing", "a b", "a\nb"})
        for (const char* command : {"start", "stop", "log"}) {
            INFO(name << " " << command);
            const auto reply = ask(monitor, {{"command", command}, {"name", name}});
            CHECK(reply["ok"] == false);
            CHECK(reply["text"].get<std::string>().find_first_of("\n\x1b") == std::string::npos);
        }
    CHECK(ask(monitor, {{"command", "save"}, {"name", "../new"}, {"hosts", json::array()}})["ok"] == false);
    CHECK(ask(monitor, {{"command", "new"}, {"name", "x"}, {"components", {"../a"}}})["ok"] == false);
    CHECK(ask(monitor, {{"command", "save"}, {"name", "linked"}, {"hosts", json::array()}})["ok"] == false);
    CHECK(ask(monitor, {{"command", "new"}, {"name", "linked"}, {"components", {"linked"}}})["ok"] == false);
    CHECK(state(monitor)["control"]["systems"].empty());
    CHECK(!fs::exists(other.path / "outside/run.log"));
}

TEST_CASE("the folders of systems and of built components are listed") {
    const SystemsFolder folder;
    folder.add("robot");
    fs::create_directory(folder.path / "notes");
    fs::copy(TANDEM_PARTS, folder.path, fs::copy_options::recursive);
    const SystemsMonitor monitor(folder);
    const json list = json::parse(ask(monitor, {{"command", "list"}})["text"].get<std::string>());
    CHECK(list["systems"] == json{"robot"});
    CHECK(list["components"] ==
          json{{{"name", "PartComp"}, {"model", "OPRoS"}}, {{"name", "PartRtc"}, {"model", "RTM"}}});
}

TEST_CASE("tandem system new writes nothing if two components would have one name, or the folder's name is "
          "not valid for a link") {
    const SystemsFolder folder;
    const fs::path part = fs::path(TANDEM_PARTS) / "PartComp";
    for (const char* name : {"one", "two"}) fs::copy(part, folder.path / name, fs::copy_options::recursive);
    const auto create = [&](const char* name) {
        return tandem::test::tandem_program({"system", "new", (folder.path / name).string(),
                                             (folder.path / "one").string(), (folder.path / "two").string()});
    };
    const auto same = create("robot");
    CHECK(same.exit_code == 1);
    CHECK_THAT(same.errors, Catch::Contains("would both be components with the name PartComp"));
    CHECK(create("robot.1").errors ==
          "tandem: link name 'robot.1': expected 1 to 64 characters of A-Z a-z 0-9 _ -, the first not -\n");
    CHECK(!fs::exists(folder.path / "robot"));
    CHECK(!fs::exists(folder.path / "robot.1"));
}

TEST_CASE("the end of a run that fails is in the state, and its log says why") {
    const SystemsFolder folder;
    folder.add("robot", "manager.components.precreate: Nothing\n");
    const SystemsMonitor monitor(folder);
    REQUIRE(ask(monitor, {{"command", "start"}, {"name", "robot"}})["ok"] == true);
    CHECK(eventually([&] { return run_of(monitor)["end"] == "exited with 1"; }));
    CHECK(run_of(monitor)["running"] == false);
    CHECK_THAT(ask(monitor, {{"command", "log"}, {"name", "robot"}})["text"].get<std::string>(),
               Catch::Contains("Nothing"));
}

TEST_CASE("a log that is a pipe or a link blocks nothing and is not written") {
    const SystemsFolder folder;
    folder.add("robot");
    const fs::path log = folder.path / "robot/run.log";
    const SystemsMonitor monitor(folder);
    REQUIRE(mkfifo(log.c_str(), 0600) == 0);
    CHECK(ask(monitor, {{"command", "start"}, {"name", "robot"}})["ok"] == false);
    CHECK(ask(monitor, {{"command", "log"}, {"name", "robot"}})["text"] == "");
    fs::remove(log);
    std::ofstream(folder.path / "other") << "kept";
    fs::create_symlink(folder.path / "other", log);
    CHECK(ask(monitor, {{"command", "start"}, {"name", "robot"}})["ok"] == false);
    CHECK(fs::file_size(folder.path / "other") == 4);
}

TEST_CASE("the log of a run stays bounded, and only this user reads it") {
    const SystemsFolder folder;
    folder.add("robot");
    const fs::path log = folder.path / "robot/run.log";
    const SystemsMonitor monitor(folder);
    REQUIRE(ask(monitor, {{"command", "start"}, {"name", "robot"}})["ok"] == true);
    CHECK((fs::status(log).permissions() & fs::perms::all) ==
          (fs::perms::owner_read | fs::perms::owner_write));
    std::ofstream(log, std::ios::app) << std::string((16 << 20) + 1, 'x') << "\nthe end\n";
    CHECK(eventually([&] { return fs::file_size(log) < 1 << 20; }));
    const auto text = ask(monitor, {{"command", "log"}, {"name", "robot"}})["text"].get<std::string>();
    CHECK_THAT(text, Catch::StartsWith("(older lines are removed") && Catch::Contains("the end\n"));
}

TEST_CASE("a run that outlives its monitor is not started twice") {
    const SystemsFolder folder;
    folder.add("robot");
    const auto log = [&] {
        std::ifstream file(folder.path / "robot/run.log");
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    {
        RunningMonitor killed("no-link", folder.options());
        REQUIRE(ask(killed, {{"command", "start"}, {"name", "robot"}})["ok"] == true);
        REQUIRE(eventually([&] { return log().find("ready") != std::string::npos; }));
        kill(killed.pid(), SIGKILL);
        REQUIRE(eventually([&] { return !killed.runs(); }));
    }
    const SystemsMonitor monitor(folder);
    const std::string before = log(), mark = "started, pid ";
    const auto start = [&] { return ask(monitor, {{"command", "start"}, {"name", "robot"}}); };
    CHECK_THAT(start()["text"].get<std::string>(), Catch::Contains("started by another monitor"));
    CHECK(log() == before);
    kill(std::stoi(before.substr(before.find(mark) + mark.size())), SIGKILL); // the host: its tandem run ends
    CHECK(eventually([&] { return start()["ok"] == true; }));
}

TEST_CASE("a system runs once at a time, is stopped cleanly, and ends with the monitor") {
    const SystemsFolder folder;
    folder.add("robot");
    const auto log = [&] {
        std::ifstream file(folder.path / "robot/run.log");
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const auto has = [&](const char* line) { return log().find(line) != std::string::npos; };
    SystemsMonitor monitor(folder);
    REQUIRE(ask(monitor, {{"command", "start"}, {"name", "robot"}})["ok"] == true);
    CHECK(ask(monitor, {{"command", "start"}, {"name", "robot"}})["text"] == "robot runs");
    CHECK(eventually([&] { return has("ready"); }));
    CHECK(ask(monitor, {{"command", "stop"}, {"name", "robot"}})["ok"] == true);
    CHECK(eventually([&] { return run_of(monitor)["end"] == "exited with 0"; }));
    REQUIRE(ask(monitor, {{"command", "start"}, {"name", "robot"}})["ok"] == true);
    CHECK(eventually([&] { return has("ready"); }));
    kill(monitor.pid(), SIGTERM);
    CHECK(eventually([&] { return has("all hosts have ended"); }));
    CHECK(eventually([&] { return !monitor.runs(); }));
}
