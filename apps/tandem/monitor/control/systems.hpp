// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/control/background_program.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tandem::monitor {

/// The systems in the folder that `tandem monitor --systems` names, and the runs of them that pages have started. All
/// functions with a name throw std::invalid_argument with one line unless it is that of a folder directly in this one.
/// [one thread]
class Systems {
  public:
    static constexpr std::size_t max_runs = 4;

    /// `program`: path of tandem. Throws std::runtime_error if the folder does not exist.
    Systems(const std::filesystem::path& folder, std::string program);
    ~Systems(); ///< ends the runs cleanly

    /// Return the command that lists the folder, writes a new system, or saves the hosts with these process ids.
    std::vector<std::string> list_command() const;
    std::vector<std::string> new_command(const std::string& name,
                                         const std::vector<std::string>& components) const;
    std::vector<std::string> save_command(const std::string& name, const std::vector<std::string>& hosts,
                                          bool replace) const;

    /// Starts `tandem run` with the log NAME/run.log. Also throws std::invalid_argument if it already runs (even if another
    /// monitor has started it), or if max_runs systems run.
    void start(const std::string& name);
    /// Asks a run to end. Throws std::invalid_argument if it does not run.
    void stop(const std::string& name);
    /// Returns the runs, including those that have ended: [{"name", "running", "since_ms", "end"}]. Keeps their logs bounded.
    nlohmann::json runs();
    /// Returns the last 64 KiB of the log of the newest run; empty if there is none.
    std::string log(const std::string& name) const;

  private:
    struct Run {
        Run(const std::vector<std::string>& command, int output, process::FileDescriptor&& file)
            : program(command, output), log(std::move(file)) {}
        BackgroundProgram program;
        process::FileDescriptor log; ///< locked; none after the end
    };
    std::filesystem::path existing(const std::string& name) const;
    std::filesystem::path writable(const std::string& name) const; ///< exists, or does not exist yet
    std::size_t count_running();

    std::filesystem::path folder_;
    std::string program_;
    std::map<std::string, Run> runs_;
};

} // namespace tandem::monitor
