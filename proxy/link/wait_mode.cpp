// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/wait_mode.hpp"

#include "proxy/link/protocol/link_error.hpp"

#include <cstdlib>
#include <string_view>
#include <utility>

namespace tandem::link {

shm::WaitOptions wait_options_from_environment() {
    using enum shm::WaitMode;
    constexpr std::pair<std::string_view, shm::WaitMode> modes[] = {
        {"spin", spin}, {"spin-then-futex", spin_then_futex}, {"futex", futex}, {"same-core", same_core}};
    shm::WaitOptions options;
    const char* const history = std::getenv("TANDEM_CALL_HISTORY");
    options.keep_history = history != nullptr && std::string_view(history) == "1";
    const char* requested = std::getenv("TANDEM_WAIT_MODE");
    if (requested == nullptr) return options;
    for (const auto& [name, mode] : modes) {
        options.mode = mode;
        if (name == requested) return options;
    }
    throw LinkError(std::string("TANDEM_WAIT_MODE is '") + requested +
                    "': expected spin, spin-then-futex, futex or same-core");
}

} // namespace tandem::link
