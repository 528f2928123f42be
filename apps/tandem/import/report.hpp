// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// What an import has written, what is to be done, and what will differ.
class ImportReport {
  public:
    void add_file(const std::filesystem::path& file) { files_.push_back(file); }
    /// Without it tandem run fails, or a part is missing. `where` is empty if `what` says it; `command` is one to be typed,
    /// or empty.
    void add_task(const std::string& where, const std::string& what, const std::string& command);
    /// `where`: FILE:LINE or a file; `what`: the setting there; `here`: what happens with it. A line that was told already
    /// is not told again.
    void add_difference(const std::string& where, const std::string& what, const std::string& here);

    /// `differences`: the page with those that are the same for each import.
    void print(const std::filesystem::path& output, const char* differences, bool as_json) const;

  private:
    struct Line {
        std::string where, what, here;
        bool operator==(const Line&) const = default;
    };
    std::vector<std::filesystem::path> files_;
    std::vector<Line> tasks_, differences_;
};

} // namespace tandem::command
