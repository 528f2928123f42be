// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tandem::command {

/// Collects the files that an import wrote, the remaining tasks, and the differences to the original installation.
class ImportReport {
  public:
    void add_file(const std::filesystem::path& file) { files_.push_back(file); }
    /// Adds a task without which tandem run fails or a part is missing. `where` is empty if `what` contains the place.
    /// `command`: the command to type, or empty.
    void add_task(const std::string& where, const std::string& what, const std::string& command);
    /// `where`: FILE:LINE or a file. `what`: the setting there. `here`: its effect in Tandem. Ignores repeated lines.
    void add_difference(const std::string& where, const std::string& what, const std::string& here);

    /// Replaces each text and the name of each file by what `change` returns.
    void change_texts(const std::function<std::string(std::string)>& change);

    /// `page`: the page of the documentation with the differences that all `imported` files have.
    void print(const std::filesystem::path& output, const char* page, const char* imported,
               bool as_json) const;

  private:
    struct Line {
        std::string where, what, here;
        bool operator==(const Line&) const = default;
    };
    std::vector<std::filesystem::path> files_;
    std::vector<Line> tasks_, differences_;
};

} // namespace tandem::command
