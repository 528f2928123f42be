// SPDX-License-Identifier: Apache-2.0
// String functions of coil, with the behaviour that components written for OpenRTM-aist expect of each.
// Strings are sequences of bytes; only ASCII characters have an upper and a lower case here.
#include <algorithm>
#include <arpa/inet.h>
#include <clocale>
#include <coil/stringutil.h>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <istream>
#include <langinfo.h>

namespace coil {
namespace {

// Without vertical tab and form feed, which std::isspace() would add.
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// While an object exists, this thread writes numbers as in the classic locale, even if a component has called
// setlocale(). Letters keep their locale.
class ClassicNumbers {
  public:
    ClassicNumbers() {
        if (std::strcmp(nl_langinfo(RADIXCHAR), ".") == 0) return;
        const locale_t copy = duplocale(uselocale(nullptr));
        if (copy == nullptr) return;
        own_ = newlocale(LC_NUMERIC_MASK, "C", copy);
        if (own_ != nullptr)
            before_ = uselocale(own_);
        else
            freelocale(copy);
    }
    ~ClassicNumbers() {
        if (own_ == nullptr) return;
        uselocale(before_);
        freelocale(own_);
    }
    ClassicNumbers(const ClassicNumbers&) = delete;
    ClassicNumbers& operator=(const ClassicNumbers&) = delete;

  private:
    locale_t own_ = nullptr, before_ = nullptr;
};

} // namespace

// Byte by byte, as in OpenRTM-aist: only for ASCII.
std::wstring string2wstring(const std::string& str) { return std::wstring(str.begin(), str.end()); }
std::string wstring2string(const std::wstring& wstr) {
    std::string narrow;
    for (wchar_t c : wstr) narrow += static_cast<char>(c);
    return narrow;
}

std::string toUpper(std::string str) noexcept {
    for (char& c : str)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return str;
}
std::string toLower(std::string str) noexcept {
    for (char& c : str)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return str;
}

// Lines of files that were written on Windows end with CR LF.
std::string getlinePortable(std::istream& in) {
    std::string line;
    std::getline(in, line);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

// A backslash that is itself escaped does not escape the next character.
bool isEscaped(const std::string& str, std::string::size_type pos) {
    std::size_t backslashes = 0;
    while (pos > 0 && str[--pos] == '\\') ++backslashes;
    return backslashes % 2 == 1;
}

// Writes the escapes of unescape(), so that unescape(escape(s)) equals s.
std::string escape(const std::string& str) {
    std::string out;
    for (char c : str) {
        if (c == '\t')
            out += "\\t";
        else if (c == '\n')
            out += "\\n";
        else if (c == '\f')
            out += "\\f";
        else if (c == '\r')
            out += "\\r";
        else if (c == '\\')
            out += "\\\\";
        else
            out += c;
    }
    return out;
}

// \t \n \f \r; any other escaped character is itself; a single backslash at the end stays.
std::string unescape(std::string str) noexcept {
    std::string out;
    for (std::size_t i = 0; i < str.size(); ++i) {
        if (str[i] != '\\' || i + 1 == str.size()) {
            out += str[i];
            continue;
        }
        switch (str[++i]) {
        case 't':
            out += '\t';
            break;
        case 'n':
            out += '\n';
            break;
        case 'f':
            out += '\f';
            break;
        case 'r':
            out += '\r';
            break;
        default:
            out += str[i];
        }
    }
    return out;
}

// Removes all blanks, including those between words.
std::string eraseBlank(std::string str) noexcept {
    str.erase(std::remove_if(str.begin(), str.end(), is_blank), str.end());
    return str;
}
std::string eraseHeadBlank(std::string str) noexcept {
    str.erase(str.begin(), std::find_if_not(str.begin(), str.end(), is_blank));
    return str;
}
// An escaped blank at the end is part of the text.
std::string eraseTailBlank(std::string str) noexcept {
    while (!str.empty() && is_blank(str.back()) && !isEscaped(str, str.size() - 1)) str.pop_back();
    return str;
}
// The trimming of all configuration values.
std::string eraseBothEndsBlank(std::string str) noexcept {
    return eraseTailBlank(eraseHeadBlank(std::move(str)));
}
// For comparing words of configuration files: trimmed, in lower case.
std::string normalize(std::string str) noexcept { return toLower(eraseBothEndsBlank(std::move(str))); }

// The replacement is not searched again, so `a` -> `aa` ends.
std::string replaceString(std::string str, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; !from.empty() && (at = str.find(from, at)) != std::string::npos; at += to.size())
        str.replace(at, from.size(), to);
    return str;
}

// `a,,b` has an empty part in the middle unless `ignore_empty`; an empty delimiter does not split.
vstring split(const std::string& input, const std::string& delimiter, bool ignore_empty) {
    vstring parts;
    if (input.empty()) return parts;
    if (delimiter.empty()) return {eraseBothEndsBlank(input)};
    for (std::size_t begin = 0; begin <= input.size();) {
        std::size_t end = std::min(input.find(delimiter, begin), input.size());
        std::string part = eraseBothEndsBlank(input.substr(begin, end - begin));
        if (!(ignore_empty && part.empty())) parts.push_back(part);
        begin = end + delimiter.size();
    }
    return parts;
}

// Finds the words anywhere in the text and looks for `yes` first: "YES, please" is true.
bool toBool(std::string str, std::string yes, std::string no, bool default_value) {
    str = toUpper(str);
    if (str.find(toUpper(std::move(yes))) != std::string::npos) return true;
    if (str.find(toUpper(std::move(no))) != std::string::npos) return false;
    return default_value;
}

// Returns whether the value is an element of the list. The list may also be text with commas.
bool includes(const vstring& list, std::string value, bool ignore_case) {
    if (ignore_case) value = toLower(value);
    return std::any_of(list.begin(), list.end(),
                       [&](const std::string& one) { return (ignore_case ? toLower(one) : one) == value; });
}
bool includes(const std::string& list, std::string value, bool ignore_case) {
    return includes(split(list, ","), std::move(value), ignore_case);
}

bool isAbsolutePath(const std::string& str) { return !str.empty() && str[0] == '/'; }
// A scheme before `://`; what follows is not checked.
bool isURL(const std::string& str) {
    std::size_t at = str.find("://");
    return at != 0 && at != std::string::npos;
}
// Numeric addresses in the forms of inet_pton(3); names are not resolved.
bool isIPv4(const std::string& str) {
    in_addr address;
    return inet_pton(AF_INET, str.c_str(), &address) == 1;
}
bool isIPv6(const std::string& str) {
    in6_addr address;
    return inet_pton(AF_INET6, str.c_str(), &address) == 1;
}
// A decimal port number of TCP or UDP.
bool isIPPort(const std::string& str) {
    int port = 0;
    return stringTo(port, str.c_str()) && port >= 0 && port < 65536;
}

// A parameter without `=` has an empty value.
mapstring urlparam2map(const std::string& str) {
    mapstring map;
    std::size_t question = str.find('?');
    for (const auto& param :
         split(question == std::string::npos ? str : str.substr(question + 1), "&", true)) {
        std::size_t equals = param.find('=');
        if (equals == std::string::npos)
            map[param] = "";
        else
            map[eraseBothEndsBlank(param.substr(0, equals))] = eraseBothEndsBlank(param.substr(equals + 1));
    }
    return map;
}

// A command line: blanks separate words, except within double quotes; a backslash escapes the next character.
vstring parseArgs(const std::string& args) {
    vstring words;
    std::string word;
    bool quoted = false, started = false;
    for (std::size_t i = 0; i < args.size(); ++i) {
        if (args[i] == '"' && !isEscaped(args, i)) {
            quoted = !quoted;
            started = true;
        } else if (is_blank(args[i]) && !quoted) {
            if (started) words.push_back(unescape(word));
            word.clear();
            started = false;
        } else {
            word += args[i];
            started = true;
        }
    }
    if (started) words.push_back(unescape(word));
    return words;
}

// Keeps the first of equal strings, in their order.
// NOLINTNEXTLINE(performance-unnecessary-value-param): signature of OpenRTM-aist
vstring unique_sv(vstring sv) {
    vstring out;
    for (auto& s : sv)
        if (std::find(out.begin(), out.end(), s) == out.end()) out.push_back(s);
    return out;
}

// The opposite of split().
std::string flatten(vstring sv, const std::string& delimiter) {
    std::string out;
    for (std::size_t i = 0; i < sv.size(); ++i) out += (i ? delimiter : "") + sv[i];
    return out;
}

// The caller deletes the result. Exists for components written for 1.x; new code uses Argv.
char** toArgv(const vstring& args) {
    char** argv = new char*[args.size() + 1];
    for (std::size_t i = 0; i < args.size(); ++i) {
        argv[i] = new char[args[i].size() + 1];
        args[i].copy(argv[i], args[i].size());
        argv[i][args[i].size()] = '\0';
    }
    argv[args.size()] = nullptr;
    return argv;
}

// The strings are writable, with their terminating NUL, as main() and exec functions want them.
Argv::Argv(const vstring& args) {
    for (const auto& arg : args) {
        args_.emplace_back(arg.begin(), arg.end());
        args_.back().push_back('\0');
    }
    for (auto& arg : args_) argv_.push_back(arg.data());
    argv_.push_back(nullptr);
}

// Formats twice, because the first pass finds the length.
std::string sprintf(const char* fmt, ...) {
    const ClassicNumbers numbers;
    va_list args, again;
    va_start(args, fmt);
    va_copy(again, args);
    int length = std::vsnprintf(nullptr, 0, fmt, args);
    std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
    if (length > 0) std::vsnprintf(&text[0], text.size() + 1, fmt, again);
    va_end(again);
    va_end(args);
    return text;
}

// Replaces ${NAME} by the variable's value, or by nothing if it is not set. An unclosed ${ remains.
// NOLINTNEXTLINE(performance-unnecessary-value-param): signature of OpenRTM-aist
std::string replaceEnv(std::string str) {
    std::string out;
    for (std::size_t at = 0; at < str.size();) {
        std::size_t begin = str.find("${", at);
        std::size_t end = begin == std::string::npos ? begin : str.find('}', begin);
        if (end == std::string::npos) return out + str.substr(at);
        const char* value = std::getenv(str.substr(begin + 2, end - begin - 2).c_str());
        out += str.substr(at, begin - at) + (value ? value : "");
        at = end + 1;
    }
    return out;
}

} // namespace coil
