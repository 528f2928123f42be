// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tandem::doctor {

/// ok: as it should be. warn: works, but slower or less predictable. bad: Tandem will not run, or not for
/// long.
enum class Verdict { ok, warn, bad };

struct Finding {
    std::string name; ///< what was looked at
    Verdict verdict;
    std::string seen;   ///< the value
    std::string advice; ///< what to do about it, one line; empty if ok
};

inline Finding ok(std::string name, std::string seen) {
    return {std::move(name), Verdict::ok, std::move(seen), {}};
}
inline Finding warn(std::string name, std::string seen, std::string advice) {
    return {std::move(name), Verdict::warn, std::move(seen), std::move(advice)};
}
inline Finding bad(std::string name, std::string seen, std::string advice) {
    return {std::move(name), Verdict::bad, std::move(seen), std::move(advice)};
}

} // namespace tandem::doctor
