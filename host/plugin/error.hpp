// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace tandem::plugin {

/// Why a library cannot be used, for callers that handle some reasons differently.
enum class Reason {
    not_found,          ///< no such file in any folder of the search path
    not_a_library,      ///< not an ELF file, or a program or object file
    damaged,            ///< an ELF file that is truncated or inconsistent
    wrong_architecture, ///< for a processor other than this program's
    wrong_model,        ///< a library of an unexpected kind
    abi_mismatch,       ///< built against the headers of another Tandem
    load_failed,        ///< the dynamic linker cannot load it
    missing_symbol,     ///< loaded, but without a requested function
    probe_failed,       ///< it crashed, hung or threw in a child process
};

/// A library cannot be used. what() is one line that names the file or symbol and advises what to do.
class Error : public std::runtime_error {
  public:
    Error(Reason reason, const std::string& what) : std::runtime_error(what), reason_(reason) {}
    Reason reason() const noexcept { return reason_; }

  private:
    Reason reason_;
};

} // namespace tandem::plugin
