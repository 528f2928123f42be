// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tandem::doctor {

/// ok: no problem. warning: works, but slower or less predictably, or is open to others. error: Tandem does not run,
/// fails after some time, or is open to every user.
enum class CheckStatus { ok, warning, error };

/// The result of one check on a machine.
struct CheckResult {
    std::string name; ///< name of the check, the same on every machine
    CheckStatus status;
    std::string value;  ///< the finding, in one line
    std::string advice; ///< the reason, a colon and the remedy, in one line; empty if ok
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
