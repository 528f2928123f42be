// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/census/census.hpp"

#include "apps/tandem/build/plugin_build.hpp"
#include "apps/tandem/census/confinement.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <unistd.h>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

struct Shelf {
    std::vector<Candidate> candidates;
    std::size_t without_source = 0;
};

Shelf find_all(const CensusModel& model, const std::vector<fs::path>& folders) {
    Shelf shelf;
    std::set<std::pair<fs::path, std::string>> known; // a folder may be below another one
    for (const auto& folder : folders) {
        require_folder(folder);
        for (auto& each : model.find(fs::canonical(folder), shelf.without_source))
            if (known.emplace(each.profile.empty() ? each.folder : each.profile, each.name).second)
                shelf.candidates.push_back(std::move(each));
    }
    if (!shelf.candidates.empty()) return shelf;
    throw std::runtime_error(fmt::format(
        "no component with sources in the folders: `tandem {} build --help` says what a component is",
        model.name));
}

/// Counts and prints results as they come.
class Report {
  public:
    Report(const Shelf& shelf, bool json) : shelf_(shelf), json_(json) {
        for (const auto& each : shelf.candidates) {
            name_width_ = std::max(name_width_, each.name.size());
            folder_width_ = std::max(folder_width_, shown(each.folder).size());
        }
        if (!json_) print_row({"COMPONENT", "FOLDER", "BUILT", "LOADS", "CYCLES", "FIRST ERROR"});
    }

    void begin(const Candidate& candidate) {
        ++begun_;
        if (isatty(STDERR_FILENO) == 0) return;
        print_note(fmt::format("{}/{} {} in {} ...\n", begun_, shelf_.candidates.size(), candidate.name,
                               candidate.folder.string()));
    }

    void add(const Candidate& candidate, const TrialResult& result) {
        built_ += result.built ? 1 : 0;
        loads_ += result.loads ? 1 : 0;
        runs_ += result.runs ? 1 : 0;
        if (json_)
            rows_.push_back(
                {{"component", candidate.name},
                 {"folder", candidate.folder.string()},
                 {"built", result.built},
                 {"loads", result.loads},
                 {"runs", result.runs},
                 {"cycles", result.cycles},
                 {"error", result.error.empty() ? nlohmann::json() : nlohmann::json(result.error)}});
        else
            print_row({candidate.name, shown(candidate.folder), result.built ? "yes" : "no",
                       !result.built  ? "-"
                       : result.loads ? "yes"
                                      : "no",
                       !result.loads ? "-" : fmt::format("{}", result.cycles), result.error});
    }

    bool all_run() const { return runs_ == shelf_.candidates.size(); }

    void print_summary() const {
        if (json_)
            return print_json({{"components", rows_},
                               {"found", shelf_.candidates.size()},
                               {"built", built_},
                               {"load", loads_},
                               {"run", runs_},
                               {"profiles_without_source", shelf_.without_source}});
        const auto without = shelf_.without_source;
        const std::string note =
            without == 0 ? ""
                         : fmt::format("; {} component profile{} no source beside {}", without,
                                       without == 1 ? " has" : "s have", without == 1 ? "it" : "them");
        print_text(fmt::format("{} component{}: {} built, {} load, {} run{}\n", shelf_.candidates.size(),
                               shelf_.candidates.size() == 1 ? "" : "s", built_, loads_, runs_, note));
    }

  private:
    static std::string shown(const fs::path& folder) {
        return replace_control_characters(folder.lexically_proximate(fs::current_path()).string());
    }

    void print_row(const std::array<std::string, 6>& cells) const {
        const auto line = fmt::format(
            "{:<{}}  {:<{}}  {:<5}  {:<5}  {:>6}  {}", replace_control_characters(cells[0]), name_width_,
            cells[1], folder_width_, cells[2], cells[3], cells[4], replace_control_characters(cells[5]));
        print_data(line.substr(0, line.find_last_not_of(' ') + 1) + "\n");
    }

    const Shelf& shelf_;
    bool json_;
    std::size_t name_width_ = 9, folder_width_ = 6, begun_ = 0, built_ = 0, loads_ = 0, runs_ = 0;
    nlohmann::json rows_ = nlohmann::json::array();
};

} // namespace

int census(const CensusModel& model, const CensusOptions& options) {
    const auto shelf = find_all(model, options.folders);
    // Before any child process, so that it also gets the signals of those.
    hosts::Supervisor supervisor;
    Confinement confinement;
    Report report(shelf, options.json);
    for (const auto& candidate : shelf.candidates) {
        report.begin(candidate);
        const auto result = try_component(model, candidate, confinement.folder(), options.limits, supervisor);
        confinement.clean();
        if (result.interrupted || supervisor.watch(std::chrono::milliseconds(0)).interrupted)
            throw std::runtime_error("the census was interrupted at component " + candidate.name);
        report.add(candidate, result);
    }
    report.print_summary();
    return report.all_run() ? 0 : 2;
}

} // namespace tandem::command
