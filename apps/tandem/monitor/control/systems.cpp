// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/systems.hpp"

#include "apps/tandem/monitor/control/output_text.hpp"
#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace tandem::monitor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_shown = 64 << 10; ///< bytes of a log
constexpr off_t max_log = 16 << 20;

/// Throws unless the name is that of a link, as `tandem system new` needs it: it cannot lead to another folder.
const std::string& require_name(const std::string& name) {
    try {
        shm::check_link_name(name);
    } catch (const shm::Error&) { // its text would contain the name that a client has sent
        throw std::invalid_argument(
            "expected a name of 1 to 64 characters of A-Z a-z 0-9 _ -, the first not -");
    }
    return name;
}

/// Opens the log of a run, and empties it. `tandem run` inherits the lock, which lasts until it has ended, whatever becomes
/// of this monitor.
process::FileDescriptor open_log(const fs::path& file, const std::string& name) {
    process::FileDescriptor log(
        open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600));
    struct stat status {};
    if (!log || fstat(log.get(), &status) != 0)
        throw std::invalid_argument(fmt::format("{}: {}", file.string(), std::strerror(errno)));
    if (!S_ISREG(status.st_mode)) throw std::invalid_argument(file.string() + " is not a file: remove it");
    if (flock(log.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw std::invalid_argument(
            name +
            " is running, started by another monitor or by one that was killed: end its tandem run first");
    if (ftruncate(log.get(), 0) != 0)
        throw std::invalid_argument(fmt::format("{}: {}", file.string(), std::strerror(errno)));
    return log;
}

/// Returns the last 64 KiB of a log; empty if there is none.
std::string end_of(const fs::path& log) {
    const process::FileDescriptor file(open(log.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (file.get() < 0 || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return "";
    return last_lines(file.get(), max_shown);
}

/// Keeps the end of a log that has become long. Lines that arrive meanwhile are lost.
void shorten(const fs::path& log, int file) {
    struct stat status {};
    if (fstat(file, &status) != 0 || status.st_size <= max_log) return;
    const std::string text = "(older lines are removed: the log had more than 16 MiB)\n" + end_of(log);
    if (ftruncate(file, 0) != 0) return;
    [[maybe_unused]] const auto written = write(file, text.data(), text.size()); // fails if the disk is full
}

} // namespace

Systems::Systems(const fs::path& folder, std::string program)
    : folder_(fs::weakly_canonical(folder)), program_(std::move(program)) {
    if (!fs::is_directory(folder_))
        throw std::runtime_error(folder.string() + " is not a folder: --systems needs an existing one");
}

Systems::~Systems() {
    for (auto& [name, run] : runs_) run.program.stop(); // all of them, before the first is waited for
}

fs::path Systems::existing(const std::string& name) const {
    fs::path path = folder_ / require_name(name);
    struct stat folder {};
    struct stat own {};
    if (lstat(path.c_str(), &own) != 0 || !S_ISDIR(own.st_mode) || stat(folder_.c_str(), &folder) != 0)
        throw std::invalid_argument(fmt::format("{} has no folder {}", folder_.string(), name));
    if ((folder.st_mode & S_IWOTH) != 0 && own.st_uid != geteuid())
        throw std::invalid_argument(fmt::format(
            "{} belongs to another user, in a folder that all users may write to", path.string()));
    return path;
}

fs::path Systems::writable(const std::string& name) const {
    std::error_code missing;
    const fs::path path = folder_ / require_name(name);
    return fs::symlink_status(path, missing).type() == fs::file_type::not_found ? path : existing(name);
}

std::vector<std::string> Systems::list_command() const {
    return {program_, "system", "list", folder_.string(), "--json"};
}

std::vector<std::string> Systems::new_command(const std::string& name,
                                              const std::vector<std::string>& components) const {
    std::vector<std::string> command{program_, "system", "new", writable(name).string()};
    for (const auto& component : components) command.push_back(existing(component).string());
    return command;
}

std::vector<std::string> Systems::save_command(const std::string& name, const std::vector<std::string>& hosts,
                                               bool replace) const {
    std::vector<std::string> command{program_, "system", "save", writable(name).string()};
    for (const auto& host : hosts) command.insert(command.end(), {"--host", host});
    if (replace) command.emplace_back("--replace");
    return command;
}

std::size_t Systems::count_running() {
    return static_cast<std::size_t>(
        std::count_if(runs_.begin(), runs_.end(), [](auto& run) { return !run.second.program.look(); }));
}

void Systems::start(const std::string& name) {
    const fs::path path = existing(name);
    if (const auto run = runs_.find(name); run != runs_.end() && !run->second.program.look())
        throw std::invalid_argument(name + " runs");
    if (count_running() >= max_runs)
        throw std::invalid_argument(
            fmt::format("{} systems started from pages are running: stop one first", max_runs));
    runs_.erase(name); // with the lock of its log
    auto log = open_log(path / "run.log", name);
    const int output = log.get();
    runs_.try_emplace(name, std::vector<std::string>{program_, "run", path.string()}, output, std::move(log));
}

void Systems::stop(const std::string& name) {
    const auto run = runs_.find(require_name(name));
    if (run == runs_.end() || run->second.program.look())
        throw std::invalid_argument(name + " is not running, or was not started from a page");
    run->second.program.stop();
}

nlohmann::json Systems::runs() {
    nlohmann::json list = nlohmann::json::array();
    for (auto& [name, run] : runs_) {
        const auto& ended = run.program.look();
        if (ended) run.log = process::FileDescriptor(); // another monitor may start it now
        if (run.log) shorten(folder_ / name / "run.log", run.log.get());
        list.push_back({{"name", name},
                        {"running", !ended},
                        {"since_ms", run.program.since_ms()},
                        {"end", ended ? ended->text() : ""}});
    }
    return list;
}

std::string Systems::log(const std::string& name) const { return end_of(existing(name) / "run.log"); }

} // namespace tandem::monitor
