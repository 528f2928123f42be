// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/library.hpp"

#include "host/plugin/library_contents.hpp"

#include <algorithm>
#include <boost/dll/shared_library.hpp>
#include <dlfcn.h>

namespace tandem::plugin {
namespace {

namespace fs = std::filesystem;

// Boost.DLL's own error only says that loading failed. dlerror() names the missing symbol or file.
std::string dlerror_text() {
    const char* message = dlerror();
    std::string text = message ? message : "the dynamic linker gives no reason";
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

// glibc's dlopen() ends the process if a static constructor throws. The sanitizers' dlopen() passes the exception on,
// and this function catches it.
void load_library(boost::dll::shared_library& library, const fs::path& file, boost::dll::load_mode::type mode,
                  boost::dll::fs::error_code& refused) {
    std::string thrown;
    try {
        library.load(file, refused, mode | boost::dll::load_mode::rtld_local);
    } catch (const std::exception& error) {
        thrown = std::string(": ") + error.what();
    } catch (...) {
        thrown = " of unknown type";
    }
    if (!thrown.empty())
        throw Error(Reason::load_failed,
                    "library " + file.string() + " threw an exception in its static constructors" + thrown);
}

} // namespace

Library::Library(const fs::path& file, UndefinedFunctions undefined)
    : path_(fs::absolute(file)), library_(std::make_unique<boost::dll::shared_library>()) {
    read_contents(path_); // throws for a damaged file, because loading one could end the process
    boost::dll::fs::error_code refused;
    load_library(*library_, path_, boost::dll::load_mode::rtld_now, refused);
    if (!refused) return;
    std::string reason = dlerror_text();
    if (undefined == UndefinedFunctions::accept && reason.find("undefined symbol: ") != std::string::npos) {
        refused.clear();
        load_library(*library_, path_, boost::dll::load_mode::rtld_lazy, refused);
        if (refused) reason = dlerror_text(); // another symbol is missing, which is needed at once
    }
    if (refused)
        throw Error(Reason::load_failed, "library " + path_.string() + " cannot be loaded: " + reason);
    undefined_ = reason;
}

Library::~Library() = default;

std::shared_ptr<Library> Library::load(const fs::path& file, UndefinedFunctions undefined) {
    return std::shared_ptr<Library>(new Library(file, undefined));
}

std::shared_ptr<Library> Library::load(const fs::path& file) {
    return load(file, UndefinedFunctions::refuse);
}

bool Library::is_loaded(const fs::path& file) {
    void* const handle = dlopen(fs::absolute(file).c_str(), RTLD_LAZY | RTLD_NOLOAD);
    if (handle) dlclose(handle);
    return handle != nullptr;
}

bool Library::has(const std::string& name) const { return library_->has(name); }

void* Library::address(const std::string& name) const {
    if (!has(name))
        throw Error(Reason::missing_symbol, "library " + path_.string() + " does not export " + name);
    return &library_->get<char>(name);
}

} // namespace tandem::plugin
