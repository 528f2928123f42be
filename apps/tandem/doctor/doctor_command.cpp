// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/shm/shm_commands.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

using doctor::CheckStatus;

const char* to_string(CheckStatus status) {
    return status == CheckStatus::ok ? "ok" : status == CheckStatus::warning ? "warn" : "bad";
}

std::string format_results(const std::vector<doctor::CheckResult>& results) {
    Table table({"", "", ""});
    for (const auto& result : results) table.add_row({to_string(result.status), result.name, result.value});
    std::string text = table.text();
    std::string advice;
    for (const auto& result : results)
        if (result.status != CheckStatus::ok) advice += fmt::format("  {}: {}\n", result.name, result.advice);
    return text.substr(text.find('\n') + 1) + (advice.empty() ? "" : "\nWhat to do:\n" + advice);
}

nlohmann::json to_json(const std::vector<doctor::CheckResult>& results) {
    auto list = nlohmann::json::array();
    for (const auto& result : results) {
        list.push_back(
            {{"name", result.name}, {"verdict", to_string(result.status)}, {"seen", result.value}});
        if (!result.advice.empty()) list.back()["advice"] = result.advice;
    }
    return {{"findings", list}};
}

} // namespace

int shm_doctor(bool json) {
    const auto results = doctor::run_checks(doctor::probe_this_machine());
    if (json)
        print_json(to_json(results));
    else
        print_text(format_results(results));
    const bool any_error = std::any_of(results.begin(), results.end(), [](const auto& result) {
        return result.status == CheckStatus::error;
    });
    return any_error ? 1 : 0;
}

} // namespace tandem::command
