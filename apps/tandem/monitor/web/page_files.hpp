// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>

namespace tandem::monitor {

struct PageFile {
    const char* type; ///< MIME type
    std::string content;
};

/// Reads the page's files from the installation folder. Keys are paths in URLs such as `/app.js`; the page itself is
/// `/`. Throws std::runtime_error with one line if a file is missing.
std::map<std::string, PageFile, std::less<>> read_page_files();

} // namespace tandem::monitor
