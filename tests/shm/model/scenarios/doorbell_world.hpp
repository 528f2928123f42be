// SPDX-License-Identifier: Apache-2.0
// A doorbell in the model: ports that have data or not, ringers that publish, an owner that waits for all of
// them. An owner waits without bound, so a wake-up that is lost leaves it asleep for ever, which is a
// failure.
#pragma once
#include "shm/wait/basic_doorbell.hpp"
#include "tests/shm/model/checker/model.hpp"

#include <utility>

namespace tandem::shm::model {

class DoorbellWorld {
  public:
    using A = ModelAtomics;
    using Bell = BasicDoorbell<A>;
    static constexpr auto for_ever = longest_wait;

    DoorbellWorld(Execution& execution, unsigned ports, WaitOptions how)
        : execution_(execution), ports_(ports), how_(how) {}

    /// Data first, then the bell: as every user does it.
    void put(unsigned port) { data_[port].store(1, Order::release); }
    void publish(unsigned port) {
        put(port);
        theirs.ring(port);
    }

    /// Waits by bits until `ports` of them, or all, have had data.
    void wait(unsigned ports = all) {
        while (count_ < std::min(ports, ports_)) {
            const ReadyBits bits = mine.wait(for_ever, how_);
            execution_.require(bits.any(), "a wait without a bound ends with a bit");
            for (unsigned port = 0; port < ports_; ++port)
                if (bits.test(port)) see(port);
        }
    }

    /// Waits like wait(), but by a condition on the data instead of bits.
    void look(unsigned ports = all) {
        while (count_ < std::min(ports, ports_)) look_once(for_ever);
    }
    void look_once(std::chrono::nanoseconds bound) {
        mine.wait_for([&] { return any_new(); }, bound, how_);
        for (unsigned port = 0; port < ports_; ++port) see(port);
    }

    /// A wrong order that the checker must detect.
    void look_without_second_look() {
        while (count_ < ports_) {
            bool first = true;
            mine.wait_for([&] { return std::exchange(first, false) && any_new(); }, for_ever, how_);
            for (unsigned port = 0; port < ports_; ++port) see(port);
        }
    }

    static constexpr unsigned all = 64;

  private:
    bool any_new() const {
        for (unsigned port = 0; port < ports_; ++port)
            if (!seen_[port] && data_[port].load(Order::acquire) != 0) return true;
        return false;
    }
    void see(unsigned port) {
        if (seen_[port] || data_[port].load(Order::acquire) == 0) return;
        seen_[port] = true;
        ++count_;
    }

    Execution& execution_;
    unsigned ports_, count_ = 0;
    WaitOptions how_;
    std::array<A::Atomic<std::uint64_t>, 4> data_;
    std::array<bool, 4> seen_{};
    layout::BasicDoorbellWords<A> words_{};

  public:
    Bell mine{words_}, theirs{words_};
};

} // namespace tandem::shm::model
