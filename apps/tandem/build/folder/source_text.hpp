// SPDX-License-Identifier: Apache-2.0
// Reads a component's files, in any encoding.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Returns at most the first 4 MiB of a file; "" if it cannot be read.
std::string read_text(const std::filesystem::path& file);

/// Returns the text of a C++ source with comments replaced by blanks. Keeps line numbers.
std::string strip_comments(std::string text);

/// Returns whether the source defines the function, f, or the member, C::f: its name, parameters, and a body. Returns
/// false for sources with a main(), because they are separate programs.
bool defines_function(const std::string& source, const std::string& function);

/// Returns whether the source defines main() whatever macros are defined: it is a separate program.
bool defines_main(const std::string& source);

/// Replaces '\' by '/', because project files and includes are often written on Windows.
std::string to_posix_path(std::string text);

/// Converts ASCII letters to lower case.
std::string to_lower(std::string text);

/// Returns whether the file name has an extension of C or C++ sources; the second function also accepts
/// headers.
bool is_source(const std::filesystem::path& file);
bool is_source_or_header(const std::filesystem::path& file);

/// Return whether the file name has the extension .idl, or .xml in any case.
bool is_idl(const std::filesystem::path& file);
bool is_xml(const std::filesystem::path& file);

/// Returns the name of the IDL file from which builds create the header: X.idl for XSkel.h, XStub.h and X.hh. Returns ""
/// for other names.
std::string idl_of_header(const std::filesystem::path& header);

/// Returns whether the path is that of a file. If it cannot be read, it counts as none.
bool is_file(const std::filesystem::path& path);

/// Returns the files in a folder, sorted; none if the folder does not exist.
std::vector<std::filesystem::path> list_files(const std::filesystem::path& folder);

/// Returns whether the name exists, even if it is unreadable or a dangling link. Throws std::runtime_error if
/// this cannot be determined.
bool is_there(const std::filesystem::path& file);

/// Returns the entries of a folder with this extension in any case, except folders, sorted. Unlike
/// list_files(), it includes unreadable entries. Returns none if the folder does not exist. Throws
/// std::runtime_error if the folder cannot be read.
std::vector<std::filesystem::path> list_entries(const std::filesystem::path& folder,
                                                const std::string& extension);

/// Returns the files in a folder and its sub-folders, sorted. Omits the folders of builds, of version control
/// and of the graphical programs (mfc/) that OPRoS components contain.
std::vector<std::filesystem::path> list_files_below(const std::filesystem::path& folder);

} // namespace tandem::command
