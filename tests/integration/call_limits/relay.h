// SPDX-License-Identifier: Apache-2.0
// Both ends of a relay, as an OPRoS component and an RTC have them. The end with the property `work` calls the other end, in
// its own threads, and prints the results:
//   long     echoes of up to nearly 64 MiB                callers  64 threads that call at once
//   deep     two chains of 16 nested calls at once         notes    2000 calls without a reply at once
#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <mutex>
#include <string>
#include <syncstream>
#include <thread>
#include <vector>

inline void say(const std::string& text) { std::osyncstream(std::cout) << text + "\n" << std::flush; }

using Bytes = std::vector<unsigned char>;

/// The peer's operations. They throw a text if the call fails.
struct RelayPeer {
    std::function<Bytes(const Bytes&)> echo;
    std::function<int(int)> deep;
    std::function<void(int)> note;
};

/// The operations that the peer calls.
class RelayEnd {
  public:
    explicit RelayEnd(RelayPeer peer) : peer_(std::move(peer)) {}
    ~RelayEnd() { stop(); }

    int deep(int depth) { return depth == 0 ? 0 : 1 + peer_.deep(depth - 1); }
    void note(int number) {
        const std::lock_guard lock(mutex_);
        if (number == noted_) ++noted_;
        if (noted_ == notes) say("relay: all notes came in order");
    }

    void start(const std::string& work) {
        stopping_ = false;
        if (!work.empty()) thread_ = std::thread([this, work] { run(work); });
    }
    void stop() {
        stopping_ = true;
        if (thread_.joinable()) thread_.join();
    }

  private:
    static constexpr int notes = 2000;

    /// Calls `part(i)` in `count` threads, and returns how many calls returned true.
    void in_threads(const std::string& work, int count, const std::function<bool(int)>& part) {
        std::atomic<int> right{0};
        std::vector<std::thread> threads;
        for (int i = 0; i < count; ++i)
            threads.emplace_back([&, i] {
                try {
                    right += part(i);
                } catch (const std::string& failure) {
                    say("relay: " + work + " failed: " + failure);
                }
            });
        for (auto& thread : threads) thread.join();
        say("relay: " + work + " " + std::to_string(right) + " of " + std::to_string(count));
    }
    void run(const std::string& work) {
        while (!is_there() && !stopping_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (work == "long") in_threads(work, 1, [this](int) { return echoes_long(); });
        if (work == "callers") in_threads(work, 64, [this](int i) { return echoes_short(i); });
        if (work == "deep") in_threads(work, 2, [this](int) { return goes_deep(); });
        if (work == "notes") in_threads(work, 1, [this](int) { return sends_notes(); });
    }
    bool is_there() {
        try {
            return peer_.echo({}).empty();
        } catch (const std::string&) {
            return false;
        }
    }
    bool echoes_long() {
        constexpr std::size_t largest = (std::size_t{64} << 20) - 1024; // with a head and a length
        for (const std::size_t bytes : {std::size_t{65536}, std::size_t{1'000'003}, largest}) {
            Bytes sent(bytes);
            for (std::size_t i = 0; i < bytes; ++i) sent[i] = static_cast<unsigned char>(i * 7 + (i >> 8));
            if (peer_.echo(sent) != sent) return false;
        }
        return true;
    }
    bool echoes_short(int caller) {
        for (int i = 0; i < 50; ++i) {
            const Bytes sent{static_cast<unsigned char>(caller), static_cast<unsigned char>(i)};
            if (peer_.echo(sent) != sent) return false;
        }
        return true;
    }
    bool goes_deep() {
        for (int i = 0; i < 10; ++i)
            if (peer_.deep(16) != 16) return false;
        return true;
    }
    bool sends_notes() {
        for (int i = 0; i < notes; ++i) peer_.note(i);
        return true;
    }

    const RelayPeer peer_;
    std::thread thread_;
    std::atomic<bool> stopping_{false};
    std::mutex mutex_; ///< guards noted_
    int noted_ = 0;
};
