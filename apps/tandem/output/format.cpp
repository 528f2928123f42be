// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"

#include "host/text/printable.hpp"
#include "shm/os/clock.hpp"

#include <fmt/format.h>

#include <pwd.h>
#include <vector>

namespace tandem::command {

std::string format_bytes(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    auto value = static_cast<double>(bytes);
    const char* unit = "B";
    for (const char* next : {"KiB", "MiB", "GiB", "TiB"}) {
        if (value < 1024) break;
        value /= 1024;
        unit = next;
    }
    // Writes 8 MiB instead of 8.0 MiB, because most sizes in shared memory are powers of two.
    std::string number = fmt::format("{:.{}f}", value, value < 100 ? 1 : 0);
    if (number.size() > 2 && number.compare(number.size() - 2, 2, ".0") == 0)
        number.resize(number.size() - 2);
    return number + " " + unit;
}

std::string format_duration(std::uint64_t ns) {
    constexpr std::uint64_t us = 1000, ms = 1000 * us, s = 1000 * ms, minute = 60 * s, hour = 60 * minute;
    // Changes to a larger unit only above about ten of it, so that at least two digits remain.
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

std::string format_pid(std::uint32_t pid, std::uint32_t elsewhere) {
    return elsewhere != 0 ? fmt::format("pid {} of another namespace", elsewhere)
                          : fmt::format("pid {}", pid);
}

std::string user_name(uid_t user) {
    std::vector<char> buffer(16384); // longer entries are shown as a number
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

std::string replace_control_characters(const std::string& text) { return text::printable_line(text); }

} // namespace tandem::command
