// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/census/trial.hpp"

#include "apps/tandem/census/host_watch.hpp"
#include "apps/tandem/output/format.hpp"
#include "host/process/run_command.hpp"

#include <boost/algorithm/string/erase.hpp>
#include <chrono>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

fs::path programs() { return fs::read_symlink("/proc/self/exe").parent_path(); }

// Returns the message of `tandem ... build`, its last line, without what the table has in other columns.
std::string build_error(const process::CommandResult& build, const Candidate& candidate) {
    std::istringstream lines(build.output);
    std::string message;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("tandem: ")) message = line.substr(8);
    if (message.empty()) return "the build " + build.failure();
    boost::erase_all(message, " (the compiler's output is above)");
    boost::erase_all(message, candidate.folder.string() + "/");
    if (message.starts_with("component ")) {
        const auto colon = message.find(": ");
        if (message.substr(0, colon).ends_with(" does not compile")) message.erase(0, colon + 2);
    }
    return message;
}

process::CommandResult build(const CensusModel& model, const Candidate& candidate, const fs::path& output,
                             double limit_s) {
    process::CommandOptions options;
    // Each of the two steps has this limit, so the command that runs both gets a longer one.
    options.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(1000 * (2 * limit_s + 30)));
    options.merge_errors = true;
    options.stop_on_signal = true;
    return process::run_command({(programs() / "tandem").string(), model.name, "build",
                                 candidate.folder.string(), model.build_name,
                                 candidate.profile.empty() ? candidate.name : candidate.profile.string(),
                                 "--output", output.string(), "--timeout", fmt::format("{}", limit_s)},
                                options);
}

// Returns the library in the output folder.
fs::path library_in(const fs::path& output) {
    for (const auto& entry : fs::directory_iterator(output))
        if (entry.path().extension() == ".so") return entry.path();
    throw std::runtime_error("the build produced no library");
}

} // namespace

TrialResult try_component(const CensusModel& model, const Candidate& candidate, const fs::path& folder,
                          const TrialLimits& limits, hosts::Supervisor& supervisor) {
    TrialResult result;
    if (!candidate.error.empty()) {
        result.error = candidate.error;
        return result;
    }
    const auto output = folder / "built", work = folder / "work";
    try {
        const auto built = build(model, candidate, output, limits.build_s);
        result.interrupted = built.stop_signal != 0;
        result.built = built.succeeded();
        if (!result.built) {
            result.error = build_error(built, candidate);
            return result;
        }
        auto command = model.load(candidate, library_in(output));
        result.loads = true;
        fs::create_directories(work);
        command.front() = (programs() / command.front()).string();
        for (const char* option : {"--grace", "1", "--parent-death"}) command.emplace_back(option);
        const auto host = watch_host(supervisor, command, work.string(), limits.run_s);
        result.runs = host.runs;
        result.cycles = host.cycles;
        result.interrupted = host.interrupted;
        result.error = host.error;
    } catch (const std::runtime_error& error) {
        result.error = error.what();
    }
    return result;
}

} // namespace tandem::command
