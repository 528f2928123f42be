// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/bag/times.hpp"

#include <ctime>
#include <fmt/format.h>
#include <limits>
#include <regex>
#include <stdexcept>

namespace tandem::command {
namespace {

constexpr std::uint64_t second = 1'000'000'000;
constexpr std::uint64_t year_1973 = 100'000'000 * second;
constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();

/// Converts the digits after a decimal point to nanoseconds. Drops digits after the ninth.
std::uint64_t fraction(std::string digits) {
    digits.resize(9, '0');
    return std::stoull(digits);
}

/// Converts digits to seconds. Returns false if nanoseconds in 64 bits cannot represent them.
bool seconds(const std::string& digits, std::uint64_t& value) {
    if (digits.size() > 11) return false;
    value = std::stoull(digits);
    return value < last / second;
}

} // namespace

std::string format_time(std::uint64_t ns) {
    if (ns < year_1973) return fmt::format("{}.{:09} s", ns / second, ns % second);
    const auto whole = static_cast<std::time_t>(ns / second);
    std::tm utc{};
    gmtime_r(&whole, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:09}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                       utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, ns % second);
}

std::uint64_t parse_time(const std::string& text, std::uint64_t begin, const std::string& option) {
    static const std::regex relative(R"((\d+)(\.(\d+))?)");
    static const std::regex absolute(
        R"((\d{4})-(\d\d)-(\d\d)[Tt ](\d\d):(\d\d):(\d\d)(\.(\d+))?([Zz]|([+-])(\d\d):(\d\d)))");
    std::smatch found;
    std::uint64_t whole = 0;
    if (std::regex_match(text, found, relative) && seconds(found[1], whole)) {
        const std::uint64_t offset = whole * second + fraction(found[3]);
        return begin > last - offset ? last : begin + offset;
    }
    if (std::regex_match(text, found, absolute)) {
        const auto number = [&](std::size_t group) { return std::stoi(found[group]); };
        std::tm utc{};
        utc.tm_year = number(1) - 1900;
        utc.tm_mon = number(2) - 1;
        utc.tm_mday = number(3);
        utc.tm_hour = number(4);
        utc.tm_min = number(5);
        utc.tm_sec = number(6);
        const std::tm asked = utc;
        std::time_t time = timegm(&utc); // normalizes the fields: February 31 becomes March 3
        const bool exists = utc.tm_mday == asked.tm_mday && utc.tm_mon == asked.tm_mon &&
                            utc.tm_hour == asked.tm_hour && utc.tm_min == asked.tm_min;
        if (found[10].matched) time -= (found[10] == "-" ? -60L : 60L) * (60 * number(11) + number(12));
        if (exists && time >= 0 && static_cast<std::uint64_t>(time) < last / second)
            return static_cast<std::uint64_t>(time) * second + fraction(found[8]);
    }
    throw std::runtime_error(option + " " + text +
                             " is not a valid time: expected seconds from the start, for example 1.5, or a "
                             "time such as 2026-11-23T08:15:00Z");
}

} // namespace tandem::command
