// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/library.hpp"

#include <catch2/catch.hpp>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using tandem::plugin::Error;
using tandem::plugin::Library;
using tandem::plugin::Reason;

namespace {
Reason reason_of(const std::filesystem::path& file) {
    try {
        Library::load(file);
    } catch (const Error& error) {
        return error.reason();
    }
    throw std::logic_error("it loaded");
}
bool loaded(const char* file) {
    void* handle = dlopen(file, RTLD_NOW | RTLD_NOLOAD);
    if (handle) dlclose(handle);
    return handle != nullptr;
}
} // namespace

TEST_CASE("a loaded library hands out its exported functions") {
    const auto library = Library::load(GOOD_LIBRARY);
    CHECK(library->has("answer"));
    CHECK(library->symbol<int()>("answer")() == 42);
    CHECK(library->path() == GOOD_LIBRARY);
}

TEST_CASE("a function the library lacks is named together with the library") {
    const auto library = Library::load(GOOD_LIBRARY);
    CHECK_FALSE(library->has("getComponent"));
    CHECK_THROWS_WITH(library->symbol<void()>("getComponent"),
                      Catch::Contains("getComponent") && Catch::Contains(GOOD_LIBRARY));
}

TEST_CASE("an instance keeps its library loaded") {
    auto library = Library::load(GOOD_LIBRARY);
    auto release = library->symbol<void(int*)>("release_int");
    auto instance = tandem::plugin::share_instance(library, library->symbol<int*()>("make_int")(), release);
    library.reset();
    CHECK(loaded(GOOD_LIBRARY));
    CHECK(*instance == 7);
    instance.reset();
    CHECK_FALSE(loaded(GOOD_LIBRARY));
}

TEST_CASE(
    "a missing file, a file that is not a library, and an unresolved symbol have different error messages") {
    CHECK(reason_of("/nowhere/lib.so") == Reason::not_found);
    const auto text =
        std::filesystem::temp_directory_path() / ("tandem_no_library_" + std::to_string(getpid()));
    std::ofstream(text) << "not a library";
    CHECK(reason_of(text) == Reason::not_a_library);
    std::filesystem::remove(text);
    CHECK(reason_of(UNDEFINED_LIBRARY) == Reason::load_failed);
    CHECK_THROWS_WITH(Library::load(UNDEFINED_LIBRARY), Catch::Contains("nobody_defines_this"));
}

// As OpenRTM-aist loads modules. A variable that is missing is needed at once.
TEST_CASE("a library that calls an undefined function is loaded on request, and the function is named") {
    const auto library = Library::load(UNDEFINED_LIBRARY, tandem::plugin::UndefinedFunctions::accept);
    CHECK(library->has("answer"));
    CHECK_THAT(library->undefined(),
               Catch::Contains(UNDEFINED_LIBRARY) && Catch::Contains("nobody_defines_this"));
    CHECK(Library::load(GOOD_LIBRARY, tandem::plugin::UndefinedFunctions::accept)->undefined().empty());
}
