// SPDX-License-Identifier: Apache-2.0
// What the fuzzer attacks: one segment with rings of both directions, with and without chunks, a call queue and a
// blob, made once; and everything that can be done with them. The first side is hostile, the second one the
// victim.
#pragma once
#include "mutated_atomics.hpp"

#include "shm/segment.hpp"

namespace tandem::shm::fuzz {

class FuzzTargets {
  public:
    FuzzTargets();

    /// Runs one input. Ends the process if a result from shared memory is out of bounds.
    void run(Input& input);

  private:
    struct Object {
        std::string name;
        std::span<std::byte> hostile; ///< its memory as the first side sees it
    };
    enum class Restore { arena, all };

    void restore(Restore what);
    RingHandle ring(const Object& object) const;

    template <class A>
    void consume(Input& input, const Object& object);
    template <class A>
    void produce(Input& input, const Object& object);
    void read_with_shipping(Input& input, const Object& object);
    void write_with_shipping(Input& input, const Object& object);
    void call(Input& input);
    void serve(Input& input);
    void call_with_shipping(Input& input);
    void look_up(Input& input);
    void observe_it(Input& input);
    void follow(Input& input);

    std::string link_;
    std::unique_ptr<Segment> hostile_, victim_;
    std::vector<Object> to_victim_, from_victim_;
    Object queue_;
    std::span<std::byte> everything_, arena_;
    std::vector<std::byte> pristine_;
};

} // namespace tandem::shm::fuzz
