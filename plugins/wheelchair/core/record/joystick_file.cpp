// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/record/joystick_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

namespace {

constexpr std::size_t max_samples = 10'000'000; // limits the memory for a wrong file

// Removes blanks at both ends, including the CR of a Windows file.
std::string_view trimmed(std::string_view text) {
    const auto blank = " \t\r";
    const auto first = text.find_first_not_of(blank);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// Returns the finite number that is the whole text. std::from_chars ignores the locale, unlike std::stod.
std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

/// Parses one line. Messages contain its place.
class Line {
  public:
    Line(const std::string& path, std::size_t number) : path_(path), number_(number) {}

    [[noreturn]] void wrong(const std::string& what) const {
        throw InputError(path_ + ":" + std::to_string(number_) + ": " + what +
                         "; expected t, jx, jy, estop such as 5.00, 1100, 900, 0");
    }

    JoystickRecording::Sample parse(std::string_view text) const {
        std::array<double, 4> v{};
        for (std::size_t i = 0; i < v.size(); ++i) {
            const auto comma = text.find(',');
            if ((comma == text.npos) != (i + 1 == v.size())) wrong("not four columns");
            const auto field = trimmed(text.substr(0, comma));
            const auto value = number(field);
            if (!value) wrong(std::string(field).insert(0, 1, '\'') + "' is not a number");
            v[i] = *value;
            if (comma != text.npos) text.remove_prefix(comma + 1);
        }
        check(v);
        return {v[0], {v[1], v[2], v[3] != 0.0}};
    }

  private:
    void check(const std::array<double, 4>& v) const {
        const double max_count = JoystickParameters{}.max_count;
        if (v[0] < 0.0) wrong("time before 0");
        for (int i : {1, 2})
            if (v[i] != std::floor(v[i]) || std::abs(v[i]) > max_count)
                wrong("stick position is not a whole number from -2000 to 2000");
        if (v[3] != 0.0 && v[3] != 1.0) wrong("estop is neither 0 nor 1");
    }

    const std::string& path_;
    std::size_t number_;
};

// Allowed only before the first sample; later text is an error.
bool is_heading(std::string_view text) { return text.starts_with("t,") || text.starts_with("t "); }

} // namespace

JoystickPosition JoystickRecording::at(double t) const {
    const auto later = std::upper_bound(samples_.begin(), samples_.end(), t + age_tolerance,
                                        [](double time, const Sample& s) { return time < s.t; });
    return later == samples_.begin() ? JoystickPosition{} : std::prev(later)->position;
}

JoystickRecording read_joystick_file(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw InputError(path + ": cannot be read; give a CSV file with columns t, jx, jy, estop");
    std::vector<JoystickRecording::Sample> samples;
    std::string text;
    for (std::size_t number = 1; std::getline(file, text); ++number) {
        const auto content = trimmed(text);
        if (content.empty() || content.front() == '#' || (samples.empty() && is_heading(content))) continue;
        const Line line(path, number);
        const auto sample = line.parse(content);
        if (!samples.empty() && sample.t < samples.back().t) line.wrong("time runs backwards");
        if (samples.size() == max_samples) line.wrong("too many lines");
        samples.push_back(sample);
    }
    if (samples.empty())
        throw InputError(path + ": holds no stick position; expected lines t, jx, jy, estop");
    return JoystickRecording(std::move(samples));
}

} // namespace tandem::wheelchair
