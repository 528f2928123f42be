// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/find_library.hpp"

#include "host/plugin/error.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <unistd.h>

namespace fs = std::filesystem;
using tandem::plugin::find_library;

namespace {
struct LibraryFolder {
    fs::path path = fs::temp_directory_path() / ("tandem_find_" + std::to_string(getpid()));
    LibraryFolder() { fs::create_directories(path); }
    ~LibraryFolder() { fs::remove_all(path); }
    void add(const std::string& name) const { std::ofstream(path / name) << ""; }
};
} // namespace

TEST_CASE("a library is found under every name that profiles use for it") {
    const std::string name = GENERATE("Hello", "Hello.dll", "Hello.DLL", "Hello.so", "Hello.dll.so");
    const std::string present = GENERATE("Hello.so", "libHello.so", "libHello.dll.so");
    LibraryFolder folder;
    folder.add(present);
    CHECK(find_library(name, {folder.path}) == folder.path / present);
}

TEST_CASE("a library name with its prefix is found as it is") {
    LibraryFolder folder;
    folder.add("libHello.so");
    CHECK(find_library("libHello.so", {"/nowhere", folder.path}) == folder.path / "libHello.so");
    CHECK(find_library((folder.path / "libHello.so").string(), {}) == folder.path / "libHello.so");
}

TEST_CASE("a library that is not found is an error of one line with the names and folders tried") {
    CHECK_THROWS_WITH(find_library("Hello.dll", {"/first", "/second"}),
                      Catch::Contains("Hello.dll") && Catch::Contains("libHello.so") &&
                          Catch::Contains("/first, /second"));
    CHECK_THROWS_AS(find_library("", {"/tmp"}), tandem::plugin::Error);
    CHECK_THROWS_WITH(find_library("X.so", {"/a", "", "/a", ""}), Catch::EndsWith(" in /a, ."));
    CHECK_THROWS_WITH(find_library("/a/X.so", {"/a", "/b"}),
                      Catch::EndsWith(": looked for /a/X.so, /a/libX.so, /a/libX.dll.so, /a/X.dll.so"));
}
