// SPDX-License-Identifier: Apache-2.0
#include <archive/opros_type_info.h>

#include <cstdlib>
#include <cxxabi.h>
#include <memory>
#include <string>

namespace {

void replace_all(std::string& text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
}

/// Removes each template argument that begins with `start` (such as ", std::allocator<"), up to its closing bracket.
void remove_argument(std::string& text, const std::string& start) {
    for (std::size_t at = 0; (at = text.find(start, at)) != std::string::npos;) {
        std::size_t end = at + start.size();
        for (int open = 1; open > 0 && end < text.size(); ++end)
            open += text[end] == '<' ? 1 : text[end] == '>' ? -1 : 0;
        text.erase(at, end - at);
    }
}

/// Shortens a demangled name to what a user would write: without the default arguments of standard templates and the
/// library's inline namespace. Messages show this name, and ports use it for a type that has no other name.
std::string without_defaults(std::string text) {
    for (const char* argument : {", std::allocator<", ", std::char_traits<", ", std::less<"})
        remove_argument(text, argument);
    replace_all(text, " >", ">");
    replace_all(text, "std::__cxx11::", "std::");
    replace_all(text, "std::basic_string<char>", "std::string");
    replace_all(text, "std::basic_string<wchar_t>", "std::wstring");
    return text;
}

} // namespace

namespace opros {

std::string readable_name(const std::type_info& type) {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(
        abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), std::free);
    return status == 0 && text ? without_defaults(text.get()) : type.name();
}

} // namespace opros
