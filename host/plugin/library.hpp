// SPDX-License-Identifier: Apache-2.0
// Loads shared libraries as both hosts need them. All symbols are resolved at once (RTLD_NOW), so that a missing one
// is found now and not later during the run. No symbol is visible to libraries loaded later (RTLD_LOCAL), so that two
// components may define the same names.
#pragma once

#include "host/plugin/error.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace boost::dll {
class shared_library;
}

namespace tandem::plugin {

/// What to do with a library that calls functions which no library defines.
enum class UndefinedFunctions {
    refuse,
    accept, ///< as OpenRTM-aist (RTLD_LAZY): the process ends with exit code 127 when one of them is called
};

/// A loaded library. It is unloaded with the last pointer to it or to an instance from share_instance().
class Library {
  public:
    ~Library();

    /// Checks the file, then loads it. Throws the errors of read_elf(), or Error load_failed with the dynamic
    /// linker's reason. [any-thread]
    static std::shared_ptr<Library> load(const std::filesystem::path& file, UndefinedFunctions undefined);
    static std::shared_ptr<Library> load(const std::filesystem::path& file);

    /// Returns true if any code has loaded the file in this process. [any-thread]
    static bool is_loaded(const std::filesystem::path& file);

    bool has(const std::string& name) const;

    /// Returns the exported function or variable. Does not check its type F. Throws Error missing_symbol.
    template <class F>
    F* symbol(const std::string& name) {
        return reinterpret_cast<F*>(address(name));
    }

    const std::filesystem::path& path() const noexcept { return path_; }

    /// Returns the dynamic linker's line about the first undefined function of an accepted library; "" if there is none.
    const std::string& undefined() const noexcept { return undefined_; }

  private:
    Library(const std::filesystem::path& file, UndefinedFunctions undefined);
    void* address(const std::string& name) const;

    std::filesystem::path path_;
    // a pointer, because the header takes a second to compile
    std::unique_ptr<boost::dll::shared_library> library_;
    std::string undefined_;
};

/// Wraps an instance that the library has created. The last owner calls `release`. Only then is the library unloaded,
/// because it contains the destructor's code.
template <class T, class Release>
std::shared_ptr<T> share_instance(std::shared_ptr<Library> library, T* instance, Release release) {
    return std::shared_ptr<T>(instance,
                              [library = std::move(library), release](T* dying) { release(dying); });
}

} // namespace tandem::plugin
