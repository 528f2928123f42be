// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_folder.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/text/split_names.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Keywords of C++20, macros that every source sees, and std: none of them can be the name of a class.
constexpr const char* cpp_keywords = R"(
    alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t
    class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue
    decltype default delete do double dynamic_cast else enum explicit export extern false float for friend
    goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private
    protected public register reinterpret_cast requires return short signed sizeof static static_assert
    static_cast std struct switch template this thread_local throw true try typedef typeid typename union
    unsigned using virtual void volatile wchar_t while xor xor_eq NULL EOF )";

} // namespace

void require_component_name(const std::string& name) {
    const auto letter = [](unsigned char c) { return c < 128 && (std::isalpha(c) || c == '_'); };
    // ASCII only, although C++ allows more: the name is also that of files, a library and a CMake target.
    bool valid = !name.empty() && name.size() <= 100 && letter(static_cast<unsigned char>(name[0]));
    for (const unsigned char c : name) valid = valid && (letter(c) || (c < 128 && std::isdigit(c)));
    if (!valid)
        throw std::runtime_error("'" + replace_nonprintable(name) +
                                 "' is not a valid component name: expected letters, digits and _ as in a "
                                 "C++ class name, for example LaserFilter");
    const auto keywords = text::split_words(cpp_keywords);
    if (std::find(keywords.begin(), keywords.end(), name) != keywords.end())
        throw std::runtime_error("'" + name + "' is not a valid component name: it is a C++ keyword");
}

void create_component_folder(const fs::path& folder, const TemplateFiles& files) {
    std::error_code error;
    // The component's folder is searched for headers before /usr/include: <string.h> would find a component
    // named string.
    const std::string header = folder.filename().string() + ".h";
    if (fs::exists("/usr/include/" + header, error))
        throw std::runtime_error(
            "'" + folder.filename().string() +
            "' is not a valid component name: its header would be mistaken for the system's <" + header +
            ">");
    if (fs::exists(folder, error))
        throw std::runtime_error(folder.string() + " exists; choose another name, or remove it first");
    if (!fs::create_directory(folder, error))
        throw std::runtime_error("folder " + folder.string() + " cannot be created: " + error.message());
    try {
        for (const auto& [file, text] : files) write_file(folder / file, text);
    } catch (const std::runtime_error&) {
        fs::remove_all(
            folder, error); // half a component cannot be built, and its folder would block a second attempt
        throw;
    }
}

std::string expand_template(std::string text, const std::string& name) {
    const std::string mark = "@NAME@";
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += name.size())
        text.replace(at, mark.size(), name);
    return text;
}

} // namespace tandem::command
