// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/plain_path.hpp"

#include "host/text/printable.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <stdexcept>
#include <string_view>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

bool is_control(unsigned char c) { return c < ' ' || c == 0x7f; }

/// Returns the first control character or one of `special`, in words; empty if there is none.
std::string find_special(const std::string& text, std::string_view special) {
    for (const char c : text) {
        if (is_control(c)) return "a control character";
        if (special.find(c) != std::string_view::npos) return fmt::format("a '{}'", c);
    }
    return "";
}

std::string whole_name(const fs::path& path) { return fs::absolute(path).lexically_normal().string(); }

[[noreturn]] void refuse(const std::string& name, const std::string& found, const char* reader) {
    throw std::runtime_error(fmt::format("{} has {} in its name, which {}; rename the file or folder",
                                         text::printable_line(name), found, reader));
}

bool is_one_of(unsigned char c, std::string_view others) {
    return c < 128 && (std::isalnum(c) != 0 || others.find(static_cast<char>(c)) != std::string_view::npos);
}

} // namespace

void require_cmake_path(const fs::path& path) {
    if (path.empty()) return;
    const std::string name = whole_name(path);
    if (const auto found = find_special(name, ";$\"`\\#%|<>[]*?:"); !found.empty())
        refuse(name, found, "CMake or make does not read as part of a name");
}

void require_idl_path(const fs::path& path) {
    const std::string name = whole_name(path);
    if (const auto found = find_special(name, "$\"`\\"); !found.empty())
        refuse(name, found, "omniidl does not read as part of a name");
    if (text::printable_line(name) != name) refuse(name, "a byte that is not UTF-8", "omniidl does not read");
}

void require_conf_path(const fs::path& path) {
    const std::string name = whole_name(path);
    if (const auto found = find_special(name, ",\\"); !found.empty())
        refuse(name, found, "rtc.conf cannot contain in a list");
    if (name.ends_with(' ')) refuse(name, "a blank at the end", "rtc.conf cannot contain");
}

void require_conf_type(const std::string& name, const std::string& category, const fs::path& module) {
    const auto fail = [&](const char* what, const std::string& text, const char* expected) {
        throw std::runtime_error(fmt::format("{} registers a component type with the {} '{}', which rtc.conf "
                                             "cannot contain: expected {}",
                                             text::printable_line(module.string()), what,
                                             text::printable_line(text), expected));
    };
    const auto is_plain = [](unsigned char c) { return c >= 128 || is_one_of(c, "_-+"); };
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_plain))
        fail("name", name, "letters, digits, _, - and +");
    if (category.starts_with(' ') || category.ends_with(' ') || !find_special(category, ":=\\#!").empty())
        fail("category", category, "a text without :, =, #, ! and \\, and without blanks at its ends");
}

void require_library(const std::string& library) {
    const char* const others =
        library.starts_with('/') ? "_-+./=,@~ " : "_-+./=,@~"; // CMake quotes whole paths
    const bool plain =
        std::all_of(library.begin(), library.end(), [&](char c) { return is_one_of(c, others); });
    if (library.empty() || !plain)
        throw std::runtime_error(
            fmt::format("-l '{}' is not a library: expected a name, for example m, or a file",
                        text::printable_line(library)));
}

void require_pkg_config_module(const std::string& module) {
    const bool plain =
        std::all_of(module.begin(), module.end(), [](char c) { return is_one_of(c, "_-+.<>="); });
    if (module.empty() || module.front() == '-' || !plain)
        throw std::runtime_error(
            fmt::format("--pkg-config '{}' is not a module: expected a name, for example opencv4",
                        text::printable_line(module)));
}

void require_definition(const std::string& definition) {
    std::string found = find_special(definition, ";#");
    if (definition.find("$<") != std::string::npos) found = "a '$<'";
    const bool named = !definition.empty() && is_one_of(definition.front(), "_");
    if (!found.empty() || !named)
        throw std::runtime_error(fmt::format("-D '{}' is not a definition: expected NAME or NAME=VALUE{}",
                                             text::printable_line(definition),
                                             found.empty() ? "" : ", and CMake cannot pass on " + found));
}

} // namespace tandem::command
