// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"

#include "shm/os/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <pwd.h>
#include <stdexcept>

namespace tandem::command {

Table::Table(std::vector<std::string> headings) {
    for (auto& heading : headings) {
        right_aligned_.push_back(!heading.empty() && heading.front() == '>');
        if (right_aligned_.back()) heading.erase(0, 1);
    }
    rows_.push_back(std::move(headings));
}

void Table::add_row(std::vector<std::string> row) {
    row.resize(right_aligned_.size());
    rows_.push_back(std::move(row));
}

std::string Table::text() const {
    std::vector<std::size_t> width(right_aligned_.size());
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    std::string text;
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += right_aligned_[i] ? fmt::format("{:>{}}  ", row[i], width[i])
                                      : fmt::format("{:<{}}  ", row[i], width[i]);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

std::string format_bytes(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    auto value = static_cast<double>(bytes);
    const char* unit = "B";
    for (const char* next : {"KiB", "MiB", "GiB", "TiB"}) {
        if (value < 1024) break;
        value /= 1024;
        unit = next;
    }
    std::string number = fmt::format("{:.{}f}", value, value < 100 ? 1 : 0);
    if (number.size() > 2 && number.compare(number.size() - 2, 2, ".0") == 0)
        number.resize(number.size() - 2);
    return number + " " + unit;
}

std::string format_duration(std::uint64_t ns) {
    constexpr std::uint64_t us = 1000, ms = 1000 * us, s = 1000 * ms, minute = 60 * s, hour = 60 * minute;
    if (ns < 10 * us) return fmt::format("{} ns", ns);
    if (ns < 10 * ms) return fmt::format("{} us", ns / us);
    if (ns < 10 * s) return fmt::format("{} ms", ns / ms);
    if (ns < 3 * minute) return fmt::format("{} s", ns / s);
    if (ns < 3 * hour) return fmt::format("{} min", ns / minute);
    return ns < 48 * hour ? fmt::format("{} h", ns / hour) : fmt::format("{} d", ns / hour / 24);
}

std::string format_age(std::uint64_t since_ns) {
    const std::uint64_t now = shm::now_ns();
    return since_ns == 0 || since_ns > now ? "-" : format_duration(now - since_ns);
}

std::string user_name(uid_t user) {
    std::vector<char> buffer(16384);
    struct passwd entry {};
    struct passwd* found = nullptr;
    getpwuid_r(user, &entry, buffer.data(), buffer.size(), &found);
    return found != nullptr ? found->pw_name : std::to_string(user);
}

std::string replace_nonprintable(const std::string& text) {
    std::string safe = text;
    for (char& c : safe)
        if (c < ' ' || c > '~') c = '?';
    return safe;
}

std::string replace_control_characters(std::string text) {
    for (char& c : text)
        if ((c >= 0 && c < ' ') || c == 0x7f) c = '?';
    return text;
}

void print_text(const std::string& text) {
    if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        throw std::runtime_error(std::string("standard output cannot be written: ") + std::strerror(errno));
}

void print_json(const nlohmann::json& value, bool one_line) {
    print_text(value.dump(one_line ? -1 : 2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

} // namespace tandem::command
