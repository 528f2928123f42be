// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/path_counts.hpp"

#include <map>
#include <string>
#include <sys/types.h>
#include <sys/user.h>
#include <vector>

namespace tandem::bench {

/// The executable mappings of a process, with the functions in them. nm(1) names the functions.
class CodeMap {
  public:
    explicit CodeMap(pid_t process);

    /// Returns the function at this address, "libc.so.6 malloc", or "local function behind X" for functions
    /// that a stripped library does not export. Throws std::system_error if nm is missing.
    std::string function_at(std::uint64_t address) const;
    /// Returns whether an allocating function of the C library begins here.
    bool is_allocation(std::uint64_t address) const;
    /// Returns whether this is code that the kernel provides (vdso): its length depends on the clock.
    bool is_of_kernel(std::uint64_t address) const;

  private:
    struct Mapping {
        std::uint64_t begin, end;
        std::uint64_t base; // where the file's address 0 is
        std::string file;
    };
    const Mapping* find(std::uint64_t address) const;

    std::vector<Mapping> mappings_;
};

/// The instructions that a thread has executed between two marks.
class PathTrace {
  public:
    /// Begins the trace of a thread of `process`, which must have loaded all its libraries.
    explicit PathTrace(pid_t process) : process_(process), code_(process) {}

    /// Adds the instruction that the thread will execute next.
    void add(const user_regs_struct& registers);

    /// Returns whether the address is in code that the kernel provides (vdso), which does not count.
    bool is_of_kernel(std::uint64_t address) const { return code_.is_of_kernel(address); }

    PathCounts counts() const;
    /// Returns lines "118 libc.so.6 malloc": instructions, library, function; the largest first.
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
