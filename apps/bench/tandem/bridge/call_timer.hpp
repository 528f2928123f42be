// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/tandem/bridge/paired_window.hpp"
#include "apps/bench/tandem/bridge/samples.hpp"

#include <memory>
#include <thread>

namespace tandem::bench {

/// The properties of a component of the calls. Property: std::string(const char* name).
struct CallSettings {
    template <class Property>
    static CallSettings from(Property&& property) {
        CallSettings settings{.file = property("file"), .floor = property("floor")};
        settings.sleeps = property("sleeps") == "yes";
        if (settings.file.empty()) return settings;
        settings.samples = std::stoul(property("samples"));
        settings.warm_up = std::stoul(property("warm_up"));
        settings.seconds = std::stod(property("seconds"));
        if (!settings.floor.empty()) settings.window = std::stoul(property("window"));
        return settings;
    }

    std::string file = {};  ///< for the times; empty: the component only answers
    std::string floor = {}; ///< of a paired case
    bool sleeps = false;    ///< both sides sleep while they wait
    std::size_t samples = 0, warm_up = 0, window = 0;
    double seconds = 0;
};

/// [tick-thread] The callers of both models: times `double add(double, double)` of the other side.
class CallTimer {
  public:
    explicit CallTimer(const CallSettings& settings)
        : samples_(settings.file, settings.samples, settings.seconds, settings.warm_up),
          sleeps_(settings.sleeps) {
        if (settings.floor.empty()) return;
        window_ = std::make_unique<PairedWindow>(settings.floor, settings.window);
        polled_floor_ = std::make_unique<FloorPort<Wake::spin>>(window_->floor());
        sleeping_floor_ = std::make_unique<FloorPort<Wake::blocking>>(window_->floor());
    }

    /// Called by the caller's onExecute(). add(a, b) returns a sum, or nothing if no component answers yet.
    template <class Add>
    void call_for_a_slice(Add&& add) {
        const std::uint64_t end = ticks() + to_ticks(slice_ns);
        while (!samples_.done()) {
            a_ += 1;
            const bool floor = window_ && window_->on_floor();
            const std::uint64_t before = ticks();
            if (before >= end) return;
            const auto sum = floor ? add_over_floor() : add(a_, b_);
            const std::uint64_t now = ticks();
            if (!sum) return; // the next tick calls again
            if (*sum != a_ + b_) throw std::runtime_error("the result of a call is wrong");
            take_time(to_ns(now - before), now);
        }
    }

  private:
    std::optional<double> add_over_floor() {
        return sleeps_ ? exchange(*sleeping_floor_) : exchange(*polled_floor_);
    }
    template <class Port>
    double exchange(Port& port) {
        PingMessage message{a_, b_};
        port.send(message);
        port.wait(message);
        return message[0];
    }
    void take_time(double ns, std::uint64_t now) {
        if (!window_) return samples_.add(ns, now);
        if (const auto ratio = window_->add(ns)) samples_.add(*ratio, now);
        if (!samples_.done()) return;
        window_->floor().end();
        if (sleeps_) sleeping_floor_->send({}); // wakes the answering thread
    }

    Samples samples_;
    bool sleeps_;
    double a_ = 0, b_ = 0.5;
    std::unique_ptr<PairedWindow> window_; // of a paired case
    std::unique_ptr<FloorPort<Wake::spin>> polled_floor_;
    std::unique_ptr<FloorPort<Wake::blocking>> sleeping_floor_;
};

/// The answering components of both models in a paired case: a thread that adds over the floor. It ends when
/// the measurement ends.
class FloorAdder {
  public:
    explicit FloorAdder(const CallSettings& settings)
        : floor_(settings.floor, Floor::Role::answers),
          thread_([this, sleeps = settings.sleeps] { sleeps ? add_asleep() : add_polling(); }) {}

    /// [any-thread] Call it for each call that arrives through the bridge.
    void note_call() { floor_.note_switches_on_bridge(); }

  private:
    // Does not poll, because the worker that executes the bridge's calls needs the core.
    void add_polling() {
        FloorPort<Wake::spin> port(floor_);
        PingMessage message;
        while (!floor_.ended()) {
            floor_.sleep_beside_bridge();
            while (floor_.in_use())
                if (port.receive(message)) answer(port, message);
        }
    }
    void add_asleep() {
        FloorPort<Wake::blocking> port(floor_);
        for (PingMessage message;;) {
            port.wait(message);
            if (floor_.ended()) return;
            answer(port, message);
            floor_.note_switches(); // while the caller sends the next one
        }
    }
    template <class Port>
    static void answer(Port& port, PingMessage& message) {
        message[0] += message[1];
        port.send(message);
    }

    Floor floor_;
    std::jthread thread_;
};

} // namespace tandem::bench
