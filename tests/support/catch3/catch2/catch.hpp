// SPDX-License-Identifier: Apache-2.0
// Gives Catch2 3 (Debian 13) the names of Catch2 2 (Debian 12) that the tests use. With Catch2 2, its own header of this name is
// found.
#pragma once
#include <catch2/catch_all.hpp>

using Catch::Approx;

namespace Catch {

using TestEventListenerBase = EventListenerBase;
using Matchers::EndsWith;
using Matchers::Predicate;
using Matchers::StartsWith;

inline auto Contains(const std::string& text) { return Matchers::ContainsSubstring(text); }

} // namespace Catch
