// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_bytes = 4 << 20; // larger files are generated data and define no functions
constexpr int max_depth = 6;

bool is_ignored_folder(const fs::path& folder) {
    const auto name = to_lower(folder.filename().string());
    return name.empty() || name[0] == '.' || name == "mfc" || name == "debug" || name == "release" ||
           name.rfind("build", 0) == 0 || name.rfind("cmake", 0) == 0;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Returns whether the code has `int main(`, with any white space.
bool names_main(const std::string& code) {
    constexpr const char* blanks = " \t\r\n";
    for (auto at = code.find("main"); at != std::string::npos; at = code.find("main", at + 4)) {
        const auto next = code.find_first_not_of(blanks, at + 4);
        if (next == std::string::npos || code[next] != '(' || at < 4) continue;
        const auto last = code.find_last_not_of(blanks, at - 1);
        if (last == at - 1 || last == std::string::npos || last < 2) continue;
        if (code.compare(last - 2, 3, "int") == 0 && (last == 2 || !is_word(code[last - 3]))) return true;
    }
    return false;
}

// Returns the preprocessor directive in the line, without # and the blanks after it; "" for other lines.
std::string directive_of(const std::string& line) {
    const auto hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') return "";
    const auto word = line.find_first_not_of(" \t", hash + 1);
    return word == std::string::npos ? "" : line.substr(word);
}

// Returns whether a main() is compiled whatever is defined, as tandem_is_program() in TandemComponent.cmake: one in
// #ifndef NO_MAIN or #ifdef TEST does not make a program of the source.
bool contains_main(const std::string& code) {
    if (!names_main(code)) return false;
    std::vector<bool> optional; // the branches around the line
    std::string compiled;       // the lines that are compiled in any case
    std::istringstream lines(code);
    for (std::string line; std::getline(lines, line);) {
        const auto directive = directive_of(line);
        if (directive.starts_with("if")) {
            const auto starts = [&](const char* begin) { return directive.starts_with(begin); };
            optional.push_back(starts("ifdef") || starts("ifndef") || starts("if 0") || starts("if defined"));
        } else if (directive.starts_with("endif") && !optional.empty()) {
            optional.pop_back();
        } else if (directive.starts_with("el") && !optional.empty()) {
            optional.back() = false;
        } else if (std::find(optional.begin(), optional.end(), true) == optional.end()) {
            compiled += line + '\n';
        }
    }
    return names_main(compiled);
}

} // namespace

std::string read_text(const fs::path& file) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error) return "";
    std::string text(static_cast<std::size_t>(std::min<std::uintmax_t>(size, max_bytes)), '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

// Does not recognize string literals, because the searched names are unlikely in them.
std::string strip_comments(std::string text) {
    // A state machine over pairs of characters; the last character cannot begin or end a comment.
    enum { code, line, block } in = code;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (in == code && text[i] == '/' && (text[i + 1] == '/' || text[i + 1] == '*'))
            in = text[i + 1] == '/' ? line : block;
        else if (in == line && text[i] == '\n')
            in = code;
        else if (in == block && text[i] == '*' && text[i + 1] == '/') {
            in = code;
            text[i + 1] = ' ';
        } else if (in == code)
            continue;
        if (text[i] != '\n') text[i] = ' ';
    }
    return text;
}

bool defines_function(const std::string& source, const std::string& function) {
    if (source.find(function) == std::string::npos) return false;
    const std::string text = strip_comments(source);
    const bool is_member = function.find(':') != std::string::npos;
    bool found = false;
    for (std::size_t at = 0; !found && (at = text.find(function, at)) != std::string::npos;
         at += function.size()) {
        if (at > 0 && (is_word(text[at - 1]) || (text[at - 1] == ':' && !is_member))) continue;
        const auto open = text.find_first_not_of(" \t\r\n", at + function.size());
        if (open == std::string::npos || text[open] != '(') continue;
        const auto close = text.find(')', open);
        const auto body = text.find_first_not_of(" \t\r\n", close == std::string::npos ? close : close + 1);
        found = close != std::string::npos && body != std::string::npos && text[body] == '{';
    }
    return found && !contains_main(text);
}

bool defines_main(const std::string& source) { return contains_main(strip_comments(source)); }

std::string to_posix_path(std::string text) {
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

std::string to_lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

bool is_source(const fs::path& file) {
    static const std::set<std::string> endings{".cpp", ".cc", ".cxx", ".c"};
    return endings.count(to_lower(file.extension().string())) != 0;
}

bool is_source_or_header(const fs::path& file) {
    static const std::set<std::string> endings{".h", ".hh", ".hpp", ".hxx"};
    return is_source(file) || endings.count(to_lower(file.extension().string())) != 0;
}

bool is_idl(const fs::path& file) { return file.extension() == ".idl"; }

bool is_xml(const fs::path& file) { return to_lower(file.extension().string()) == ".xml"; }

std::string idl_of_header(const fs::path& header) {
    std::string base = header.stem().string();
    if (header.extension() == ".hh") return base + ".idl";
    if (header.extension() != ".h" || !(base.ends_with("Skel") || base.ends_with("Stub"))) return "";
    base.resize(base.size() - 4);
    return base + ".idl";
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

std::vector<fs::path> list_files(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code ignored;
    // If the folder is missing, the iterator is at its end.
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.is_regular_file(ignored)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

bool is_there(const fs::path& file) {
    std::error_code error;
    const auto type = fs::symlink_status(file, error).type();
    if (type == fs::file_type::none)
        throw std::runtime_error(file.string() + " cannot be looked for: " + error.message());
    return type != fs::file_type::not_found;
}

std::vector<fs::path> list_entries(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> entries;
    if (!is_there(folder)) return entries;
    std::error_code error, ignored;
    fs::directory_iterator at(folder, error);
    for (; !error && at != fs::directory_iterator(); at.increment(error))
        if (to_lower(at->path().extension().string()) == extension && !at->is_directory(ignored))
            entries.push_back(at->path());
    if (error) throw std::runtime_error("folder " + folder.string() + " cannot be read: " + error.message());
    std::sort(entries.begin(), entries.end());
    return entries;
}

std::vector<fs::path> list_files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        if (at->is_directory(ignored) && (at.depth() >= max_depth || is_ignored_folder(at->path())))
            at.disable_recursion_pending();
        else if (at->is_regular_file(ignored))
            files.push_back(at->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace tandem::command
