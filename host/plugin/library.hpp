// SPDX-License-Identifier: Apache-2.0
// Shared libraries as both hosts load them: all symbols resolved at once, none exported to later libraries.
#pragma once

#include "host/plugin/error.hpp"
#include "host/plugin/library_contents.hpp"

#include <boost/dll/shared_library.hpp>
#include <filesystem>
#include <memory>
#include <string>

namespace tandem::plugin {

class Library {
  public:
    /// Loads the file, after a look at what is in it; what an instance needs, keeps it: see own().
    /// [any-thread] Throws Error: those of read_contents(), or load_failed with the dynamic linker's reason.
    static std::shared_ptr<Library> load(const std::filesystem::path& file);

    /// Whether the file is loaded in this process, by whomever.
    static bool is_loaded(const std::filesystem::path& file);

    bool has(const std::string& name) const { return library_.has(name); }

    /// The exported function or variable of type F. Throws Error that names symbol and file.
    template <class F>
    F* symbol(const std::string& name) {
        require_symbol(name);
        return &library_.get<F>(name);
    }

    const std::filesystem::path& path() const noexcept { return path_; }
    const LibraryContents& contents() const noexcept { return contents_; }

  private:
    explicit Library(const std::filesystem::path& file);
    void require_symbol(const std::string& name) const;

    std::filesystem::path path_;
    LibraryContents contents_;
    boost::dll::shared_library library_;
};

/// An instance made by the library: `release` ends it, and the library stays loaded until after that.
template <class T, class Release>
std::shared_ptr<T> share_instance(std::shared_ptr<Library> library, T* instance, Release release) {
    return std::shared_ptr<T>(instance,
                              [library = std::move(library), release](T* dying) { release(dying); });
}

} // namespace tandem::plugin
