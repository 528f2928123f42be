// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/systems.hpp"

#include "host/text/printable.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace tandem::monitor {
namespace {

namespace fs = std::filesystem;

constexpr off_t max_log = 64 << 10;
constexpr std::size_t max_components = 100;

/// Throws unless the name is that of a link, as `tandem system new` needs it: it cannot lead to another folder.
const std::string& require_name(const std::string& name) {
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
    if (name.empty() || name.size() > 60 || name.front() == '-' ||
        !std::all_of(name.begin(), name.end(), allowed))
        throw std::invalid_argument("expected a name of at most 60 letters, digits, - and _");
    return name;
}

} // namespace

Systems::Systems(const fs::path& folder, std::string program)
    : folder_(fs::weakly_canonical(folder)), program_(std::move(program)) {
    if (!fs::is_directory(folder_))
        throw std::runtime_error(folder.string() + " is not a folder: --systems needs an existing one");
}

Systems::~Systems() {
    for (const auto& [name, run] : runs_) run->stop(); // all of them, before the first is waited for
}

fs::path Systems::existing(const std::string& name) const {
    fs::path path = folder_ / require_name(name);
    std::error_code missing;
    if (fs::symlink_status(path, missing).type() != fs::file_type::directory)
        throw std::invalid_argument(fmt::format("{} has no folder {}", folder_.string(), name));
    return path;
}

std::vector<std::string> Systems::list_command() const {
    return {program_, "system", "list", folder_.string(), "--json"};
}

std::vector<std::string> Systems::new_command(const std::string& name,
                                              const std::vector<std::string>& components) const {
    if (components.empty() || components.size() > max_components)
        throw std::invalid_argument("expected 1 to 100 components");
    std::vector<std::string> command{program_, "system", "new", (folder_ / require_name(name)).string()};
    for (const auto& component : components) command.push_back(existing(component).string());
    return command;
}

std::vector<std::string> Systems::save_command(const std::string& name, const std::vector<std::string>& hosts,
                                               bool replace) const {
    std::vector<std::string> command{program_, "system", "save", (folder_ / require_name(name)).string()};
    for (const auto& host : hosts) command.insert(command.end(), {"--host", host});
    if (replace) command.emplace_back("--replace");
    return command;
}

std::size_t Systems::count_running() {
    return static_cast<std::size_t>(
        std::count_if(runs_.begin(), runs_.end(), [](const auto& run) { return !run.second->look(); }));
}

void Systems::start(const std::string& name) {
    const fs::path path = existing(name);
    if (const auto run = runs_.find(name); run != runs_.end() && !run->second->look())
        throw std::invalid_argument(name + " runs");
    if (count_running() >= max_runs)
        throw std::invalid_argument(
            fmt::format("{} systems run that pages have started: stop one first", max_runs));
    const process::FileDescriptor log(open(
        (path / "run.log").c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (log.get() < 0)
        throw std::invalid_argument(fmt::format("{}: {}", (path / "run.log").string(), std::strerror(errno)));
    runs_[name] = std::make_unique<BackgroundProgram>(
        std::vector<std::string>{program_, "run", path.string()}, log.get());
}

void Systems::stop(const std::string& name) {
    const auto run = runs_.find(require_name(name));
    if (run == runs_.end() || run->second->look())
        throw std::invalid_argument(name + " does not run, or was not started from a page");
    run->second->stop();
}

nlohmann::json Systems::runs() {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& [name, run] : runs_) {
        const auto& ended = run->look();
        list.push_back({{"name", name},
                        {"running", !ended},
                        {"since_ms", run->since_ms()},
                        {"end", ended ? ended->text() : ""}});
    }
    return list;
}

std::string Systems::log(const std::string& name) const {
    const process::FileDescriptor file(
        open((existing(name) / "run.log").c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (file.get() < 0 || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return "";
    std::string text(static_cast<std::size_t>(std::min(status.st_size, max_log)), '\0');
    const auto bytes =
        pread(file.get(), text.data(), text.size(), status.st_size - static_cast<off_t>(text.size()));
    text.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes));
    if (status.st_size > max_log) text.erase(0, text.find('\n') + 1);
    return text::printable_text(text);
}

} // namespace tandem::monitor
