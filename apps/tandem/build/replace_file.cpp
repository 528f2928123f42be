// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/replace_file.hpp"

#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "host/process/run_command.hpp"

#include <chrono>
#include <stdexcept>
#include <system_error>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns whether the file belongs to the repository's contents. Without git, it counts as untracked.
bool is_tracked(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored) || find_checkout(file.parent_path()).empty()) return false;
    process::CommandOptions options;
    options.timeout = std::chrono::seconds(10);
    options.merge_errors = true;
    try {
        return process::run_command({"git", "-C", file.parent_path().string(), "ls-files", "--error-unmatch",
                                     "--", file.filename().string()},
                                    options)
            .succeeded();
    } catch (const std::system_error&) {
        return false;
    }
}

} // namespace

void tell_replaced(const fs::path& file) {
    if (is_tracked(file))
        print_note(
            "tandem: {} is tracked by git and is replaced; git restore brings it back, --output DIR builds "
            "elsewhere\n",
            file.string());
}

// Replaces the library by rename(2), not by writing into it: a running host may have the old file mapped, and a
// copy that fails half-way must not leave half a library.
void replace_library(const fs::path& cmake_output, const fs::path& library) {
    const fs::path new_file = library.parent_path() / ("." + library.filename().string() + ".new");
    std::error_code error, ignored;
    if (fs::copy_file(cmake_output, new_file, fs::copy_options::overwrite_existing, error))
        fs::rename(new_file, library, error);
    if (!error) return;
    fs::remove(new_file, ignored);
    throw std::runtime_error(library.string() + " cannot be written: " + error.message());
}

} // namespace tandem::command
