// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/skeleton.hpp"
#include "apps/tandem/text.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// It becomes the name of a class, of a library and of files.
void require_identifier(const std::string& name) {
    const auto letter = [](unsigned char c) { return c < 128 && (std::isalpha(c) || c == '_'); };
    bool good = !name.empty() && name.size() <= 100 && letter(static_cast<unsigned char>(name[0]));
    for (const unsigned char c : name) good = good && (letter(c) || (c < 128 && std::isdigit(c)));
    if (!good)
        throw std::runtime_error("'" + printable(name) +
                                 "' cannot be the name of a component, expected letters, "
                                 "digits and _ as for a C++ class, e.g. LaserFilter");
}

void write(const fs::path& file, const std::string& text) {
    std::ofstream stream(file);
    stream << text << std::flush;
    if (!stream) throw std::runtime_error(file.string() + " cannot be written: " + std::strerror(errno));
}

} // namespace

int opros_new(const std::string& name, const fs::path& parent) {
    require_identifier(name);
    const fs::path folder = parent / name;
    std::error_code error;
    if (fs::exists(folder, error))
        throw std::runtime_error(folder.string() + " exists; choose another name, or remove it first");
    if (!fs::create_directory(folder, error))
        throw std::runtime_error("folder " + folder.string() + " cannot be made: " + error.message());
    try {
        for (const auto& [file, text] : component_skeleton(name)) write(folder / file, text);
    } catch (const std::runtime_error&) {
        fs::remove_all(folder, error); // half a component is of no use
        throw;
    }
    const std::string shown = folder.lexically_normal().string();
    print_text(fmt::format("{0}: component {1}, its profile, and an application of it. Next:\n"
                           "  tandem opros build {0}\n"
                           "  opros_host {0}/{1}App.xml\n",
                           shown, name));
    return 0;
}

} // namespace tandem::command
