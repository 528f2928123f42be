// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tandem::engine {

/// A line of a profile. Every element that is read from a profile keeps its own, so that an error found much
/// later, when a library is loaded or ports are connected, still names the line to be edited.
struct SourceLocation {
    std::filesystem::path file;
    int line = 0; ///< counted from 1

    /// "FILE:LINE", the form that editors and compilers use.
    std::string text() const { return file.string() + ":" + std::to_string(line); }
};

/// The application cannot be set up as its profiles ask. what() is one line: file and line if known, what is
/// wrong, what was expected.
class SetupError : public std::runtime_error {
  public:
    /// Control characters of `what` become blanks, and a text of more than 2000 bytes is cut.
    explicit SetupError(const std::string& what);
    SetupError(const SourceLocation& location, const std::string& what)
        : SetupError(location.text() + ": " + what) {}
};

} // namespace tandem::engine
