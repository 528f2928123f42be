// SPDX-License-Identifier: Apache-2.0
// Files that a program writes. In a folder that all users may write to, such as /tmp, another user may have put a link or
// a file at a name that the program will use.
#pragma once

#include "host/process/file_descriptor.hpp"

#include <filesystem>
#include <string_view>
#include <sys/types.h>

namespace tandem::process {

/// What open_output() does with the content of an existing file.
enum class Existing { replace, append, keep };

/// Opens a file to write, and creates it with `mode` if it does not exist. In a folder that all users may write to, refuses
/// links and files of other users. Throws std::runtime_error with the file and the reason.
FileDescriptor open_output(const std::filesystem::path& file, Existing existing = Existing::replace,
                           mode_t mode = 0666);

/// Replaces the content of a file. Opens it as open_output() does. Throws also if not everything can be written.
void write_output(const std::filesystem::path& file, std::string_view text);

} // namespace tandem::process
