// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/path_counts.hpp"
#include "apps/bench/path/code_map.hpp"

#include <set>
#include <string>
#include <sys/user.h>
#include <vector>

namespace tandem::bench {

/// The instructions that a thread has executed between two marks.
class PathTrace {
  public:
    /// Of a thread of this process, which has loaded all its libraries.
    explicit PathTrace(pid_t process) : process_(process), code_(process) {}

    /// The instruction that the thread is about to execute.
    void add(const user_regs_struct& registers);

    /// Code that the kernel provides (vdso) lies there, which does not count.
    bool is_of_kernel(std::uint64_t address) const { return code_.is_of_kernel(address); }

    PathCounts counts() const;
    /// "118 libc.so.6 malloc": instructions, library, function; the largest first.
    std::vector<std::string> functions();

  private:
    struct Instruction {
        bool is_locked, is_repeated, is_system_call, is_allocation, is_of_kernel;
        std::uint32_t executed;
        std::uint64_t system_call; // its number
    };
    Instruction decode(std::uint64_t address);

    pid_t process_;
    CodeMap code_;
    std::map<std::uint64_t, Instruction> instructions_; // by address
    std::uint64_t last_ = 0;                            // address of the last one
};

} // namespace tandem::bench
