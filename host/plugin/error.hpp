// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace tandem::plugin {

enum class Reason {
    not_found,          ///< no such file in any folder of the search path
    not_a_library,      ///< no ELF file, or a program, an object file
    damaged,            ///< ELF, but cut off or with contents that cannot be
    wrong_architecture, ///< for another processor than this program
    wrong_model,        ///< a library, but not of the kind that was asked for
    abi_mismatch,       ///< built against the headers of another Tandem
    load_failed,        ///< the dynamic linker refused it
    missing_symbol,     ///< the library is loaded and lacks a function that was asked for
    probe_failed,       ///< tried in a child process, it crashed, hung or threw
};

/// what() is one line that names the file or the symbol.
class Error : public std::runtime_error {
  public:
    Error(Reason reason, const std::string& what) : std::runtime_error(what), reason_(reason) {}
    Reason reason() const noexcept { return reason_; }

  private:
    Reason reason_;
};

} // namespace tandem::plugin
