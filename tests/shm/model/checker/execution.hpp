// SPDX-License-Identifier: Apache-2.0
// One execution: its threads, whose turn it is, which threads sleep or die, and how time passes. The accesses themselves are in
// access.hpp.
#pragma once
#include "tests/shm/model/checker/fiber.hpp"
#include "tests/shm/model/checker/reduction.hpp"
#include "tests/shm/model/mutation/mutation.hpp"

namespace tandem::shm::model {

/// Leaves a thread of an execution that is over.
struct Ended {};

/// What an execution may do besides running every step of every thread.
struct Settings {
    unsigned lapses = 0; ///< how often each thread's deadlines may pass although others could still run
    unsigned max_stale_reads =
        2; ///< how often in a row a thread reads one store although there is a newer one
    std::size_t step_limit = 20000;
    bool ends_in_sleep = false; ///< all threads asleep for ever is not a failure
    bool reduced = true;        ///< false: every order of every step, to check the reduction itself
};

class Execution {
  public:
    /// The time that a lapse takes: longer than any time-out of a scenario.
    static constexpr std::uint64_t never = std::uint64_t{1} << 62; ///< deadlines from here on do not come
    static constexpr std::uint64_t lapse = 20'000'000'000;
    /// The time that pause() takes when no thread can run, so that a polling thread soon reaches the end of its polling time.
    static constexpr std::uint64_t idle_round = 100'000;
    static constexpr unsigned polling_rounds =
        32; ///< that a thread goes through without looking at the clock

    /// A thread of `process`; threads of one process die together, if it is mortal. Called before run().
    void thread(std::string name, std::function<void()> body, unsigned process = 0, bool mortal = false) {
        if (++count_ >= max_threads) throw std::logic_error("model: more than max_threads");
        if (fibers_.size() < count_) {
            const std::size_t number = count_;
            fibers_.push_back(std::make_unique<Fiber>([this, number] { run_body(number); }));
        }
        Thread& made = threads_[count_];
        made = Thread{};
        made.name = std::move(name);
        made.body = std::move(body);
        made.observer = threads_[0].observer;
        made.lapses = settings_.lapses;
        made.group = static_cast<std::uint8_t>(process != 0 ? max_threads + process : count_);
        made.mortal = mortal;
        groups_[count_] = made.group;
    }

    /// Runs all threads to their end; afterwards the caller has seen all that they did.
    void run() {
        reduction_.begin(groups_);
        for (std::size_t i = 1; i <= count_; ++i) main_.switch_to(*fibers_[(turn_ = i) - 1]);
        starting_ = false;
        if ((turn_ = pick()) != 0) main_.switch_to(*fibers_[turn_ - 1]);
        look_at_what_never_ran();
        for (std::size_t i = 1; i <= count_; ++i)
            threads_[0].observer.now.join(threads_[i].observer.now, memory_.used());
        end_threads();
        if (failed() || redundant_) throw Ended{};
    }

    /// Whether the process of a thread lives, as the operating system says: at once, and then all that it did
    /// before its death is visible.
    bool lives(std::size_t thread);

    /// Claims of the scenario.
    void require(bool holds, const std::string& claim) {
        if (holds || (ending_ && in_thread())) return;
        fail(claim);
        throw Ended{};
    }
    bool died(std::size_t thread) const { return threads_[thread].dead; }

    static Execution& current() {
        if (!active()) throw std::logic_error("model: a model word is used outside of an execution");
        return *active();
    }

    // For Search.
    explicit Execution(Choices& choices) : choices_(choices) {}
    void begin(const Settings& settings, const Mutation* mutation, AccessLog* log, bool traced) {
        active() = this;
        settings_ = settings;
        mutation_ = mutation;
        log_ = log;
        traced_ = traced;
        memory_.clear();
        threads_[0] = Thread{};
        threads_[0].observer.time = 1000;
        count_ = turn_ = steps_ = 0;
        idle_ = 0;
        starting_ = true;
        ending_ = redundant_ = somebody_died_ = false;
        failure_.clear();
        trace_.clear();
        groups_ = {};
    }
    void set_fresh_from(std::size_t node) { fresh_from_ = node; }
    bool failed() const { return !failure_.empty(); }
    bool redundant() const { return redundant_; }
    const std::string& failure() const { return failure_; }
    const std::vector<std::string>& trace() const { return trace_; }
    std::size_t steps() const { return steps_; }
    std::uint32_t add_word(std::uint64_t value) { return memory_.add(value); }

    // For the model's atomics (access.hpp).
    std::uint64_t load(std::uint32_t word, Order order, const Site& at);
    void store(std::uint32_t word, std::uint64_t value, Order order, const Site& at);
    template <class Function>
    std::uint64_t change(std::uint32_t word, Order order, const Site& at, Function&& function);
    bool compare(std::uint32_t word, std::uint64_t& expected, std::uint64_t value, Order order, Order failure,
                 const Site& at);
    std::uint64_t take(std::uint32_t word, const Site& at);
    void put(std::uint32_t word, std::uint64_t value, const Site& at);
    void settle(std::uint32_t word, const Site& at);
    void fence(const Site& at);
    void pause(const Site& at);
    std::uint64_t now();
    void sleep(std::uint32_t word, std::uint64_t expected, std::uint64_t deadline, const Site& at);
    void wake(std::uint32_t word, int sleepers, const Site& at);

  private:
    enum class State { runs, paused, sleeps, ended };

    struct Repeat {
        Index index = 0;
        unsigned count = 0;
    };
    struct Look {
        std::uint32_t word;
        Index index;
    };

    struct Thread {
        std::string name;
        std::function<void()> body;
        Observer observer;
        State state = State::runs;
        Operation next;
        bool mortal = false, dead = false, woken = false, finished = false;
        std::uint8_t group = 0;
        unsigned lapses = 0, pauses = 0, hurry = 0;
        std::uint32_t queue = no_location, steps = 0;
        std::uint64_t deadline = 0;
        std::vector<Look> looks; ///< since the last pause
        std::array<Repeat, max_locations> repeats{};
    };

    static Execution*& active() {
        static Execution* execution = nullptr;
        return execution;
    }

    Thread& me() { return threads_[turn_]; }
    bool in_thread() const { return turn_ != 0; }
    bool over();
    /// The present step is new to the search.
    bool explores() const { return settings_.reduced && !choices_.random() && node_ >= fresh_from_; }
    void fail(const std::string& what) {
        if (failure_.empty()) failure_ = what;
    }

    void run_body(std::size_t number);
    void end_threads();
    void look_at_what_never_ran();
    std::size_t pick();
    std::size_t pass_time();
    bool ready(const Thread& thread) const;
    void hand_on();
    void await_turn(Operation operation, bool leaves_a_trace);
    void die();
    void done(Operation operation, Index stored, Index read, bool open);
    void trace(const Site& at, const char* what, const std::string& rest);
    bool damaged(const Site& at, Damage damage) const {
        return mutation_ != nullptr && mutation_->damage == damage && mutation_->place.is(at);
    }
    Order weakened(const Site& at, Damage damage, Order order) const {
        return damaged(at, damage) ? mutation_->order : order;
    }
    std::uint64_t look(std::uint32_t word, Order order, Index& read, bool& open);
    void check_race(std::uint32_t word, bool writes, bool plain, const Site& at);

    Choices& choices_;
    Memory memory_;
    Reduction reduction_;
    Settings settings_;
    const Mutation* mutation_ = nullptr;
    AccessLog* log_ = nullptr;
    Context main_;
    std::vector<std::unique_ptr<Fiber>> fibers_;
    std::array<Thread, max_threads> threads_;
    std::array<std::uint8_t, max_threads> groups_{};
    std::size_t count_ = 0, turn_ = 0, steps_ = 0, idle_ = 0, fresh_from_ = 0, node_ = 0;
    bool starting_ = true, ending_ = false, redundant_ = false, somebody_died_ = false, traced_ = false;
    std::string failure_;
    std::vector<std::string> trace_;
};

} // namespace tandem::shm::model

#include "tests/shm/model/checker/access.hpp"
#include "tests/shm/model/checker/scheduler.hpp"
