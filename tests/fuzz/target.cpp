// SPDX-License-Identifier: Apache-2.0
// The target as libFuzzer and driver.cpp call it.
#include "victims.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer looks for
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static tandem::shm::fuzz::Victims victims;
    tandem::shm::fuzz::Input input(data, size);
    victims.run(input);
    return 0;
}
