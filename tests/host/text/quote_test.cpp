// SPDX-License-Identifier: Apache-2.0
// Quoted text is read back unchanged by the program that it is written for.
#include "host/text/quote.hpp"

#include "host/process/run_command.hpp"
#include "host/text/printable.hpp"
#include "tests/support/nasty_names.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace tandem::text;
using tandem::test::nasty_names;

namespace {

namespace fs = std::filesystem;

/// A temporary folder in which commands of the names would leave their file.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "tandem-quote-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const fs::path& path() const { return path_; }
    bool was_attacked() const { return fs::exists(path_ / "marker"); }
    std::string output(const std::vector<std::string>& command, const std::string& input = "") const {
        const auto result = tandem::process::run_command(command, {.input = input, .folder = path_.string()});
        INFO(result.errors);
        REQUIRE(result.succeeded());
        return result.output;
    }

  private:
    fs::path path_;
};

} // namespace

TEST_CASE("a shell reads a quoted word as one unchanged word") {
    const Folder folder;
    for (const auto& name : nasty_names())
        CHECK(folder.output({"sh", "-c", "printf '<%s>' " + quote_shell(name)}) == "<" + name + ">");
    CHECK_FALSE(folder.was_attacked());
    CHECK(quote_shell("/a-b/c.d") == "/a-b/c.d");
    CHECK(quote_shell("") == "''");
}

TEST_CASE("CMake reads a quoted argument unchanged and expands nothing in it") {
    const Folder folder;
    std::string script;
    std::vector<std::string> names = nasty_names();
    // CMake reads a carriage return before a newline as part of the newline.
    std::erase_if(names, [](const auto& name) { return name.find('\r') != std::string::npos; });
    for (const char* end : {"a]", "a]=", "]=]", "a]==", "\n"}) names.emplace_back(end);
    for (std::size_t i = 0; i < names.size(); ++i)
        script += "file(WRITE " + std::to_string(i) + ".txt " + quote_cmake(names[i]) + ")\n";
    std::ofstream(folder.path() / "names.cmake") << script;
    folder.output({"cmake", "-P", "names.cmake"});
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::ifstream file(folder.path() / (std::to_string(i) + ".txt"));
        CHECK(std::string(std::istreambuf_iterator<char>(file), {}) == names[i]);
    }
    CHECK_FALSE(folder.was_attacked());
}

TEST_CASE("a string of gnuplot has no character that ends it or starts a command") {
    CHECK(quote_gnuplot("it's") == R"("it's")");
    CHECK(quote_gnuplot("`a` @b $c \"d\" \\") == R"("\140a\140 @b $c \042d\042 \134")");
    CHECK(quote_gnuplot("a\n!b") == R"("a?!b")");
}

TEST_CASE("gnuplot prints a quoted string unchanged") {
    const Folder folder;
    if (tandem::process::run_command({"sh", "-c", "command -v gnuplot"}).exit_code() != 0) return;
    std::string script = "set print \"-\"\n", expected;
    for (const auto& name : nasty_names()) {
        script += "print " + quote_gnuplot(name) + "\n";
        expected += printable_line(name) + "\n";
    }
    CHECK(folder.output({"gnuplot", "-"}, script) == expected);
    CHECK_FALSE(folder.was_attacked());
}

TEST_CASE("an identifier of Graphviz has escaped quotes and backslashes") {
    CHECK(quote_dot("say \"a\"") == R"("say \"a\"")");
    CHECK(quote_dot("a\\") == R"("a\\")");
    CHECK(quote_dot("\\\"") == R"("\\\"")");
    CHECK(quote_dot("a\nb\x1b") == R"("a?b?")");
}

TEST_CASE("printable text has no control characters and only valid UTF-8") {
    for (const auto& name : nasty_names()) {
        const std::string line = printable_line(name);
        CHECK(line.find_first_of("\x1b\n\r\t\x7f\x01\x07") == std::string::npos);
        CHECK(line.find("\xc2\x9b") == std::string::npos);
        CHECK(printable_line(line) == line);
    }
    CHECK(printable_line("a\x1b[31mb\n") == "a?[31mb?");
    CHECK(printable_line("é 日本 😀") == "é 日本 😀");
    CHECK(printable_line("\xc2\x9bx") == "?x");
    CHECK(printable_line("\x9bx\xe3\x81") == "?x??");
    CHECK(printable_line("\xed\xa0\x80") == "???");
    CHECK(printable_line("\xc0\xaf") == "??");
    CHECK(printable_line(std::string_view("a\0b", 3)) == "a?b");
    CHECK(printable_text("a\tb\n\x1b") == "a\tb\n?");
}
