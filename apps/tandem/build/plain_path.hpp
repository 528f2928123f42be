// SPDX-License-Identifier: Apache-2.0
// Names of files and folders that programs which Tandem starts would misread. They are refused before anything is written.
#pragma once

#include <filesystem>
#include <string>

namespace tandem::command {

/// Throws std::runtime_error, which names the path and the character, if CMake or make reads a character of the absolute
/// path as syntax. Quoting does not help, because CMake copies the path into files of several languages.
void require_cmake_path(const std::filesystem::path& path);

/// Throws std::runtime_error for characters that a shell interprets in double quotes, because omniidl passes paths to one.
void require_idl_path(const std::filesystem::path& path);

/// Throws std::runtime_error for what a path in rtc.conf cannot contain, such as a comma: its lists have no quoting.
void require_conf_path(const std::filesystem::path& path);

/// Throws std::runtime_error, which names the module, if rtc.conf would read the name or the category of its component type as
/// something else.
void require_conf_type(const std::string& name, const std::string& category,
                       const std::filesystem::path& module);

/// Throws std::runtime_error if an argument of the option is not plain: CMake would read a list, a generator expression or
/// several flags, or a shell a command.
void require_library(const std::string& library);
void require_pkg_config_module(const std::string& module);
void require_definition(const std::string& definition);

} // namespace tandem::command
