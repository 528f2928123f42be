// SPDX-License-Identifier: Apache-2.0
// Two hosts whose components add and remove ports while they run.
#pragma once

#include "tests/apps/tandem/program.hpp"
#include "two_hosts.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

/// LateRtc0 and Tally, steered by `tandem rtm conf`.
struct ChangingHosts : TwoHosts {
    ChangingHosts() : port(unused_port()) {
        leave_out_talker_and_rtc();
        set_manager_port(port);
        set_strict(false); // connections wait for their ports
        set_rtc("LateRtc");
        append_to_rtc_conf(
            "test.LateRtc.port.inport.back.buffer.length: 1000\n"); // a busy machine skips no number
        add_component("Tally", "TallyComp");
    }
    tandem::test::Result run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "rtm");
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + port});
        return tandem::test::tandem_program(arguments);
    }
    bool sets(const std::string& rtc, const std::string& setting) const {
        return run({"conf", rtc, setting}).exit_code == 0;
    }
    nlohmann::json ring(const std::string& name) const {
        const auto json = tandem::test::shm_program({"stats", link(), "--json"}).json();
        for (const auto& ring : json["rings"])
            if (ring["name"] == "port " + name) return ring;
        return {};
    }
    /// Returns whether everything that `sender` had sent by that port was received when it paused, except for
    /// skipped messages.
    bool is_complete(const std::string& name, const std::string& sender, int skipped = 0) const {
        for (int i = 0; i < 1500 && ring(name)["sent"] == 0; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        pause(sender);
        nlohmann::json last;
        for (int i = 0; i < 1500; ++i) {
            last = ring(name);
            if (last["waiting"] == 0) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        resume(sender);
        UNSCOPED_INFO(last.dump());
        return last["sent"] > 0 && last["sent"] == last["received"].get<int>() + skipped &&
               last["dropped"]["overwritten"] == 0 && last["dropped"]["refused"] == 0 &&
               last["dropped"]["skipped"] == skipped;
    }
    bool has_said(const std::string& host, const std::string& text) const {
        return output(host).find(text) != std::string::npos;
    }
    /// Returns whether this was printed after the last call of forget_output().
    bool now_says(const std::string& host, const std::string& text) { return says(host, text, seen_[host]); }
    void forget_output() {
        for (const char* host : {"opros", "rtm"}) seen_[host] = output(host).size();
    }
    const std::string port;

  private:
    std::map<std::string, std::size_t> seen_;
};
