// SPDX-License-Identifier: Apache-2.0
#include "host/text/quote.hpp"

#include "host/text/printable.hpp"

namespace tandem::text {
namespace {

std::string replace_each(const std::string& text, char from, const char* to) {
    std::string out;
    for (const char c : text)
        if (c == from)
            out += to;
        else
            out += c;
    return out;
}

} // namespace

// A single quote inside ends the quotes, is escaped, and starts them again.
std::string quote_shell(const std::string& word) {
    const bool plain = word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                              "_-./:=,+@%") == std::string::npos;
    return plain && !word.empty() ? word : "'" + replace_each(word, '\'', "'\\''") + "'";
}

// CMake ignores a newline after the opening bracket, and ends the argument at the first closing bracket of the
// same length. A final ']' would become part of it.
std::string quote_cmake(const std::string& text) {
    std::string equals = "=";
    while ((text + "]").find("]" + equals + "]") != std::string::npos || text.ends_with("]" + equals))
        equals += '=';
    const char* const newline = text.starts_with('\n') ? "\n" : "";
    return "[" + equals + "[" + newline + text + "]" + equals + "]";
}

// Octal numbers stand for the characters that mean something in double quotes: gnuplot runs `commands` there. Single quotes
// are not an alternative, because gnuplot 5.4 reads '' at the beginning of such a string as its end.
std::string quote_gnuplot(const std::string& text) {
    std::string out;
    for (const char c : printable_line(text)) switch (c) {
        case '"':
            out += "\\042";
            break;
        case '\\':
            out += "\\134";
            break;
        case '`':
            out += "\\140";
            break;
        default:
            out += c;
        }
    return '"' + out + '"';
}

std::string quote_dot(const std::string& text) {
    return '"' + replace_each(replace_each(printable_line(text), '\\', "\\\\"), '"', "\\\"") + '"';
}

} // namespace tandem::text
