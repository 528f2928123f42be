// SPDX-License-Identifier: Apache-2.0
// The conversions from text for which operator>> does not suit configuration files: whole strings, words
// for bool, durations.
#include <cmath>
#include <coil/stringutil.h>

namespace coil {
namespace {

// Reads seconds with fractions. Returns false for values that do not fit into 64 bits of nanoseconds, and for infinity
// and NaN.
template <class Duration>
bool seconds_to(Duration& val, const char* str) {
    double seconds = 0;
    if (!stringTo(seconds, str) || !(std::abs(seconds) < 9e9)) return false; // 292 years of nanoseconds
    val = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
    return true;
}

} // namespace

// The whole text, where operator>> would stop at the first blank.
template <>
bool stringTo<std::string>(std::string& val, const char* str) {
    if (str == nullptr) return false;
    val = str;
    return true;
}

template <>
bool stringTo<bool>(bool& val, const char* str) {
    if (str == nullptr) return false;
    const std::string text = normalize(str);
    const bool is_true = text == "true" || text == "1" || text == "yes" || text == "on";
    const bool is_false = text == "false" || text == "0" || text == "no" || text == "off";
    if (!is_true && !is_false) return false; // `val` keeps its value
    val = is_true;
    return true;
}

template <>
bool stringTo<std::chrono::duration<double>>(std::chrono::duration<double>& val, const char* str) {
    return seconds_to(val, str);
}
template <>
bool stringTo<std::chrono::nanoseconds>(std::chrono::nanoseconds& val, const char* str) {
    return seconds_to(val, str);
}
template <>
bool stringTo<std::chrono::microseconds>(std::chrono::microseconds& val, const char* str) {
    return seconds_to(val, str);
}
template <>
bool stringTo<std::chrono::milliseconds>(std::chrono::milliseconds& val, const char* str) {
    return seconds_to(val, str);
}
template <>
bool stringTo<std::chrono::seconds>(std::chrono::seconds& val, const char* str) {
    return seconds_to(val, str);
}

} // namespace coil
