// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/probe.hpp"

#include "host/plugin/error.hpp"
#include "host/plugin/probe_protocol.hpp"
#include "host/process/run_command.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

namespace tandem::plugin {
namespace {

constexpr std::size_t max_report_bytes = std::size_t{16} << 20, max_error_bytes = 4096;

struct Report {
    std::string stage, failure, result;
    bool done = false;
};

// The library's own code may have written between the words: what is not understood is passed over.
Report read_report(const std::string& text) {
    Report report;
    std::istringstream lines(text);
    const auto starts = [](const std::string& line, const char* word) { return line.rfind(word, 0) == 0; };
    for (std::string line; std::getline(lines, line);) {
        if (starts(line, stage_tag)) report.stage = line.substr(std::strlen(stage_tag));
        if (starts(line, failed_tag)) report.failure = line.substr(std::strlen(failed_tag));
        if (line + "\n" == done_line) report.done = true;
        if (!starts(line, result_tag)) continue;
        const auto bytes = std::strtoull(line.c_str() + std::strlen(result_tag), nullptr, 10);
        report.result.resize(std::min<std::size_t>(bytes, text.size()));
        lines.read(report.result.data(), static_cast<std::streamsize>(report.result.size()));
    }
    return report;
}

// The last thing on standard error, or all that std::terminate() says.
std::string last_words(const std::string& errors) {
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

std::string bound_text(std::chrono::milliseconds bound) {
    std::ostringstream text;
    text << static_cast<double>(bound.count()) / 1000 << " s";
    return text.str();
}

std::string reason(const ProbeOptions& options, const process::CommandResult& end, const Report& report) {
    const std::string where = report.stage.empty() ? "the probe" : report.stage;
    if (end.timed_out) return "did not return from " + where + " within " + bound_text(options.timeout);
    if (end.status.signalled)
        return "crashed in " + where + " with signal " + std::to_string(end.status.code) + " (" +
               strsignal(end.status.code) + ")" + last_words(end.errors);
    return "ended the process in " + where + " with exit code " + std::to_string(end.status.code) +
           last_words(end.errors);
}

} // namespace

std::string run_probe(const ProbeOptions& options, const std::string& task,
                      const std::filesystem::path& library, const std::vector<std::string>& arguments) {
    std::vector<std::string> command{options.program.string(), probe_argument, task, library.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    process::CommandOptions child;
    child.timeout = options.timeout;
    child.capture_report = true;
    child.discard_output = true;
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
    if (report.done && !end.timed_out) return report.result;
    if (!report.failure.empty()) throw Error(Reason::probe_failed, report.failure);
    throw Error(Reason::probe_failed, options.subject + " " + library.string() + " " +
                                          reason(options, end, report) + " (tried in a child process)");
}

} // namespace tandem::plugin
