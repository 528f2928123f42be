// SPDX-License-Identifier: Apache-2.0
// Runs the fuzz target without libFuzzer, on inputs that follow from their number: fuzz_segment [COUNT
// [FIRST]].
#include "tests/support/stress.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <unistd.h>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int count, char** arguments) {
    const std::uint64_t first = count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 1;
    const std::uint64_t runs = count > 1 ? std::strtoull(arguments[1], nullptr, 10)
                                         : tandem::test::stress<std::uint64_t>(20'000, 10'000'000);
    using Clock = std::chrono::steady_clock;
    Clock::duration longest{};
    std::vector<std::uint8_t> input;
    for (std::uint64_t number = first; number < first + runs; ++number) {
        std::minstd_rand random(static_cast<std::uint32_t>(number * 2654435761U % 2147483646U + 1));
        input.resize(8 + random() % 500);
        for (auto& byte : input) byte = static_cast<std::uint8_t>(random() >> 8U);
        if (number % 1024 == 0) alarm(60); // an input without end is a finding, too
        const auto began = Clock::now();
        LLVMFuzzerTestOneInput(input.data(), input.size());
        longest = std::max(longest, Clock::now() - began);
    }
    std::printf(
        "%llu inputs from %llu on, the longest took %lld us\n", static_cast<unsigned long long>(runs),
        static_cast<unsigned long long>(first),
        static_cast<long long>(std::chrono::duration_cast<std::chrono::microseconds>(longest).count()));
}
