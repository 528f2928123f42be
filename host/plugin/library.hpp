// SPDX-License-Identifier: Apache-2.0
// Loads shared libraries the way both hosts need it: all symbols are resolved at once (RTLD_NOW), so that a
// missing one shows now and not in mid-run, and none are visible to libraries loaded later (RTLD_LOCAL), so that
// two components may define the same names.
#pragma once

#include "host/plugin/error.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace boost::dll {
class shared_library;
}

namespace tandem::plugin {

/// A loaded library. It is unloaded when the last pointer to it, or to an instance of share_instance(), is
/// gone.
class Library {
  public:
    ~Library();

    /// Checks the file, then loads it. Throws Error: those of read_elf(), or load_failed with
    /// the dynamic linker's reason. [any-thread]
    static std::shared_ptr<Library> load(const std::filesystem::path& file);

    /// Whether the file is loaded in this process, no matter by which code. [any-thread]
    static bool is_loaded(const std::filesystem::path& file);

    bool has(const std::string& name) const;

    /// The exported function or variable of type F, which is not checked. Throws Error missing_symbol.
    template <class F>
    F* symbol(const std::string& name) {
        return reinterpret_cast<F*>(address(name));
    }

    const std::filesystem::path& path() const noexcept { return path_; }

  private:
    explicit Library(const std::filesystem::path& file);
    void* address(const std::string& name) const;

    std::filesystem::path path_;
    std::unique_ptr<boost::dll::shared_library> library_; // its header takes a second to compile
};

/// Wraps an instance that the library has made. The last owner calls `release`, and only after that is the
/// library unloaded: code of the destructor is in it.
template <class T, class Release>
std::shared_ptr<T> share_instance(std::shared_ptr<Library> library, T* instance, Release release) {
    return std::shared_ptr<T>(instance,
                              [library = std::move(library), release](T* dying) { release(dying); });
}

} // namespace tandem::plugin
