// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/run_command.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>
#include <string>
#include <system_error>

namespace tandem::test {

/// While it exists, this process has the locale that a component may set by std::locale::global(std::locale("de_DE.UTF-8")):
/// numbers have a decimal comma, and points between thousands. The C library needs a locale that localedef makes here; without
/// it, a test continues with the C++ library's and is listed as skipped.
class CommaLocale {
  public:
    CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new Comma))) {
        folder_ = (std::filesystem::temp_directory_path() / "tandem-locale-XXXXXX").string();
        if (mkdtemp(folder_.data()) == nullptr || !set_in_c_library())
            TANDEM_SKIP_PART("localedef makes no locale with a decimal comma here: only that of the C++ "
                             "library is tested");
    }
    ~CommaLocale() {
        std::setlocale(LC_NUMERIC, "C");
        std::locale::global(before_);
        std::filesystem::remove_all(folder_);
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

  private:
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };

    bool set_in_c_library() const {
        std::ofstream(folder_ + "/comma")
            << "LC_NUMERIC\ndecimal_point \"<U002C>\"\nthousands_sep \"<U002E>\"\n"
               "grouping 3;3\nEND LC_NUMERIC\n";
        // Exit code 1: made, with a warning for each category that is not defined.
        try {
            process::run_command(
                {"localedef", "-c", "-i", folder_ + "/comma", "-f", "UTF-8", folder_ + "/xx_XX.UTF-8"});
        } catch (const std::system_error&) {
            return false; // not installed
        }
        setenv("LOCPATH", folder_.c_str(), 1);
        const bool is_set = std::setlocale(LC_NUMERIC, "xx_XX.UTF-8") != nullptr;
        unsetenv("LOCPATH");
        return is_set && *std::localeconv()->decimal_point == ',';
    }

    std::locale before_;
    std::string folder_;
};

} // namespace tandem::test
