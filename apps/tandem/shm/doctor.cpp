// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/shm/shm_commands.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

using doctor::Verdict;

const char* word_of(Verdict verdict) {
    return verdict == Verdict::ok ? "ok" : verdict == Verdict::warn ? "warn" : "bad";
}

std::string text_of(const std::vector<doctor::Finding>& findings) {
    Table table({"", "", ""});
    for (const auto& finding : findings) table.add({word_of(finding.verdict), finding.name, finding.seen});
    std::string text = table.text();
    std::string advice;
    for (const auto& finding : findings)
        if (finding.verdict != Verdict::ok) advice += fmt::format("  {}: {}\n", finding.name, finding.advice);
    return text.substr(text.find('\n') + 1) + (advice.empty() ? "" : "\nWhat to do:\n" + advice);
}

nlohmann::json json_of(const std::vector<doctor::Finding>& findings) {
    auto list = nlohmann::json::array();
    for (const auto& finding : findings) {
        list.push_back(
            {{"name", finding.name}, {"verdict", word_of(finding.verdict)}, {"seen", finding.seen}});
        if (!finding.advice.empty()) list.back()["advice"] = finding.advice;
    }
    return {{"findings", list}};
}

} // namespace

int shm_doctor(bool json) {
    const auto findings = doctor::examine(doctor::this_machine());
    if (json)
        print_json(json_of(findings));
    else
        print_text(text_of(findings));
    const bool any_bad = std::any_of(findings.begin(), findings.end(),
                                     [](const auto& finding) { return finding.verdict == Verdict::bad; });
    return any_bad ? 1 : 0;
}

} // namespace tandem::command
