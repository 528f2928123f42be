// SPDX-License-Identifier: Apache-2.0
// Leaves out executions that differ only in the order of steps that do not depend on each other: dynamic
// partial order reduction with source sets and sleep sets (Abdulla, Aronis, Jonsson, Sagonas, POPL 2014).
// When a step is found to depend on an earlier one of another thread, and nothing else orders the two, the
// search is asked to try, before the earlier one, what leads to the later one without it.
//
// One rule is particular to this memory model. A load that is not seq_cst may, after a store to its word,
// still read what it could read before. So "store, then load" covers "load, then store", and the search need
// not turn it round; and when such a load was explored before the store already, it need only read the new
// one.
#pragma once
#include "tests/shm/model/checker/choices.hpp"

#include <algorithm>

namespace tandem::shm::model {

class Reduction {
  public:
    using Clock = std::array<std::uint32_t, max_threads>;

    struct Step {
        std::uint8_t thread;
        Operation operation;
        std::size_t node;    ///< of the choice that let it run
        std::uint32_t count; ///< of the thread's steps so far
        Index stored;        ///< the store it made, 0 = none
        bool open;           ///< a seq_cst load of the word could have read more than one store
        Clock clock{};       ///< the steps of each thread that this one depends on, itself included
    };

    /// `groups`: the process of each thread.
    void begin(const std::array<std::uint8_t, max_threads>& groups) {
        groups_ = groups;
        steps_.clear();
        total_order_.clear();
        for (auto& word : words_) word.clear();
        for (auto& clock : threads_) clock = {};
        fences_ = total_ = {};
    }

    /// Asks the search to turn round the steps that the next operation of `thread` competes with.
    /// `impatient`: a load that may not read all that the memory model allows.
    void turn_round(Choices& choices, std::size_t thread, const Operation& operation,
                    bool impatient = false) {
        if (operation.is_plain_look() && !impatient) return;
        found_.clear();
        const auto look_at = [&](const std::vector<std::uint32_t>& indices) {
            for (const std::uint32_t index : indices)
                if (competes(steps_[index], thread, operation)) found_.push_back(index);
        };
        if (operation.kind == Kind::end) {
            for (std::uint32_t i = 0; i < steps_.size(); ++i)
                if (competes(steps_[i], thread, operation)) found_.push_back(i);
        } else {
            if (operation.location != no_location) look_at(word(operation.location).steps);
            if (operation.queue != no_location) look_at(word(operation.queue).steps);
            if (operation.in_total_order()) look_at(total_order_);
            look_at(word(end_word(thread)).steps);
        }
        std::sort(found_.begin(), found_.end(), std::greater<>());
        Clock clock = threads_[thread];
        const auto ordered = [&](std::uint32_t index) { // by a later step that this one depends on
            const Step& step = steps_[index];
            const bool is = clock[step.thread] >= step.count;
            join(clock, step.clock);
            return is;
        };
        found_.erase(std::remove_if(found_.begin(), found_.end(), ordered), found_.end());
        for (const std::uint32_t index : found_) ask(choices, index, thread, clock);
    }

    /// `read`: the store that was read.
    void done(const Step& step, Index read) {
        const auto index = static_cast<std::uint32_t>(steps_.size());
        const Operation& operation = step.operation;
        Clock& clock = threads_[step.thread];
        clock[step.thread] = step.count;
        if (operation.location != no_location) {
            Word& place = word(operation.location);
            if (step.stored != 0 || operation.kind == Kind::end) {
                join(clock, place.all);
                if (place.stores.size() <= step.stored) place.stores.resize(step.stored + 1U);
                place.stores[step.stored] = clock;
            } else if (read < place.stores.size()) {
                join(clock, place.stores[read]);
            }
        }
        if (operation.queue != no_location) join(clock, word(operation.queue).all);
        if (operation.in_total_order()) join(clock, operation.is_fence() ? total_ : fences_);
        if (operation.location != no_location) word(operation.location).add(index, clock);
        if (operation.queue != no_location) word(operation.queue).add(index, clock);
        if (operation.in_total_order()) {
            total_order_.push_back(index);
            join(total_, clock);
            if (operation.is_fence()) join(fences_, clock);
        }
        steps_.push_back(step);
        steps_.back().clock = clock;
    }

    /// The next step of `thread` was made possible by the last ones on a word.
    void after_word(std::size_t thread, std::uint32_t location) {
        join(threads_[thread], word(location).all);
    }

    /// A step that happens only because nothing else could: after everything.
    void after_all(std::size_t thread) {
        for (const auto& clock : threads_) join(threads_[thread], clock);
    }

    /// Returns the threads that may still sleep after the last step, from the choice that selected it and the next steps of the
    /// threads.
    Sleep sleep_after(const Node& node, const std::array<Operation, max_threads>& next) const {
        const Step& last = steps_.back();
        Sleep sleep = node.sleep;
        for (std::size_t i = 0; i < max_threads; ++i) {
            if ((node.done >> i & 1U) != 0) sleep[i] = asleep;
            if (i == last.thread) sleep[i] = awake;
            if (sleep[i] == awake || !competes_with(last, i, next[i])) continue;
            const bool new_store =
                next[i].is_plain_look() && last.stored != 0 && last.operation.location == next[i].location;
            sleep[i] = new_store ? std::min(sleep[i], last.stored) : awake;
        }
        return sleep;
    }

    bool any() const { return !steps_.empty(); }
    std::size_t last_node() const { return steps_.back().node; }

  private:
    struct Word {
        std::vector<std::uint32_t> steps;
        std::vector<Clock> stores;
        Clock all{};
        void clear() {
            steps.clear();
            stores.clear();
            all = {};
        }
        void add(std::uint32_t index, const Clock& clock) {
            steps.push_back(index);
            join(all, clock);
        }
    };

    static void join(Clock& clock, const Clock& other) {
        for (std::size_t i = 0; i < max_threads; ++i) clock[i] = std::max(clock[i], other[i]);
    }

    Word& word(std::uint32_t location) {
        if (words_.size() <= location) words_.resize(location + 1);
        return words_[location];
    }
    /// Where deaths of a process are noted: behind the real words.
    std::uint32_t end_word(std::size_t thread) const { return life_of(groups_[thread]); }

    bool competes_with(const Step& step, std::size_t thread, const Operation& operation) const {
        if (step.operation.kind == Kind::end && groups_[thread] == step.operation.group) return true;
        if (operation.kind == Kind::end && groups_[step.thread] == operation.group) return true;
        return dependent(step.operation, operation, step.open);
    }
    bool competes(const Step& step, std::size_t thread, const Operation& operation) const {
        return step.thread != thread && threads_[thread][step.thread] < step.count &&
               competes_with(step, thread, operation);
    }

    /// `clock`: all that the next step of `thread` depends on. Collects the steps since `index` that do not depend on it,
    /// followed by the next step. Then selects a thread that can begin this sequence.
    void ask(Choices& choices, std::uint32_t index, std::size_t thread, const Clock& clock) {
        const Step& turned = steps_[index];
        Node& node = choices.node(turned.node);
        Threads seen = 0, begins = 0;
        Clock least; // of each thread, the first step since
        least.fill(~std::uint32_t{0});
        const auto consider = [&](std::size_t who, const Clock& depends) {
            if ((seen >> who & 1U) != 0) return;
            seen |= 1U << who;
            for (std::size_t i = 0; i < max_threads; ++i)
                if (i != who && depends[i] >= least[i]) return;
            begins |= 1U << who;
        };
        for (std::size_t i = index + 1; i < steps_.size(); ++i) {
            const Step& step = steps_[i];
            if (step.clock[turned.thread] >= turned.count) continue;
            consider(step.thread, step.clock);
            least[step.thread] = std::min(least[step.thread], step.count);
        }
        consider(thread, clock);
        const Threads useful = begins & node.enabled;
        if (useful == 0) {
            node.todo |= node.enabled;
            return;
        }
        Threads tried = node.todo | node.done | 1U << node.chosen;
        for (std::size_t i = 0; i < max_threads; ++i)
            if (node.sleep[i] == asleep) tried |= 1U << i;
        if ((useful & tried) == 0)
            node.todo |= (useful >> thread & 1U) != 0 ? 1U << thread : useful & (~useful + 1);
    }

    std::array<std::uint8_t, max_threads> groups_{};
    std::vector<Step> steps_;
    std::vector<Word> words_;
    std::vector<std::uint32_t> total_order_;
    std::vector<std::uint32_t> found_;
    std::array<Clock, max_threads> threads_{};
    Clock fences_{}, total_{};
};

} // namespace tandem::shm::model
