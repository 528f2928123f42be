// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>

namespace tandem::monitor {

struct PageFile {
    const char* type; ///< MIME
    std::string content;
};

/// The files of the page by their paths in URLs, `/app.js`; the page itself is `/`. Read once from the folder that is
/// installed beside the program. Throws std::runtime_error, one line, if one is missing.
std::map<std::string, PageFile, std::less<>> read_page_files();

} // namespace tandem::monitor
