// SPDX-License-Identifier: Apache-2.0
// The target as libFuzzer and driver.cpp call it.
#include "fuzz_targets.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer looks for
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static tandem::shm::fuzz::FuzzTargets targets;
    tandem::shm::fuzz::Input input(data, size);
    targets.run(input);
    return 0;
}
