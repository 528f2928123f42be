// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/new_folder.hpp"
#include "apps/tandem/text.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
    std::ofstream stream(file);
    stream << text << std::flush;
    if (!stream) throw std::runtime_error(file.string() + " cannot be written: " + std::strerror(errno));
}

} // namespace

void require_identifier(const std::string& name) {
    const auto letter = [](unsigned char c) { return c < 128 && (std::isalpha(c) || c == '_'); };
    bool good = !name.empty() && name.size() <= 100 && letter(static_cast<unsigned char>(name[0]));
    for (const unsigned char c : name) good = good && (letter(c) || (c < 128 && std::isdigit(c)));
    if (!good)
        throw std::runtime_error("'" + printable(name) +
                                 "' cannot be the name of a component, expected letters, "
                                 "digits and _ as for a C++ class, e.g. LaserFilter");
}

void write_new_folder(const fs::path& folder, const FilesWithText& files) {
    std::error_code error;
    if (fs::exists(folder, error))
        throw std::runtime_error(folder.string() + " exists; choose another name, or remove it first");
    if (!fs::create_directory(folder, error))
        throw std::runtime_error("folder " + folder.string() + " cannot be made: " + error.message());
    try {
        for (const auto& [file, text] : files) write(folder / file, text);
    } catch (const std::runtime_error&) {
        fs::remove_all(folder, error); // half a component is of no use
        throw;
    }
}

std::string named(std::string text, const std::string& name) {
    const std::string mark = "@NAME@";
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += name.size())
        text.replace(at, mark.size(), name);
    return text;
}

} // namespace tandem::command
