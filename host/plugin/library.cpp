// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/library.hpp"

#include <algorithm>

namespace tandem::plugin {
namespace {

// Boost wraps the dynamic linker's own text, which alone says which symbol or which file is missing.
std::string linker_reason(std::string text) {
    const std::string marker = "dlerror system message: ";
    if (const auto at = text.find(marker); at != std::string::npos) text.erase(0, at + marker.size());
    if (const auto end = text.rfind("): "); end != std::string::npos) text.erase(end);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

} // namespace

Library::Library(const std::filesystem::path& file)
    : path_(std::filesystem::absolute(file)), contents_(read_contents(path_)) {
    try {
        library_.load(path_, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
    } catch (const std::exception& error) {
        throw Error(Reason::not_loadable,
                    "library " + path_.string() + " cannot be loaded: " + linker_reason(error.what()));
    }
}

std::shared_ptr<Library> Library::load(const std::filesystem::path& file) {
    return std::shared_ptr<Library>(new Library(file));
}

void Library::require(const std::string& name) const {
    if (!has(name))
        throw Error(Reason::missing_symbol, "library " + path_.string() + " does not export " + name);
}

} // namespace tandem::plugin
