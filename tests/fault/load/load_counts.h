// SPDX-License-Identifier: Apache-2.0
// What the two components under load count: in memory that outlives them, so that the test can read what a killed host has
// seen. The file is named by the environment variable TANDEM_LOAD_COUNTS.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <thread>
#include <unistd.h>

using Count = std::atomic<std::uint64_t>;

inline std::uint64_t load_clock_ns() {
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                          std::chrono::steady_clock::now().time_since_epoch())
                                          .count());
}

constexpr int call_threads = 2;
constexpr std::uint64_t call_deadline_ms = 100;
constexpr int overtime_buckets = 64;

/// The end of a call. `other`: an error that says neither why the call failed nor what became of it.
enum class CallEnd { ok, not_ready, timeout, peer_died, overload, other };
constexpr int call_ends = 6;

/// The end of a call by the name of its CORBA exception, as in `CORBA::TIMEOUT` or `IDL:omg.org/CORBA/TIMEOUT:1.0`.
inline CallEnd call_end_of(const std::string& exception) {
    const auto has = [&](const char* name) { return exception.find(name) != std::string::npos; };
    if (has("TRANSIENT")) return CallEnd::not_ready;
    if (has("TIMEOUT")) return CallEnd::timeout;
    if (has("COMM_FAILURE")) return CallEnd::peer_died;
    if (has("NO_RESOURCES")) return CallEnd::overload;
    return CallEnd::other;
}

/// The counts of one side. A life is one run of its host.
struct SideCounts {
    Count lives, ready_ns; ///< ready_ns: when the component was created in this life
    Count sent, received, wrong, events_sent, events_received;
    Count peer_life;              ///< of the message that came last
    Count first_received_ns;      ///< the first message of this life of the receiver
    Count first_of_peer_life_ns;  ///< the first message of that life of the sender
    Count ended[call_ends];       ///< calls
    Count begun_ns[call_threads]; ///< of the call under way; 0: none
    Count overtime
        [overtime_buckets]; ///< calls by their time beyond the deadline, in steps of 2 ms; the last has no end
    Count longest_overtime_ns;

    /// Calls that ended more than 20 ms after their deadline.
    std::uint64_t over_20_ms() const {
        std::uint64_t calls = 0;
        for (int i = 10; i < overtime_buckets; ++i) calls += overtime[i];
        return calls;
    }
    void count_message(std::uint64_t life) {
        const std::uint64_t now = load_clock_ns();
        if (peer_life.exchange(life) != life) first_of_peer_life_ns = now;
        std::uint64_t none = 0;
        first_received_ns.compare_exchange_strong(none, now);
        ++received;
    }
    void count_call(std::uint64_t begun, CallEnd end) {
        const std::uint64_t took = load_clock_ns() - begun, deadline = call_deadline_ms * 1'000'000;
        ++ended[static_cast<int>(end)];
        if (took <= deadline) return;
        const std::uint64_t over = took - deadline;
        const std::uint64_t bucket = over / 2'000'000;
        ++overtime[bucket < overtime_buckets ? bucket : overtime_buckets - 1];
        if (over > longest_overtime_ns) longest_overtime_ns = over;
    }
};

struct LoadCounts {
    SideCounts opros, rtm;
};

/// Maps the file that TANDEM_LOAD_COUNTS names, for the life of the process.
inline LoadCounts& load_counts() {
    static LoadCounts* const counts = [] {
        const char* path = std::getenv("TANDEM_LOAD_COUNTS");
        const int file = path != nullptr ? open(path, O_RDWR | O_CLOEXEC) : -1;
        void* memory = mmap(nullptr, sizeof(LoadCounts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (memory == MAP_FAILED)
            throw std::runtime_error("TANDEM_LOAD_COUNTS names no file that can be mapped");
        close(file);
        return static_cast<LoadCounts*>(memory);
    }();
    return *counts;
}

/// The messages of one life of one side: `{life, number, ...}`, where all further elements are the number. Every 64th is
/// so long that it goes by loan.
class MessagePattern {
  public:
    static std::size_t length_of(int number) {
        return number % 64 == 0 ? 60'000 : 2 + static_cast<std::size_t>(number % 300);
    }
    /// Returns whether a received message is intact and newer than the last one.
    template <class Numbers>
    bool is_right(const Numbers& message, std::size_t length) {
        if (length < 2) return false;
        const int life = message[0], number = message[1];
        const bool in_order = life != life_ || number > number_;
        life_ = life;
        number_ = number;
        if (length != length_of(number)) return false;
        for (std::size_t i = 2; i < length; ++i)
            if (message[i] != number) return false;
        return in_order;
    }

  private:
    int life_ = 0, number_ = 0;
};

/// Threads that call a service without a pause, while the component lives.
class CallLoad {
  public:
    /// `call(argument)` returns how it ended, and throws nothing.
    template <class Call>
    CallLoad(SideCounts& counts, Call call) {
        for (int i = 0; i < call_threads; ++i)
            threads_[i] = std::thread([this, i, &counts, call] {
                for (int number = 1; !stopping_; ++number) {
                    const std::uint64_t begun = load_clock_ns();
                    counts.begun_ns[i] = begun;
                    const CallEnd end = call(number);
                    counts.begun_ns[i] = 0;
                    counts.count_call(begun, end);
                    if (end != CallEnd::ok) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                }
            });
    }
    ~CallLoad() {
        stopping_ = true;
        for (auto& thread : threads_) thread.join();
    }

  private:
    std::atomic<bool> stopping_{false};
    std::thread threads_[call_threads];
};

/// The work of the service: of 64 calls, one takes longer than the deadline, some take a while, most take no
/// time.
inline int do_work(int number) {
    if (number % 64 == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(3 * call_deadline_ms / 2));
    else if (number % 8 == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return number + 1;
}
