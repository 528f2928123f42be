// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/setup_error.hpp"

#include <algorithm>

namespace tandem::engine {
namespace {

/// Names and values quoted from profiles may contain any characters, but tools and logs expect one line per error.
std::string to_one_line(std::string text) {
    constexpr std::size_t max_length = 2000;
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
    return text.size() > max_length ? text.substr(0, max_length) + "..." : text;
}

} // namespace

SetupError::SetupError(const std::string& what) : std::runtime_error(to_one_line(what)) {}

} // namespace tandem::engine
