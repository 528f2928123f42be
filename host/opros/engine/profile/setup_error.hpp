// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tandem::engine {

/// A line of a profile. Every element that is read from a profile keeps its location, so that an error found much
/// later, while loading a library or connecting ports, still names the line to edit.
struct SourceLocation {
    std::filesystem::path file;
    int line = 0; ///< counted from 1

    /// "FILE:LINE", the form that editors and compilers use.
    std::string text() const { return file.string() + ":" + std::to_string(line); }
};

/// The application cannot be set up as its profiles require. what() is one line: file and line if known, the error,
/// and what was expected.
class SetupError : public std::runtime_error {
  public:
    /// Replaces control characters in `what` by blanks and truncates it after 2000 bytes.
    explicit SetupError(const std::string& what);
    SetupError(const SourceLocation& location, const std::string& what)
        : SetupError(location.text() + ": " + what) {}
};

} // namespace tandem::engine
