// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/autoconf.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace tandem::command {
namespace {

using Words = std::vector<std::string>;

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool is_identifier(const std::string& name) {
    return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
           std::all_of(name.begin(), name.end(), is_word);
}

// Removes comments of m4, and lines that are comments of the shell.
std::string without_comments(const std::string& text) {
    std::istringstream lines(text);
    std::string code;
    for (std::string line; std::getline(lines, line); code += line + '\n') {
        if (line.ends_with('\r')) line.pop_back();
        const auto begin = line.find_first_not_of(" \t");
        if (begin != std::string::npos && line[begin] == '#') line.clear();
        for (auto at = line.find("dnl"); at != std::string::npos; at = line.find("dnl", at + 1))
            if ((at == 0 || !is_word(line[at - 1])) && (at + 3 == line.size() || !is_word(line[at + 3])))
                line.resize(at);
    }
    return code;
}

// Removes blanks and quotes of m4 around an argument.
std::string_view unquote(std::string_view text) {
    for (;;) {
        const auto begin = text.find_first_not_of(" \t\n"), end = text.find_last_not_of(" \t\n");
        if (begin == std::string::npos) return "";
        text = text.substr(begin, end - begin + 1);
        if (text.front() != '[' || text.back() != ']') return text;
        text = text.substr(1, text.size() - 2);
    }
}

// Returns the arguments of the macro whose opening parenthesis is at `at`, and moves `at` to the closing one.
Words read_arguments(const std::string& text, std::size_t& at) {
    Words arguments{""};
    int quotes = 0, parentheses = 0;
    for (++at; at < text.size(); ++at) {
        const char c = text[at];
        quotes += c == '[' ? 1 : c == ']' ? -1 : 0;
        if (quotes == 0 && c == ')' && parentheses-- == 0) break;
        if (quotes == 0 && c == '(') ++parentheses;
        if (quotes == 0 && parentheses == 0 && c == ',')
            arguments.emplace_back();
        else
            arguments.back() += c;
    }
    for (auto& argument : arguments) argument = std::string(unquote(argument));
    return arguments;
}

// Returns whether neither the shell, m4 nor CMake would change the value.
bool is_plain(const std::string& value) {
    return value.find_first_of("$;#\\`()") == std::string::npos &&
           std::none_of(value.begin(), value.end(), [](unsigned char c) { return std::iscntrl(c) != 0; });
}

// Returns whether the word is in the place of a macro's name before its arguments.
bool is_macro(const std::string& word) {
    return std::isupper(static_cast<unsigned char>(word[0])) != 0 || word.starts_with("m4_");
}

// Returns whether a command of the shell begins after the word.
bool precedes_command(const std::string& word) {
    static const std::set<std::string> words{"then", "else", "elif", "do", "if", "while", "until"};
    return words.count(word) != 0;
}

class Reader {
  public:
    // Skips the arguments of other macros: what they contain is conditional.
    Words read(const std::string& text) {
        bool at_command = true;
        for (std::size_t at = 0; at < text.size();) {
            auto end = at;
            while (end < text.size() && is_word(text[end])) ++end;
            const auto word = text.substr(at, end - at);
            if (word.empty()) {
                at_command = begins_command(text, at) || (at_command && is_space(text[at]));
                ++at;
                continue;
            }
            at = end;
            if (at < text.size() && text[at] == '(' && is_macro(word))
                call(word, read_arguments(text, at));
            else if (at_command)
                shell_word(word);
            at_command = at_command && precedes_command(word);
        }
        return std::move(definitions_);
    }

  private:
    // Returns whether a command of the shell begins after the character. What follows && or || is conditional up to the end of
    // the line.
    bool begins_command(const std::string& text, std::size_t at) {
        const char c = text[at], before = at > 0 ? text[at - 1] : '\n';
        if (c == '\n' && before != '&' && before != '|' && before != '\\') after_operator_ = false;
        if ((c == '&' || c == '|') && before == c) after_operator_ = true;
        return c == '\n' || c == ';' || c == '&' || c == '|';
    }

    void shell_word(const std::string& word) {
        static const std::set<std::string> begin{"if", "case", "for", "while", "until"},
            end{"fi", "esac", "done"};
        conditions_ += static_cast<int>(begin.count(word)) - static_cast<int>(end.count(word));
    }

    void call(const std::string& macro, const Words& arguments) {
        if (conditions_ != 0 || after_operator_) return;
        if (macro == "AC_DEFINE")
            add(arguments[0], arguments.size() > 1 ? arguments[1] : "1");
        else if (macro == "AC_INIT" && arguments.size() > 1)
            init(arguments[0], arguments[1]);
        else if (macro == "AM_INIT_AUTOMAKE" && arguments.size() > 1)
            add_package("PACKAGE", "VERSION", arguments[0], arguments[1]);
        else if (macro == "AM_INIT_AUTOMAKE" && !name_.empty())
            add_package("PACKAGE", "VERSION", short_name(name_), version_);
    }

    void init(const std::string& name, const std::string& version) {
        name_ = name;
        version_ = version;
        add_package("PACKAGE_NAME", "PACKAGE_VERSION", name, version);
    }

    void add(const std::string& name, const std::string& value) {
        if (is_identifier(name) && is_plain(value)) definitions_.push_back(name + "=" + value);
    }

    void add_package(const char* name_macro, const char* version_macro, const std::string& name,
                     const std::string& version) {
        for (const auto& [macro, value] : {std::pair(name_macro, name), std::pair(version_macro, version)})
            if (value.find('"') == std::string::npos) add(macro, '"' + value + '"');
    }

    static std::string short_name(std::string name) {
        name = to_lower(std::move(name));
        for (char& c : name)
            if (!is_word(c)) c = '-';
        return name;
    }

    Words definitions_;
    std::string name_, version_;
    int conditions_ = 0; // of the shell around the place
    bool after_operator_ = false;
};

} // namespace

std::vector<std::string> read_autoconf_definitions(const std::filesystem::path& configure_ac) {
    return Reader().read(without_comments(read_text(configure_ac)));
}

} // namespace tandem::command
