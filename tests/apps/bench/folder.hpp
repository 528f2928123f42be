// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>

namespace tandem::bench::test {

/// A folder that lives as long as this object.
struct Folder {
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "bench-test-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string file(const char* name) const { return (path / name).string(); }
    std::filesystem::path path;
};

} // namespace tandem::bench::test
