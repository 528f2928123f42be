// SPDX-License-Identifier: Apache-2.0
// A ring of cells in the model, values whose content tells which one they are, and the scenarios.
#pragma once
#include "host/rt/cell_ring.hpp"
#include "tests/shm/model/scenarios/case.hpp"

#include <array>
#include <memory>
#include <vector>

namespace tandem::shm::model {

class CellRingWorld {
  public:
    using A = ModelAtomics;
    enum class Length { one_word, two_words, longer };

    CellRingWorld(Execution& execution, std::size_t depth)
        : execution_(execution), ring_(depth), values_(std::make_unique<A::Cell[]>(depth + 3)) {}

    void write(Length length) {
        const std::uint64_t number = ++published_;
        if (length == Length::longer) {
            A::copy_plain_to_shared(&values_[ring_.writers()], &number, sizeof number);
            dropped_ += ring_.publish() ? 1 : 0;
            return;
        }
        const std::array<std::uint64_t, 2> bytes{number, number};
        dropped_ += ring_.publish_short(bytes.data(), length == Length::one_word ? 8 : 16) ? 1 : 0;
    }

    bool read() {
        if (!ring_.take()) return false;
        const std::uint64_t number = number_of_taken();
        require(number > last_, "no value comes twice or late");
        require(peeked_ == 0 || number >= peeked_, "what was looked at is taken, or dropped");
        last_ = number;
        peeked_ = 0;
        ++received_;
        return true;
    }
    bool peek() {
        if (!ring_.peek()) return false;
        peeked_ = number_of_taken();
        ++looks_;
        require(peeked_ > last_, "no value that was taken is looked at");
        return true;
    }
    bool empty() const { return ring_.empty(); }
    std::uint64_t last() const { return last_; }

    /// At rest: all that can be read is read, and everything adds up.
    void check_at_end() {
        const std::uint64_t waiting = ring_.size();
        // A value that is dropped after a look at it is not reported.
        const std::uint64_t known = received_ + dropped_ + waiting;
        require(known <= published_ && known + looks_ >= published_,
                "published = received + dropped + waiting");
        for (std::uint64_t i = 0; i < waiting; ++i)
            require(!ring_.empty() && read(), "what waits can be read");
        require(ring_.empty() && !read(), "the ring can be emptied");
        require(last_ == published_, "the newest value is read last");
        require(ring_.taken() == published_ && ring_.published() == published_, "the counts of both ends");
    }
    void require(bool holds, const char* claim) { execution_.require(holds, claim); }

  private:
    std::uint64_t number_of_taken() {
        std::array<std::uint64_t, 2> found{};
        const auto* const value = ring_.taken_short();
        if (value == nullptr) {
            A::copy_plain_from_shared(found.data(), &values_[ring_.readers()], sizeof found[0]);
            return found[0];
        }
        require(value->size() == 8 || value->size() == 16, "a short value has the size that was written");
        std::memcpy(found.data(), value->bytes(), value->size());
        require(value->size() == 8 || found[0] == found[1], "a short value is whole");
        return found[0];
    }

    Execution& execution_;
    rt::BasicCellRing<A> ring_;
    std::unique_ptr<A::Cell[]> values_;
    std::uint64_t published_ = 0, dropped_ = 0;                      // the writer's
    std::uint64_t received_ = 0, last_ = 0, peeked_ = 0, looks_ = 0; // the reader's
};

struct CellRingPlan {
    using Length = CellRingWorld::Length;
    const char* name;
    std::size_t depth;
    std::vector<Length> writes;
    int reads;
    bool peeks = false;
    bool small = true; ///< a search of it is complete in the default size of a test
    int waiting = 0;   ///< values that are there before the threads begin, long ones
};

inline void run_cell_ring(const CellRingPlan& plan, Execution& execution) {
    CellRingWorld world(execution, plan.depth);
    for (int i = 0; i < plan.waiting; ++i) world.write(CellRingPlan::Length::longer);
    execution.thread("writer", [&] {
        for (const auto length : plan.writes) world.write(length);
    });
    execution.thread("reader", [&] {
        for (int i = 0; i < plan.reads; ++i) {
            if (plan.peeks) world.peek();
            const bool finds_one = plan.peeks ? world.peek() : !world.empty();
            if (finds_one) world.require(world.read(), "a ring that has a value never looks empty");
        }
    });
    execution.run();
    world.check_at_end();
}

inline std::vector<Case> cell_ring_cases() {
    constexpr auto one = CellRingPlan::Length::one_word, two = CellRingPlan::Length::two_words,
                   longer = CellRingPlan::Length::longer;
    const std::vector<CellRingPlan> plans{
        {"two values with a depth of 1", 1, {two, two}, 1},
        {"three values with a depth of 1", 1, {one, one, one}, 2},
        {"three values with a depth of 2", 2, {one, one, one}, 2},
        {"four values with a depth of 2", 2, {one, one, one, one}, 2, false, false},
        {"four values with a depth of 3", 3, {one, one, one, one}, 2, false, false},
        {"two values after two with a depth of 2", 2, {one, one}, 2, false, false, 2},
        {"a long value after a short one", 1, {one, longer}, 1},
        {"a short value after a long one", 1, {longer, one}, 2},
        {"a long value in the cell of a short one", 1, {one, one, longer}, 2, false, false},
        {"long values", 1, {longer, longer}, 2},
        {"long values with a depth of 2", 2, {longer, longer, longer}, 2},
        {"long values whose memory is used again", 2, {longer, longer, longer, longer}, 2, false, false, 2},
        {"all lengths with a depth of 2", 2, {two, longer, one}, 2, false, false},
        {"a look at values that are dropped", 1, {one, two}, 2, true},
        {"a look at values with a depth of 2", 2, {one, longer, one}, 2, true, false},
        {"a look at values that waited with a depth of 2", 2, {one, one}, 2, true, false, 2},
    };
    std::vector<Case> cases;
    for (const auto& plan : plans)
        cases.push_back({plan.name, [plan](Execution& execution) { run_cell_ring(plan, execution); },
                         Settings{}, plan.small});
    return cases;
}

} // namespace tandem::shm::model
