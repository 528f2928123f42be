// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/packages/missing_libraries.hpp"

#include "apps/tandem/build/first_error.hpp"
#include "apps/tandem/build/packages/header_packages.hpp"
#include "apps/tandem/build/packages/installed_library.hpp"
#include "apps/tandem/build/packages/symbol_libraries.hpp"
#include "apps/tandem/output/print_note.hpp"

namespace tandem::command {

bool add_libraries(const std::string& output, MissingLibraries& libraries,
                   const std::filesystem::path& root) {
    bool added = false;
    for (const auto& symbol : undefined_symbols(output)) {
        const auto* found = find_library_of_symbol(symbol);
        if (!found) continue;
        const std::string module = found->pkg_config, name = module.empty() ? found->library : module;
        const auto package = module.empty() ? find_package_of_library(name) : find_package_of_module(name);
        if (package.empty() || installed_files(package, root).empty()) continue;
        if (!(module.empty() ? libraries.names : libraries.modules).insert(name).second) continue;
        print_note("tandem: {} is undefined; using {} of package {}\n", symbol, name, package);
        added = true;
    }
    return added;
}

} // namespace tandem::command
