// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/remedy.hpp"

#include "apps/tandem/build/first_error.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/missing_names.hpp"
#include "apps/tandem/build/packages/header_packages.hpp"
#include "apps/tandem/build/packages/installed_library.hpp"
#include "apps/tandem/build/packages/symbol_libraries.hpp"
#include "host/text/quote.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {
namespace {

// Returns the names that a preprocessor line tests with #ifdef, #ifndef or defined.
std::vector<std::string> names_asked_for(const std::string& line) {
    static const std::regex name("(?:ifn?def|defined)[ \t(]+([A-Za-z_][A-Za-z_0-9]*)");
    std::vector<std::string> names;
    for (std::sregex_iterator at(line.begin(), line.end(), name), end; at != end; ++at)
        names.push_back((*at)[1]);
    return names;
}

// Returns the macros in the conditions around line `last` that, if defined, skip this line. `lines` contain
// no comments.
std::vector<std::string> names_of_branches(const std::vector<std::string>& lines, std::size_t last) {
    static const std::regex directive("^[ \t]*#[ \t]*(ifndef|if|elif|else|endif)");
    std::vector<std::string> names;
    int inner = 0; // complete nested conditions
    bool other_branch = false;
    for (std::size_t i = last; i-- > 0;) {
        std::smatch found;
        if (!std::regex_search(lines[i], found, directive)) continue;
        const std::string word = found[1];
        if (word == "endif") ++inner;
        if (word == "endif" || (inner > 0 && (word == "elif" || word == "else"))) continue;
        if (inner > 0) {
            --inner; // the start of the nested condition
            continue;
        }
        // Defining the macros of #error's own condition does not skip #error, unless the condition is
        // #ifndef.
        const bool avoids = word == "ifndef" ? !other_branch : other_branch;
        const auto asked = names_asked_for(lines[i]);
        if (avoids) names.insert(names.begin(), asked.begin(), asked.end());
        if (word == "if" || word == "ifndef") break;
        other_branch = true;
    }
    return names;
}

/// Returns the lines of the file in a compiler's error line, without comments, up to the one with the error; none if the line
/// names no file.
std::vector<std::string> lines_to(const std::string& error) {
    static const std::regex place("^(.+):([0-9]{1,7}):[0-9]+: error: ");
    std::smatch found;
    if (!std::regex_search(error, found, place)) return {};
    std::istringstream text(strip_comments(read_text(found[1].str())));
    const auto number = static_cast<std::size_t>(std::stoul(found[2]));
    std::vector<std::string> lines;
    for (std::string line; lines.size() < number && std::getline(text, line);) lines.push_back(line);
    return lines.size() == number ? lines : std::vector<std::string>{};
}

/// Returns the macros around the #error in a compiler's error line. Defining any one of them skips the
/// #error.
std::vector<std::string> macros_that_avoid(const std::string& error) {
    if (error.find(" error: #error") == std::string::npos) return {};
    const auto lines = lines_to(error);
    return lines.empty() ? std::vector<std::string>{} : names_of_branches(lines, lines.size() - 1);
}

/// Returns the keyword of Visual C++ in the source line of a compiler's error line; "" if there is none.
std::string windows_keyword(const std::string& error) {
    const auto lines = lines_to(error);
    for (const std::string keyword : {"__declspec", "__stdcall"})
        if (!lines.empty() && lines.back().find(keyword) != std::string::npos) return keyword;
    return "";
}

bool is_installed(std::string_view package, const BuildFacts& facts) {
    return !installed_files(package, facts.root).empty();
}

// Returns the remedy for something missing that the package has; `what` names it.
std::string install(std::string_view package, const std::string& what, const BuildFacts& facts) {
    if (!is_installed(package, facts)) return fmt::format("apt install {}", package);
    return fmt::format("{} is installed and has no {}: the source needs another version of the library",
                       package, what);
}

// Returns the options that name a folder with the file; "" if no folder is known.
std::string options_for(const std::string& file, const std::filesystem::path& folder) {
    std::string options;
    for (const auto& dir : folders_with(folder, file))
        options += (options.empty() ? "-I " : ", or -I ") + dir.string();
    return options;
}

std::string for_idl(const std::string& idl, const std::filesystem::path& folder) {
    const auto options = options_for(idl, folder);
    return options.empty() ? "add the folder of " + idl + " with -I DIR" : options;
}

std::string for_package(const std::string& header, const HeaderPackage& package, const BuildFacts& facts) {
    if (package.certain || is_installed(package.package, facts))
        return install(package.package, header, facts);
    return fmt::format("if {}/{} is meant: apt install {}", package.folder, header, package.package);
}

// Returns the remedy for a header whose name occurs in several packages: the package of another such header that the
// component includes; "" if there is none.
std::string for_header_beside(const std::string& header, const BuildFacts& facts) {
    if (header.find('/') != std::string::npos) return "";
    for (const auto& name : facts.unknown)
        if (const auto package = find_package_of_header(name);
            package && !package->certain && !is_installed(package->package, facts))
            return fmt::format("if it belongs to {}/{}, which the component includes, too: apt install {}",
                               package->folder, name, package->package);
    return "";
}

std::string for_header(const std::string& header, const BuildFacts& facts) {
    const auto& folder = facts.folder;
    if (auto options = options_for(header, folder); !options.empty()) return options;
    if (const auto idl = idl_of_header(header); !idl.empty())
        if (auto options = options_for(idl, folder); !options.empty()) return options;
    if (is_windows_header(header))
        return header + " is a Windows header: this source cannot be built on Linux";
    if (const std::string end = "SVC_impl.h"; header.ends_with(end))
        return fmt::format(
            "RTCBuilder makes it from {}.idl for a service that a component provides: make it there, or "
            "add its folder with -I DIR",
            header.substr(0, header.size() - end.size()));
    if (const auto package = find_package_of_header(header)) return for_package(header, *package, facts);
    if (const auto* origin = origin_outside_debian(header))
        return header + " belongs to " + origin +
               ", which Debian does not package: build it, then add its headers with -I DIR and its library "
               "with -l NAME";
    if (auto beside = for_header_beside(header, facts); !beside.empty()) return beside;
    const auto checkout = find_checkout(folder);
    if (const auto modules = missing_submodules(checkout); !checkout.empty() && !modules.empty())
        return fmt::format("{} of this repository {} not checked out: git -C {} submodule update --init",
                           fmt::join(modules, ", "), modules.size() == 1 ? "is" : "are",
                           text::quote_shell(checkout.string()));
    return "if you have the library or component that " + header + " belongs to, add its folder with -I DIR";
}

// `symbol`: a function's name and parameters, as the linker prints them.
std::string for_symbol(const std::string& symbol, const BuildFacts& facts) {
    std::string unknown =
        "add the library that defines it with -l NAME, or the source file with --source FILE";
    const auto* found = find_library_of_symbol(symbol);
    if (!found) return unknown;
    const std::string module = found->pkg_config;
    const auto& used = module.empty() ? facts.libraries : facts.pkg_config;
    const std::string name = module.empty() ? found->library : module;
    const auto package = module.empty() ? find_package_of_library(name) : find_package_of_module(name);
    if (!package.empty() && !is_installed(package, facts)) return fmt::format("apt install {}", package);
    if (std::find(used.begin(), used.end(), name) == used.end())
        return (module.empty() ? "-l " : "--pkg-config ") + name;
    return fmt::format("{} is already used and does not define it: {}", name, unknown);
}

std::string for_library(const std::string& library, const BuildFacts& facts) {
    if (const auto package = find_package_of_library(library); !package.empty())
        return install(package, "lib" + library + ".so", facts);
    return "give the path of the library: -l /FOLDER/lib" + library + ".so";
}

std::string for_module(const std::string& module, const BuildFacts& facts) {
    if (const auto package = find_package_of_module(module); !package.empty())
        return install(package, module + ".pc", facts);
    return ""; // the message says what to do
}

} // namespace

std::string find_remedy(const std::string& error, const BuildFacts& facts) {
    if (const auto header = missing_header(error); !header.empty()) return for_header(header, facts);
    if (const auto idl = missing_idl(error); !idl.empty()) return for_idl(idl, facts.folder);
    if (const auto symbol = undefined_symbol(error); !symbol.empty()) return for_symbol(symbol, facts);
    if (const auto library = between(error + ":", "cannot find -l", ":"); !library.empty())
        return for_library(library, facts);
    if (const auto module = between(error, "pkg-config knows no module ", ";"); !module.empty())
        return for_module(module, facts);
    std::string definitions;
    for (const auto& macro : macros_that_avoid(error))
        definitions += (definitions.empty() ? "-D " : ", or -D ") + macro;
    if (!definitions.empty()) return definitions;
    auto name = unknown_name(error);
    if (!is_windows_name(name)) name = windows_keyword(error);
    if (!name.empty()) return name + " belongs to Windows: this source cannot be built on Linux";
    if (error.find("std::exception::exception(const char") != std::string::npos)
        return "only Visual C++ has std::exception with a text: throw std::runtime_error";
    return "";
}

std::string package_to_install(const std::string& remedy) {
    const std::string begin = "apt install ";
    return remedy.starts_with(begin) ? between(remedy + ":", begin, ":") : "";
}

std::string dropped_by_opencv(const std::string& error) {
    if (error.find("cv::Mat::Mat(IplImage*") != std::string::npos) return "cv::Mat(IplImage*)";
    auto name = unknown_name(error);
    for (const char* prefix : {"cv", "Cv", "CV_", "Ipl", "IPL_"})
        if (name.rfind(prefix, 0) == 0 && name.find(':') == std::string::npos) return name;
    return "";
}

} // namespace tandem::command
