// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/remedy.hpp"
#include "apps/tandem/build/error_directive.hpp"
#include "apps/tandem/build/first_error.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/header_packages.hpp"

#include <map>
#include <utility>

namespace tandem::command {
namespace {

// Returns the text between two others; "" if they are missing.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const auto begin = text.find(before);
    if (begin == std::string::npos) return "";
    const auto end = text.find(after, begin + before.size());
    return end == std::string::npos ? "" : text.substr(begin + before.size(), end - begin - before.size());
}

std::string install(const LibraryPackage& package) { return std::string("apt install ") + package.package; }

std::string for_header(const std::string& header, const std::filesystem::path& folder) {
    std::string options;
    for (const auto& dir : folders_with(folder, header))
        options += (options.empty() ? "-I " : ", or -I ") + dir.string();
    if (!options.empty()) return options;
    if (is_windows_header(header))
        return header + " is a Windows header: this source cannot be built on Linux";
    if (const auto* package = find_package_of_header(header)) return install(*package);
    if (const auto* origin = origin_outside_debian(header))
        return header + " belongs to " + origin +
               ", which Debian does not package: build it, then add its headers with -I DIR and its library "
               "with -l NAME";
    return "if you have the library or component that " + header + " belongs to, add its folder with -I DIR";
}

// `symbol`: a function's name and parameters, as the linker prints them.
std::string for_symbol(const std::string& symbol) {
    const auto* package = find_package_of_symbol(symbol);
    if (package && *package->pkg_config) return std::string("--pkg-config ") + package->pkg_config;
    if (package) return std::string("-l ") + package->library;
    return "add the library that defines it with -l NAME, or the source file with --source FILE";
}

// Returns the name that the compiler does not know; "" if this is a different error.
std::string unknown_name(const std::string& error) {
    // g++ quotes names with these quotes in a UTF-8 locale, otherwise with apostrophes.
    for (const auto& [open, close] : {std::pair{"\u2018", "\u2019"}, std::pair{"'", "'"}}) {
        auto name = between(error, std::string("error: ") + open, close);
        if (!name.empty() && (error.find(" was not declared") != std::string::npos ||
                              error.find(" does not name a type") != std::string::npos ||
                              error.find(" has not been declared") != std::string::npos))
            return name;
    }
    return "";
}

// Returns advice to define a name of Windows headers.
std::string for_name(const std::string& name) {
    static const std::map<std::string, const char*> names{{"BOOL", "int"},
                                                          {"BYTE", "'unsigned char'"},
                                                          {"WORD", "'unsigned short'"},
                                                          {"DWORD", "'unsigned int'"},
                                                          {"UINT", "'unsigned int'"},
                                                          {"TRUE", "1"},
                                                          {"FALSE", "0"}};
    const auto known = names.find(name);
    if (known == names.end()) return "";
    return name + " is defined by Windows headers; define it with -D " + name + "=" + known->second;
}

} // namespace

std::string find_remedy(const std::string& error, const std::filesystem::path& folder) {
    if (const auto header = missing_header(error); !header.empty()) return for_header(header, folder);
    if (const auto symbol = undefined_symbol(error); !symbol.empty()) return for_symbol(symbol);
    if (const auto library = between(error + ":", "cannot find -l", ":"); !library.empty()) {
        if (const auto* package = find_package_of_library(library)) return install(*package);
        return "give the path of the library: -l /FOLDER/lib" + library + ".so";
    }
    std::string definitions;
    for (const auto& macro : macros_that_avoid(error))
        definitions += (definitions.empty() ? "-D " : ", or -D ") + macro;
    if (!definitions.empty()) return definitions;
    if (auto text = for_name(unknown_name(error)); !text.empty()) return text;
    if (error.find("required packages were not found") != std::string::npos)
        return "install the Debian package that has the module's .pc file, or omit --pkg-config";
    return "";
}

std::string undefined_symbol(const std::string& error) {
    return between(error, "undefined reference to `", "'");
}

std::string dropped_by_opencv(const std::string& error) {
    auto name = unknown_name(error);
    for (const char* prefix : {"cv", "Cv", "CV_", "Ipl", "IPL_"})
        if (name.rfind(prefix, 0) == 0 && name.find(':') == std::string::npos) return name;
    return "";
}

} // namespace tandem::command
