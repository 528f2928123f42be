// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/report.hpp"

#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"

#include <algorithm>

namespace tandem::command {
namespace {

template <class Lines, class Line>
void add_once(Lines& lines, Line line) {
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
}

/// The documentation has the same place relative to the programs in the build folder and in the installed tree.
std::filesystem::path find_page(const char* page) {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() /
           TANDEM_DOCUMENTATION_DIR / page;
}

} // namespace

void ImportReport::add_task(const std::string& where, const std::string& what, const std::string& command) {
    add_once(tasks_, Line{where, what, command});
}

void ImportReport::add_difference(const std::string& where, const std::string& what,
                                  const std::string& here) {
    add_once(differences_, Line{where, what, here});
}

void ImportReport::change_texts(const std::function<std::string(std::string)>& change) {
    for (auto& file : files_) file = change(file.string());
    for (auto* lines : {&tasks_, &differences_})
        for (Line& line : *lines) line = {change(line.where), change(line.what), change(line.here)};
}

void ImportReport::print(const std::filesystem::path& output, const char* page, const char* imported,
                         bool as_json) const {
    const std::string differences =
        find_page(page).string() + " lists the differences common to all " + imported;
    nlohmann::json json{
        {"folder", output.string()}, {"files", nlohmann::json::array()}, {"see", differences}};
    for (const auto& file : files_) json["files"].push_back(file.string());
    const auto add = [&](const char* key, const char* last, const std::vector<Line>& lines) {
        json[key] = nlohmann::json::array();
        for (const auto& line : lines)
            json[key].push_back({{"where", line.where}, {"what", line.what}, {last, line.here}});
    };
    add("tasks", "command", tasks_);
    add("differences", "here", differences_);
    if (as_json) return print_json(json);
    std::string text;
    for (const auto& file : files_) text += (text.empty() ? "written  " : "         ") + file.string() + "\n";
    const auto line = [&](const char* kind, const Line& each, const char* separator) {
        text += kind +
                replace_control_characters((each.where.empty() ? "" : each.where + ": ") + each.what +
                                           (each.here.empty() ? "" : separator + each.here)) +
                "\n";
    };
    for (const auto& each : tasks_) line("to do: ", each, "; ");
    for (const auto& each : differences_) line("differs: ", each, ": ");
    text += "always: " + differences + "\nnext: " + (tasks_.empty() ? "" : "do the tasks above, then run ") +
            "tandem run " + output.string() + "\n";
    print_text(text);
}

} // namespace tandem::command
