// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/write_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace tandem::command {

void write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file);
    stream << text << std::flush; // only the flush detects a full disk
    if (!stream) throw std::runtime_error(file.string() + " cannot be written: " + std::strerror(errno));
}

} // namespace tandem::command
