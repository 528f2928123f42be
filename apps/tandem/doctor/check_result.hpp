// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tandem::doctor {

/// ok: as it should be. warn: works, but slower or less predictable. bad: Tandem will not run, or not for
/// long.
enum class CheckStatus { ok, warning, error };

struct CheckResult {
    std::string name; ///< what was looked at
    CheckStatus status;
    std::string value;  ///< the value
    std::string advice; ///< what to do about it, one line; empty if ok
};

inline CheckResult ok(std::string name, std::string value) {
    return {std::move(name), CheckStatus::ok, std::move(value), {}};
}
inline CheckResult warning(std::string name, std::string value, std::string advice) {
    return {std::move(name), CheckStatus::warning, std::move(value), std::move(advice)};
}
inline CheckResult error(std::string name, std::string value, std::string advice) {
    return {std::move(name), CheckStatus::error, std::move(value), std::move(advice)};
}

} // namespace tandem::doctor
