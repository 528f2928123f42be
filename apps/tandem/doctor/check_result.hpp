// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tandem::doctor {

/// ok: as it should be. warning: works, but slower or less predictable. error: Tandem will not run, or not for
/// long.
enum class CheckStatus { ok, warning, error };

/// What one check has found on a machine.
struct CheckResult {
    std::string name; ///< of the check, the same on every machine
    CheckStatus status;
    std::string value;  ///< what was found, in one line
    std::string advice; ///< what to do about it, in one line: why, a colon, how; empty if ok
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
