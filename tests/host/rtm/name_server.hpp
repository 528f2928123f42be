// SPDX-License-Identifier: Apache-2.0
// A CORBA name server for tests.
#pragma once
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace testing {

/// Runs omniNames with a separate log folder. At the end, the folder and all names are removed.
class NameServer {
  public:
    explicit NameServer(const std::string& port) {
        char name[] = "/tmp/tandem-names-XXXXXX";
        dir_ = mkdtemp(name);
        pid_ = fork();
        if (pid_ == 0) {
            const std::string endpoint = "giop:tcp:127.0.0.1:" + port;
            close(1);
            close(2);
            execlp("omniNames", "omniNames", "-start", port.c_str(), "-ignoreport", "-logdir", dir_.c_str(),
                   "-ORBendPoint", endpoint.c_str(), nullptr);
            _exit(127);
        }
    }
    ~NameServer() {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
        std::filesystem::remove_all(dir_);
    }

  private:
    std::string dir_;
    pid_t pid_;
};

} // namespace testing
