// SPDX-License-Identifier: Apache-2.0
// A host of the mixed run is killed in mid-run, or its segment is truncated. The run reports the times; this test only checks
// that they exist and are plausible for a busy machine.
#include <catch2/catch.hpp>

#include <dirent.h>
#include <fcntl.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/process/child_process.hpp"
#include "plugins/wheelchair/core/body/clock.hpp"
#include "program.hpp"
#include "scratch_dir.hpp"
#include "shm/segment/segment_file.hpp"
#include "tests/plugins/wheelchair/read_trace.hpp"

using namespace tandem::wheelchair;
using tandem::process::ChildProcess, tandem::process::FileDescriptor;
using namespace std::chrono_literals;

namespace {

/// A mixed (or swapped) run in the background, with its files in a separate folder.
class MixedRun {
  public:
    explicit MixedRun(const std::vector<std::string>& more, const std::string& configuration = "mixed")
        : output_(open_file("output")), errors_(open_file("errors")) {
        std::vector<std::string> command{WHEELCHAIR_PROGRAM, "--config", configuration,
                                         "--duration",       "5",        "--keep",
                                         dir_ / "run",       "--json",   dir_ / "run.json"};
        command.insert(command.end(), more.begin(), more.end());
        process_.emplace(command, tandem::process::ChildOptions{-1, output_.get(), errors_.get()});
    }

    /// Kills the host once the chair drives. Kills only the pid that the run has printed.
    void kill_when_driving(const std::string& host) {
        wait_until_driving();
        const std::string text = file_content(dir_ / "output");
        const auto at = text.find(host + " pid ");
        REQUIRE(at != text.npos);
        kill(std::stoi(text.substr(at + host.size() + 5)), SIGKILL);
    }

    void truncate_when_driving() {
        wait_until_driving();
        const auto generations = tandem::shm::list_generations(link());
        REQUIRE(generations.size() == 1);
        truncated_ = tandem::shm::segment_path(link(), generations[0]);
        truncated_at_ = monotonic_seconds();
        REQUIRE(truncate(truncated_.c_str(), 4096) == 0);
    }

    nlohmann::json result() {
        const auto& ended = process_->wait(60s);
        REQUIRE(ended);
        exit_code = ended->signalled ? -1 : ended->code;
        errors = file_content(dir_ / "errors");
        return nlohmann::json::parse(file_content(dir_ / "run.json"))["runs"][0];
    }

    std::string link() const { return "wheelchair-" + std::to_string(process_->pid()); }
    const std::string& truncated() const { return truncated_; }
    double truncated_at() const { return truncated_at_; } ///< [s], CLOCK_MONOTONIC, as the records' `at`
    int exit_code = -1;
    std::string errors;

    std::vector<HWRecord> hw() const { return read_trace<HWRecord>(dir_ / "run/trace/HWComp.trace"); }
    std::vector<ControlRecord> control() const {
        return read_trace<ControlRecord>(dir_ / "run/trace/ControlComp.trace");
    }
    std::string host_log(const std::string& host) const {
        return file_content(dir_ / ("run/log/" + host + ".log"));
    }

  private:
    void wait_until_driving() const {
        for (int i = 0; i < 300 && !driving(); ++i) std::this_thread::sleep_for(50ms);
        REQUIRE(driving());
    }
    FileDescriptor open_file(const std::string& name) {
        return FileDescriptor(::open((dir_ / name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
    }
    bool driving() const {
        const auto records = hw();
        return !records.empty() && records.back().volts_left > 1.0;
    }

    ScratchDir dir_;
    FileDescriptor output_, errors_;
    std::optional<ChildProcess> process_;
    std::string truncated_;
    double truncated_at_ = 0.0;
};

bool left_in_shared_memory(const std::string& link) {
    bool found = false;
    DIR* dir = opendir("/dev/shm");
    while (const dirent* entry = readdir(dir))
        found |= std::string(entry->d_name).find(link) != std::string::npos;
    closedir(dir);
    return found;
}

} // namespace

TEST_CASE("when rtm_host is killed the motors stop, the other host keeps running, and the run reports it") {
    MixedRun run({});
    run.kill_when_driving("rtm_host");
    const auto result = run.result();
    INFO(run.errors);
    CHECK(run.exit_code != 0);
    REQUIRE(result["host_failures"].size() == 1);
    CHECK(result["host_failures"][0]["host"] == "rtm_host");
    REQUIRE(result["host_failures"][0]["motors_off_after_ms"].is_number());
    CHECK(result["host_failures"][0]["motors_off_after_ms"] < 1000.0);
    CHECK(result["complete"] == true); // HWComp went on to the end
    CHECK_THAT(run.errors, Catch::Contains("was killed by signal 9") && Catch::Contains("to restart it: ") &&
                               Catch::Contains("both motor voltages at 0"));
    CHECK_FALSE(left_in_shared_memory(run.link()));
}

TEST_CASE("a killed rtm_host that is started again gets its data without a restart of opros_host") {
    MixedRun run({"--restart"});
    run.kill_when_driving("rtm_host");
    const auto result = run.result();
    INFO(run.errors);
    REQUIRE(result["host_failures"].size() == 1);
    CHECK(result["host_failures"][0]["data_back_after_ms"].is_number());
    CHECK_FALSE(left_in_shared_memory(run.link()));
}

TEST_CASE("a killed opros_host that is started again gets its data without a restart of rtm_host") {
    MixedRun run({"--restart"});
    run.kill_when_driving("opros_host");
    const auto result = run.result();
    INFO(run.errors);
    REQUIRE(result["host_failures"].size() == 1);
    CHECK(result["host_failures"][0]["host"] == "opros_host");
    CHECK(result["host_failures"][0]["data_back_after_ms"].is_number());
    CHECK_FALSE(left_in_shared_memory(run.link()));
}

TEST_CASE("with the roles exchanged the hardware RTC stops the motors when opros_host is killed") {
    MixedRun run({"--restart"}, "swapped");
    run.kill_when_driving("opros_host");
    const auto result = run.result();
    INFO(run.errors);
    REQUIRE(result["host_failures"].size() == 1);
    CHECK(result["host_failures"][0]["host"] == "opros_host");
    REQUIRE(result["host_failures"][0]["motors_off_after_ms"].is_number());
    CHECK(result["host_failures"][0]["motors_off_after_ms"] < 1000.0);
    CHECK(result["host_failures"][0]["data_back_after_ms"].is_number());
    CHECK_FALSE(left_in_shared_memory(run.link()));
}

TEST_CASE("when the segment is truncated the motors are off until the hosts have joined a new one") {
    MixedRun run({});
    run.truncate_when_driving();
    const auto result = run.result();
    INFO(run.errors);
    CHECK(result["host_failures"].empty()); // no host died; what was under way may be lost, and is reported
    CHECK(result["complete"] == true);
    for (const auto* host : {"opros_host", "rtm_host"}) {
        INFO(run.host_log(host));
        CHECK_THAT(run.host_log(host),
                   Catch::Contains(run.truncated() + " was truncated by another process"));
    }
    // Both hosts may have joined the new segment before HWComp's next tick: then no tick sees the link down.
    const auto hw = run.hw();
    CHECK(std::all_of(hw.begin(), hw.end(), [](const HWRecord& r) {
        const bool down = r.voltage_sequence > 0 && r.link_up == 0.0;
        return !down || (r.volts_left == 0.0 && r.volts_right == 0.0);
    }));
    const auto control = run.control();
    CHECK(std::any_of(control.begin(), control.end(), [&](const ControlRecord& r) {
        return r.at > run.truncated_at() + 0.5 && r.references_received > 0; // through the new segment
    }));
    CHECK_FALSE(left_in_shared_memory(run.link()));
}
