// SPDX-License-Identifier: Apache-2.0
// Reading a component's files, which may be of any encoding.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// The bytes of a file, at most the first 4 MiB; "" if it cannot be read.
std::string read_text(const std::filesystem::path& file);

/// The text of a C++ source with blanks in place of comments. Lines stay where they are.
std::string strip_comments(std::string text);

/// Whether the text of a source defines the function: its name, parameters without a ';', and a body. A source with a
/// main() is a program of its own and does not count.
bool defines_function(const std::string& source, const std::string& function);

/// With '/' for each '\': project files and includes are often written on Windows.
std::string to_posix_path(std::string text);

/// In lower case; ASCII only.
std::string to_lower(std::string text);

/// Whether a file's name ends as those of C and C++ sources do, or also as those of headers.
bool is_source(const std::filesystem::path& file);
bool is_source_or_header(const std::filesystem::path& file);

/// The files in a folder, sorted; none if there is no such folder.
std::vector<std::filesystem::path> list_files(const std::filesystem::path& folder);

/// Whether the name is that of something, even if it cannot be read: of a link to nothing, too. Throws std::runtime_error
/// if nobody can tell.
bool is_there(const std::filesystem::path& file);

/// What in a folder has this extension, in upper or lower case, and is no folder, sorted. Unlike list_files() it lists what
/// cannot be read, too. None if there is no such folder; throws std::runtime_error if it is there and cannot be read.
std::vector<std::filesystem::path> list_entries(const std::filesystem::path& folder,
                                                const std::string& extension);

/// The files in a folder and the folders below it, sorted, without those of builds, of version control and of
/// graphical programs (mfc/), which OPRoS components have beside their own.
std::vector<std::filesystem::path> list_files_below(const std::filesystem::path& folder);

} // namespace tandem::command
