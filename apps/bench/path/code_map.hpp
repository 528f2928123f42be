// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/path/symbol_table.hpp"

#include <sys/types.h>

namespace tandem::bench {

/// The executable mappings of a process, with the functions in them.
class CodeMap {
  public:
    explicit CodeMap(pid_t process);

    /// "libc.so.6 malloc"
    std::string function_at(std::uint64_t address);
    /// Whether an allocating function of the C library begins here.
    bool is_allocation(std::uint64_t address);
    /// Code that the kernel provides (vdso): its length depends on the clock.
    bool is_of_kernel(std::uint64_t address) const;

  private:
    struct Mapping {
        std::uint64_t begin, end, file_offset;
        std::string file;
    };
    const Mapping* find(std::uint64_t address) const;
    const SymbolTable& symbols_of(const Mapping& mapping);

    std::vector<Mapping> mappings_;
    std::map<std::string, SymbolTable> symbols_; // by file, read when first asked for
};

} // namespace tandem::bench
