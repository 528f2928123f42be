// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_STRINGUTIL_H
#define COIL_STRINGUTIL_H
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <locale>
#include <map>
#include <rtm/TandemAbi.h>
#include <sstream>
#include <string>
#include <vector>

namespace coil {

using vstring = std::vector<std::string>;
using mapstring = std::map<std::string, std::string>;

std::wstring string2wstring(const std::string& str);
std::string wstring2string(const std::wstring& wstr);
std::string toUpper(std::string str) noexcept;
std::string toLower(std::string str) noexcept;
/// Returns one line without its CR or LF.
std::string getlinePortable(std::istream& in);
/// Returns true if an odd number of backslashes precede the character at `pos`.
bool isEscaped(const std::string& str, std::string::size_type pos);
std::string escape(const std::string& str);
std::string unescape(std::string str) noexcept;
std::string eraseBlank(std::string str) noexcept;
std::string eraseHeadBlank(std::string str) noexcept;
std::string eraseTailBlank(std::string str) noexcept;
std::string eraseBothEndsBlank(std::string str) noexcept;
/// Removes blanks at both ends and converts to lower case.
std::string normalize(std::string str) noexcept;
std::string replaceString(std::string str, const std::string& from, const std::string& to);
/// Removes blanks at both ends of each part. An empty input has no parts.
vstring split(const std::string& input, const std::string& delimiter, bool ignore_empty = false);
bool toBool(std::string str, std::string yes, std::string no, bool default_value = true);
bool includes(const vstring& list, std::string value, bool ignore_case = true);
bool includes(const std::string& list, std::string value, bool ignore_case = true);
bool isAbsolutePath(const std::string& str);
bool isURL(const std::string& str);
bool isIPv4(const std::string& str);
bool isIPv6(const std::string& str);
bool isIPPort(const std::string& str);
/// Converts `x?a=1&b=2` to {a: 1, b: 2}.
mapstring urlparam2map(const std::string& str);
vstring parseArgs(const std::string& args);
vstring unique_sv(vstring sv);
std::string flatten(vstring sv, const std::string& delimiter = ", ");
std::string sprintf(const char* fmt, ...);
std::string replaceEnv(std::string str);

// Numbers in text use the classic locale, even if a component calls std::locale::global() or setlocale().

template <class Printable>
std::string otos(Printable n) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << n;
    return out.str();
}

/// Converts text to a value with operator>>. Returns false, with `val` unspecified, if the text does not begin with
/// one.
template <typename To>
bool stringTo(To& val, const char* str) {
    if (str == nullptr) return false;
    std::istringstream in(str);
    in.imbue(std::locale::classic());
    return static_cast<bool>(in >> val);
}
template <>
bool stringTo<std::string>(std::string& val, const char* str);
template <>
bool stringTo<bool>(bool& val, const char* str);
/// Durations are in seconds and may have fractions.
template <>
bool stringTo<std::chrono::duration<double>>(std::chrono::duration<double>& val, const char* str);
template <>
bool stringTo<std::chrono::nanoseconds>(std::chrono::nanoseconds& val, const char* str);
template <>
bool stringTo<std::chrono::microseconds>(std::chrono::microseconds& val, const char* str);
template <>
bool stringTo<std::chrono::milliseconds>(std::chrono::milliseconds& val, const char* str);
template <>
bool stringTo<std::chrono::seconds>(std::chrono::seconds& val, const char* str);
/// Converts comma-separated elements. Returns false, without changing `val`, if one is invalid.
template <typename T>
bool stringTo(std::vector<T>& val, const char* str) {
    if (str == nullptr) return false;
    std::vector<T> parsed;
    for (const auto& part : split(str, ",")) {
        T element{};
        if (!stringTo(element, part.c_str())) return false;
        parsed.push_back(element);
    }
    val = parsed;
    return true;
}

template <class T>
std::string ptrToHex(T* n) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::hex << std::showbase << reinterpret_cast<std::uintptr_t>(n);
    return out.str();
}
template <class T>
bool hexToPtr(T*& ptr, const std::string& str) {
    std::istringstream in(str);
    in.imbue(std::locale::classic());
    std::uintptr_t value = 0;
    if (!(in >> std::hex >> value)) return false;
    ptr = reinterpret_cast<T*>(value);
    return ptr != nullptr;
}

/// Returns an `argv` that ends with NULL, as in 1.x. The caller frees each string and the array with delete[].
char** toArgv(const vstring& args);

/// An `argv` and the strings that it points to.
class Argv {
  public:
    Argv() = default;
    explicit Argv(const vstring& args);
    Argv(const Argv&) = delete;
    Argv& operator=(const Argv&) = delete;
    Argv(Argv&&) = default;
    Argv& operator=(Argv&&) = default;
    char** get() noexcept { return args_.empty() ? nullptr : argv_.data(); }
    std::size_t size() const noexcept { return args_.size(); }

  private:
    std::vector<std::vector<char>> args_;
    std::vector<char*> argv_;
};

} // namespace coil
#endif
