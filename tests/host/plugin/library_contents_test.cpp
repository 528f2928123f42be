// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/abi.hpp"

#include "host/plugin/error.hpp"
#include "host/plugin/library.hpp"
#include "tests/support/stress.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <dlfcn.h>
#include <elf.h>
#include <fstream>
#include <iterator>
#include <random>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using tandem::plugin::Error;
using tandem::plugin::LibraryKind;
using tandem::plugin::read_contents;
using tandem::plugin::Reason;

namespace {

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A file of these bytes, for one test.
struct File {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("tandem_contents_" + std::to_string(getpid()) + ".so");
    explicit File(const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }
    ~File() { std::filesystem::remove(path); }
};

/// The bytes that this process has read from files so far.
long bytes_read() {
    std::ifstream io("/proc/self/io");
    std::string name;
    long bytes = 0;
    io >> name >> bytes; // rchar
    return bytes;
}

struct Refusal {
    Reason reason;
    std::string text;
};

Refusal refusal(const std::filesystem::path& file) {
    try {
        read_contents(file);
    } catch (const Error& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        return {error.reason(), error.what()};
    }
    throw std::logic_error(file.string() + " was taken");
}

Refusal refusal_of_bytes(const std::string& bytes) { return refusal(File(bytes).path); }

bool mapped(const std::string& file) {
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (handle) dlclose(handle);
    return handle != nullptr;
}

} // namespace

TEST_CASE("a library's component model is found without mapping the library") {
    CHECK(read_contents(OPROS_PLUGIN).kind == LibraryKind::opros_component);
    const auto module = read_contents(RTM_PLUGIN);
    CHECK(module.kind == LibraryKind::rtc_module);
    CHECK(module.entry == "HWCompInit");
    CHECK(read_contents(ZOO "/opros/device_api.so").kind == LibraryKind::device_api);
    CHECK(read_contents(ZOO "/opros/no_entry.so").kind == LibraryKind::other);
    CHECK(read_contents(GOOD_LIBRARY).exports.count("answer") == 1);
    CHECK_FALSE(mapped(OPROS_PLUGIN));
    CHECK_FALSE(mapped(RTM_PLUGIN));
}

TEST_CASE("only the plugins of the proxy say that they need no probe") {
    const auto beside = [](const char* plugin, const char* name) {
        return std::filesystem::path(plugin).parent_path() / name;
    };
    CHECK(read_contents(beside(OPROS_PLUGIN, "AdaptorComp.so")).trusted);
    CHECK(read_contents(beside(RTM_PLUGIN, "InterceptorComp.so")).trusted);
    CHECK_FALSE(read_contents(OPROS_PLUGIN).trusted);
    CHECK_FALSE(read_contents(RTM_PLUGIN).trusted);
}

TEST_CASE("the ABI number of the headers that a library was built against is found") {
    const std::set<std::uint32_t> none;
    const auto component = read_contents(OPROS_PLUGIN), module = read_contents(RTM_PLUGIN);
    CHECK(component.opros.abi_numbers.size() == 1); // of several object files
    CHECK(component.opros.used);
    CHECK(component.rtm.abi_numbers == none);
    CHECK(module.rtm.abi_numbers.size() == 1);
    CHECK(module.rtm.used);
    CHECK(module.opros.abi_numbers == none);
    CHECK(read_contents(ZOO "/opros/another_tandem.so").opros.abi_numbers == std::set<std::uint32_t>{999999});
    CHECK(read_contents(ZOO "/opros/another_tandem_in_part.so").opros.abi_numbers.size() == 2);
    const auto before = read_contents(ZOO "/rtm/before_the_numbers.so");
    CHECK(before.rtm.abi_numbers == none);
    CHECK(before.rtm.used);
    CHECK_FALSE(read_contents(GOOD_LIBRARY).opros.used);
}

TEST_CASE("a library with the expected ABI number is accepted, and one without any if it does not use the "
          "headers") {
    const auto require = [](const char* file, std::uint32_t expected) {
        tandem::plugin::require_abi(file, read_contents(file), tandem::plugin::ComponentModel::opros,
                                    expected);
    };
    const std::uint32_t number = *read_contents(OPROS_PLUGIN).opros.abi_numbers.begin();
    CHECK_NOTHROW(require(OPROS_PLUGIN, number));
    CHECK_THROWS_WITH(require(OPROS_PLUGIN, number + 1),
                      Catch::Contains("against the headers of another Tandem"));
    CHECK_NOTHROW(require(ZOO "/opros/entry_throws.so", number)); // a factory of whatever makes
    CHECK_NOTHROW(require(RTM_PLUGIN, number));                   // that model's affair
}

TEST_CASE("a library of the wrong model is refused, and the error names its model and the program for it") {
    const auto require = [](const char* file, LibraryKind kind) {
        tandem::plugin::require_kind(file, read_contents(file), kind);
    };
    CHECK_NOTHROW(require(OPROS_PLUGIN, LibraryKind::opros_component));
    CHECK_THROWS_WITH(require(RTM_PLUGIN, LibraryKind::opros_component),
                      Catch::Contains("is an RTC module (exports HWCompInit), expected an OPRoS component") &&
                          Catch::Contains("rtm_host runs it"));
    CHECK_THROWS_WITH(require(OPROS_PLUGIN, LibraryKind::rtc_module),
                      Catch::Contains("is an OPRoS component (exports getComponent)") &&
                          Catch::Contains("opros_host runs it"));
    CHECK_THROWS_WITH(require(ZOO "/opros/device_api.so", LibraryKind::opros_component),
                      Catch::Contains("a device API"));
    CHECK_THROWS_WITH(require(ZOO "/opros/no_entry.so", LibraryKind::opros_component),
                      Catch::Contains("neither"));
}

TEST_CASE("a file that is not a library for this machine is refused, with the specific reason") {
    CHECK(refusal("/nowhere/X.so").reason == Reason::not_found);
    CHECK(refusal("/tmp").reason == Reason::not_found);
    CHECK(refusal("/dev/zero").reason == Reason::not_found);
    CHECK(refusal_of_bytes("").reason == Reason::damaged);
    CHECK(refusal_of_bytes("int main() {}\n").reason == Reason::not_a_library);
    CHECK_THAT(refusal_of_bytes("MZ and so on").text, Catch::Contains("Windows"));
    std::string bytes = bytes_of(GOOD_LIBRARY);
    const auto with = [&](std::size_t at, char value) {
        std::string changed = bytes;
        changed.at(at) = value;
        return refusal_of_bytes(changed);
    };
    CHECK(with(offsetof(Elf64_Ehdr, e_type), ET_REL).reason == Reason::not_a_library);
    CHECK(with(offsetof(Elf64_Ehdr, e_type), ET_EXEC).reason == Reason::not_a_library);
    const auto foreign =
        with(offsetof(Elf64_Ehdr, e_machine), static_cast<char>(EM_AARCH64 == 183 ? 183 : 0));
    CHECK(foreign.reason == Reason::wrong_architecture);
    CHECK_THAT(foreign.text, Catch::Contains("64-bit ARM"));
}

TEST_CASE("a named pipe in place of a library is refused without waiting for a writer") {
    const auto path =
        std::filesystem::temp_directory_path() / ("tandem_pipe_" + std::to_string(getpid()) + ".so");
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    CHECK(refusal(path).reason == Reason::not_found);
    std::filesystem::remove(path);
}

TEST_CASE("a library cut off anywhere is refused as damaged or was whole enough to be mapped") {
    const std::string bytes = bytes_of(OPROS_PLUGIN);
    REQUIRE(bytes.size() > 4096);
    std::size_t refused = 0;
    const std::size_t steps = 200;
    for (std::size_t i = 1; i < steps; ++i) {
        const File cut(bytes.substr(0, bytes.size() * i / steps));
        try {
            read_contents(cut.path);
        } catch (const Error& error) {
            CHECK((error.reason() == Reason::damaged || error.reason() == Reason::not_a_library));
            ++refused;
        }
    }
    CHECK(refused == steps - 1); // the section headers are at the end of the file
}

TEST_CASE("random damage to a library ends in an answer or an Error and nothing else") {
    const std::string bytes = bytes_of(OPROS_PLUGIN);
    const int rounds = tandem::test::stress(500);
    std::mt19937 random(4);
    int refused = 0;
    for (int round = 0; round < rounds; ++round) {
        std::string damaged = bytes;
        const std::size_t region = round % 2 ? 1024 : bytes.size(); // half of it in the headers
        for (int i = 0; i < 8; ++i) damaged[random() % region] = static_cast<char>(random());
        const File file(damaged);
        try {
            read_contents(file.path);
        } catch (const Error&) {
            ++refused;
        }
    }
    CHECK(refused > rounds / 10);
}

TEST_CASE("a library's symbols are read once, even if it is then loaded, and again after it has changed") {
    using tandem::plugin::Library;
    using namespace std::chrono_literals;
    const File file(bytes_of(GOOD_LIBRARY));
    std::this_thread::sleep_for(1100ms); // a file that has just changed may change again with the same time
    const auto cost = [&](const auto& action) {
        const long before = bytes_read();
        action();
        return bytes_read() - before;
    };
    const long first = cost([&] { CHECK(read_contents(file.path).exports.contains("answer")); });
    const long idle = cost([] {});
    const long second = cost([&] { CHECK(read_contents(file.path).exports.contains("answer")); });
    const long loading = cost([&] { Library::load(file.path); }); // the dynamic linker reads a header
    CHECK(second < idle + 100);
    CHECK(loading < first);
    std::ofstream(file.path, std::ios::binary) << "no library";
    CHECK(refusal(file.path).reason == Reason::not_a_library);
}
