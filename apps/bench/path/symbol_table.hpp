// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tandem::bench {

/// The functions of one ELF file, from its symbol tables (libelf). A file that cannot be read has none.
class SymbolTable {
  public:
    explicit SymbolTable(const std::string& file);

    /// The demangled name of the function at this offset in the file; "PLT stub" for one, and "local function behind X" where the
    /// file has no symbol, as stripped libraries have of functions that they do not export.
    std::string function_at(std::uint64_t file_offset) const;
    /// Offsets in memory, relative to where the file's address 0 is loaded, of the functions with one of these names.
    bool is_start_of(std::uint64_t file_offset, const std::vector<std::string>& names) const;

  private:
    struct Function {
        std::uint64_t size;
        std::vector<std::string> names; // aliases of one function
    };
    struct Range {
        std::uint64_t begin, end;
        bool contains(std::uint64_t address) const { return address >= begin && address < end; }
    };
    struct Mapped {
        Range in_file;
        std::uint64_t address;
    };
    std::uint64_t address_of(std::uint64_t file_offset) const;

    std::vector<Mapped> mapped_;
    std::vector<Range> stubs_;
    std::map<std::uint64_t, Function> functions_; // by address
};

} // namespace tandem::bench
