// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/machine/daemon.hpp"

#include "host/process/child_process.hpp"

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace tandem::bench {

namespace fs = std::filesystem;

namespace {

/// RouDi's memory pools: chunks for 64-byte, 1 MiB and 6 MiB messages. Its default has none above 4 MiB.
constexpr const char* roudi_pools = "[general]\nversion = 1\n[[segment]]\n"
                                    "[[segment.mempool]]\nsize = 256\ncount = 2000\n"
                                    "[[segment.mempool]]\nsize = 1048704\ncount = 16\n"
                                    "[[segment.mempool]]\nsize = 6291584\ncount = 16\n";

} // namespace

struct Daemon::Running {
    Running(fs::path temporary_folder, const std::vector<std::string>& command, int log)
        : folder(std::move(temporary_folder)), process(command, {-1, log, log, ""}) {}
    ~Running() {
        process.stop(std::chrono::seconds(5));
        std::error_code ignored; // what stays in the temporary folder does no harm
        fs::remove_all(folder, ignored);
    }
    fs::path folder;
    process::ChildProcess process;
};

Daemon::Daemon(const std::string& program) {
    if (program.empty()) return;
    std::string name = (fs::temp_directory_path() / "tandem-bench-XXXXXX").string();
    const fs::path folder = mkdtemp(name.data());
    std::ofstream(folder / "roudi.toml") << roudi_pools;
    const fs::path log = folder / "log";
    const process::FileDescriptor out(open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
    running_ = std::make_unique<Running>(
        folder, std::vector<std::string>{program, "-c", (folder / "roudi.toml").string()}, out.get());
    const auto is_ready = [&] {
        std::ifstream text(log);
        return std::string{std::istreambuf_iterator<char>(text), {}}.find("ready for clients") !=
               std::string::npos;
    };
    // RouDi has no other sign of being ready: a client that starts earlier would wait or give up.
    for (int i = 0; i < 1000 && !is_ready(); ++i) {
        if (running_->process.poll())
            throw std::runtime_error(
                program +
                " ended before it was ready; stop another instance of it (of another tandem-bench)");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!is_ready())
        throw std::runtime_error(program + " was not ready after 10 s; see the load of the machine");
}

Daemon::~Daemon() = default;

} // namespace tandem::bench
