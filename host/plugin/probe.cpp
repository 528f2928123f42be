// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/probe.hpp"

#include "host/plugin/error.hpp"
#include "host/plugin/probe_protocol.hpp"
#include "host/process/run_command.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <locale>
#include <sstream>
#include <system_error>

namespace tandem::plugin {
namespace {

// Limits the output of the library's code, so that this process does not run out of memory.
constexpr std::size_t max_report_bytes = std::size_t{16} << 20, max_error_bytes = 4096;

/// The child's report, as far as it has been written (probe_protocol.hpp).
struct Report {
    std::string stage;   ///< the library's function that ran last
    std::string failure; ///< why the task failed
    std::string result;
    bool done = false; ///< the task has ended
};

// The library's code may write to the same descriptor between the child's lines. Therefore lines without a known tag
// are skipped.
Report read_report(const std::string& text) {
    Report report;
    std::istringstream lines(text);
    const auto starts = [](const std::string& line, const char* tag) { return line.rfind(tag, 0) == 0; };
    for (std::string line; std::getline(lines, line);) {
        if (starts(line, stage_tag)) report.stage = line.substr(std::strlen(stage_tag));
        if (starts(line, failed_tag)) report.failure = line.substr(std::strlen(failed_tag));
        if (line + "\n" == done_line) report.done = true;
        if (!starts(line, result_tag)) continue;
        // The number may be forged, but a result is never longer than the whole report.
        const auto bytes = std::strtoull(line.c_str() + std::strlen(result_tag), nullptr, 10);
        report.result.resize(std::min<std::size_t>(bytes, text.size()));
        lines.read(report.result.data(), static_cast<std::streamsize>(report.result.size()));
    }
    return report;
}

// Returns the last line on standard error, or the text from where std::terminate() begins, as one printable line.
std::string last_error(const std::string& errors) {
    std::string text = errors.substr(0, errors.find_last_not_of(" \n") + 1);
    auto start = text.find("terminate called");
    if (start == std::string::npos) start = text.rfind('\n') + 1; // npos + 1 is the beginning
    text.erase(0, start);
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }, ' ');
    const auto doubled = [](char a, char b) { return a == ' ' && b == ' '; };
    text.erase(std::unique(text.begin(), text.end(), doubled), text.end());
    if (text.size() > 200) text.resize(200);
    return text.empty() ? "" : ": " + text;
}

std::string seconds_text(std::chrono::milliseconds time) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << static_cast<double>(time.count()) / 1000 << " s";
    return text.str();
}

// Returns how the child ended without a complete report.
std::string reason(const ProbeOptions& options, const process::CommandResult& end, const Report& report) {
    const std::string where = report.stage.empty() ? "the probe" : report.stage;
    if (end.timed_out) return "did not return from " + where + " within " + seconds_text(options.timeout);
    if (end.status.signalled)
        return "crashed in " + where + " with signal " + std::to_string(end.status.code) + " (" +
               strsignal(end.status.code) + ")" + last_error(end.errors);
    return "ended the process in " + where + " with exit code " + std::to_string(end.status.code) +
           last_error(end.errors);
}

} // namespace

std::string run_probe(const ProbeOptions& options, const std::string& task,
                      const std::filesystem::path& library, const std::vector<std::string>& arguments) {
    std::vector<std::string> command{options.program.string(), probe_argument, task, library.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    process::CommandOptions child;
    child.timeout = options.timeout;
    child.capture_report = true;
    child.discard_output = true; // keeps a library's output during loading out of every log
    child.max_output = max_report_bytes;
    child.max_errors = max_error_bytes;
    process::CommandResult end;
    try {
        end = process::run_command(command, child);
    } catch (const std::system_error& error) {
        throw Error(Reason::probe_failed, options.subject + " " + library.string() +
                                              " cannot be tried in a child process: " + error.what());
    }
    const Report report = read_report(end.report);
    // A complete report counts even if a static destructor of the child has crashed afterwards.
    if (report.done && !end.timed_out) return report.result;
    if (!report.failure.empty()) throw Error(Reason::probe_failed, report.failure);
    throw Error(Reason::probe_failed, options.subject + " " + library.string() + " " +
                                          reason(options, end, report) + " (tried in a child process)");
}

} // namespace tandem::plugin
