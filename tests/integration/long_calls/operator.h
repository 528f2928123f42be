// SPDX-License-Identifier: Apache-2.0
// Uses a crane according to commands from a named pipe, one per line, and prints what happens:
//   lift N    calls with a handle, which allows a minute, in a separate thread      plain N  calls without a handle
//   lower N   calls without waiting, with a handle
//   watch     waits until the progress has risen twice                                cancel   cancels the handle's call
//   wait      waits until nothing is pending
#pragma once
#include "crane.h"

#include <TandemCall.h>

#include <fcntl.h>
#include <functional>
#include <sstream>
#include <thread>
#include <unistd.h>
#include <vector>

/// The calls convert exceptions to text.
class Operator {
  public:
    using Lift = std::function<std::string(int steps)>;
    using Lower = std::function<void(int steps)>;
    Operator(Lift lift, Lower lower) : lift_(std::move(lift)), lower_(std::move(lower)) {}
    ~Operator() { stop(); }

    void start(const std::string& pipe) {
        // For reading and writing: such a pipe never ends, and stop() can wake the thread by it.
        pipe_ = open(pipe.c_str(), O_RDWR | O_CLOEXEC);
        if (pipe_ >= 0) reader_ = std::thread([this] { read_commands(); });
    }
    void stop() {
        if (!reader_.joinable()) return;
        if (write(pipe_, "\n", 1) == 1) reader_.join();
        handle_.cancel();
        for (auto& call : calls_) call.join();
        calls_.clear();
        close(pipe_);
    }

  private:
    /// An empty line ends it.
    void read_commands() {
        std::string line;
        for (char letter = 0; read(pipe_, &letter, 1) == 1;) {
            if (letter != '\n') {
                line += letter;
                continue;
            }
            if (line.empty()) return;
            std::istringstream words(line);
            std::string command;
            int steps = 0;
            words >> command >> steps;
            execute(command, steps);
            line.clear();
        }
    }
    void execute(const std::string& command, int steps) {
        if (command == "lift" || command == "plain") {
            handle_ = tandem::CallHandle(std::chrono::minutes(1));
            calls_.emplace_back([this, command, steps, handle = handle_] {
                if (command == "plain") return say("operator: plain " + lift_(steps));
                const tandem::CallScope scope(handle);
                say("operator: lift " + lift_(steps));
            });
        } else if (command == "lower") {
            handle_ = tandem::CallHandle(std::chrono::minutes(1));
            const tandem::CallScope scope(handle_);
            lower_(steps);
            say(handle_.pending() ? "operator: lower pending" : "operator: lower ended at once");
        } else if (command == "watch") {
            say(rises() ? "operator: progress rises" : "operator: no progress");
        } else if (command == "cancel") {
            handle_.cancel();
        } else if (command == "wait") {
            say(within_20_s([this] { return !handle_.pending(); }) ? "operator: nothing pending"
                                                                   : "operator: still pending");
        }
    }
    bool rises() {
        double before = 0;
        int times = 0;
        return within_20_s([&] {
            const double now = handle_.progress();
            if (now > before) ++times;
            before = now;
            return times == 2;
        });
    }
    static bool within_20_s(const std::function<bool()>& condition) {
        for (int i = 0; i < 20'000; ++i) {
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }

    const Lift lift_;
    const Lower lower_;
    int pipe_ = -1;
    tandem::CallHandle handle_;
    std::thread reader_;
    std::vector<std::thread> calls_;
};
