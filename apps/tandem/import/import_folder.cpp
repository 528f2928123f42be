// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/import_folder.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <stdexcept>
#include <string>

namespace tandem::command {

namespace fs = std::filesystem;

ImportFolder::ImportFolder(const fs::path& output, const fs::path& imported, const char* side)
    : output_(output.empty() ? fs::path(fs::canonical(imported).filename().string() + "-tandem") : output),
      staged_(output_), path_(staged_.add_side(side)),
      place_(fs::absolute(output_ / side).lexically_normal()) {}

void ImportFolder::complete(ImportReport& report, const std::function<void()>& write) {
    const auto with_place = [&](std::string text) {
        boost::replace_all(text, path_.string(), place_.string());
        return text;
    };
    try {
        write();
    } catch (const std::exception& error) {
        throw std::runtime_error(with_place(error.what()));
    }
    staged_.publish();
    report.change_texts(with_place);
}

} // namespace tandem::command
