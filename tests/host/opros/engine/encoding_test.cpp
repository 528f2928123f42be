// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/opros/engine/profile/xml_file.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

using namespace tandem::engine;
using namespace std::string_literals;

namespace {

/// ASCII as UTF-16 or UTF-32.
std::string wide(const std::string& text, std::size_t bytes, bool little) {
    std::string out;
    for (const char c : text) {
        std::string unit(bytes, '\0');
        unit[little ? 0 : bytes - 1] = c;
        out += unit;
    }
    return out;
}

std::string profile(const std::string& declaration, const std::string& name = "C") {
    return declaration + "<component_profile>\n<name>" + name + "</name>\n" +
           "<execution_environment><library_name>C.dll</library_name></execution_environment>\n" +
           "<execution_semantics><type>passive</type></execution_semantics>\n</component_profile>\n";
}

std::string declaring(const std::string& encoding) {
    return "<?xml version=\"1.0\" encoding=\"" + encoding + "\"?>\n";
}

std::string name_in(const std::string& bytes) {
    const Folder folder;
    return read_component_profile(folder.write("c.xml", bytes)).name;
}

std::string error_in(const std::string& bytes) {
    const Folder folder;
    try {
        read_component_profile(folder.write("c.xml", bytes));
    } catch (const SetupError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a profile is read in the encoding that it declares") {
    CHECK(name_in(profile(declaring("EUC-KR"), "\xB7\xCE\xBA\xBF")) == "로봇");
    CHECK(name_in(profile(declaring("euc-kr"), "\x8C\xC1")) == "뙾"); // in the code page, not in the standard
    for (const char* name :
         {"ks_c_5601-1987", "KSC5601", "MS949", "windows-949", "x-windows-949", "euc_kr"}) {
        INFO(name);
        CHECK(name_in(profile(declaring(name), "\xB7\xCE\xBA\xBF")) == "로봇");
    }
    CHECK(name_in(profile(declaring("x-MS932_0213"), "C")) == "C");
    CHECK(name_in(profile(declaring("windows-1252"), "\x80")) == "€");
    CHECK(name_in(profile(declaring("Shift_JIS"), "\x83\x8D")) == "ロ");
    CHECK(name_in(profile(declaring("iso-8859-1"), "\xE9")) == "é");
    CHECK(name_in(profile(declaring("utf-8"), "é")) == "é");
}

TEST_CASE("a profile in 16 or 32 bits is read with or without a byte order mark") {
    const std::string text = profile(declaring("UTF-16"));
    CHECK(name_in("\xFF\xFE"s + wide(text, 2, true)) == "C");
    CHECK(name_in("\xFE\xFF"s + wide(text, 2, false)) == "C");
    CHECK(name_in(wide(text, 2, true)) == "C");
    CHECK(name_in(wide(text, 2, false)) == "C");
    CHECK(name_in("\xFF\xFE\0\0"s + wide(text, 4, true)) == "C");
    CHECK(name_in("\0\0\xFE\xFF"s + wide(text, 4, false)) == "C");
    CHECK(name_in("\xEF\xBB\xBF" + text) == "C");
}

TEST_CASE("a profile that declares a wrong encoding is still read") {
    CHECK(name_in(profile(declaring("euc-kr"), "é")) == "é");
    CHECK(name_in(profile(declaring("UTF-16"))) == "C");
    CHECK(name_in(profile(declaring("no-such-encoding"), "C\xFF")) == "C?");
    CHECK(name_in(profile(declaring("utf-8"), "C\xFF")) == "C?");
    CHECK(name_in(profile(declaring("utf-8"), "\xB7\xCE\xBA\xBF")) == "로봇");
    CHECK(name_in(profile("", "\xB7\xCE\xBA\xBF")) == "로봇");
    CHECK(name_in(profile(declaring("no-such-encoding"), "\xB7\xCE\xBA\xBF")) == "로봇");
    CHECK(name_in(profile(declaring("../../x"))) == "C");
}

TEST_CASE("lines are those of the file in every encoding") {
    const std::string text =
        declaring("UTF-16") + "<component_profile>\n\n<name> </name></component_profile>";
    for (const std::string& bytes : {text, "\xFF\xFE"s + wide(text, 2, true), wide(text, 4, false)})
        CHECK_THAT(error_in(bytes), Catch::Contains("c.xml:4: <component_profile> lacks its <name>"));
}

TEST_CASE("an entity bomb is refused in one line") {
    CHECK_THAT(error_in("<!DOCTYPE x [\n<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">\n]>\n" + profile("")),
               Catch::Contains("c.xml:1: the document type declares entities"));
    CHECK(name_in("<!DOCTYPE component_profile>\n" + profile("")) == "C");
}

TEST_CASE("a file that is too large for a profile is refused without being read to its end") {
    const Folder folder;
    const auto file = folder.write("c.xml", profile(""));
    std::filesystem::resize_file(file, 100'000'000);
    CHECK_THROWS_WITH(read_component_profile(file),
                      Catch::Contains("c.xml cannot be read") && Catch::Contains("more than 1048576 bytes"));
    CHECK_THROWS_WITH(read_component_profile("/dev/zero"), Catch::Contains("/dev/zero"));
}

TEST_CASE("bytes that are not text are refused in one line") {
    CHECK_THAT(error_in("<component_profile>\n\0</component_profile>"s),
               Catch::Contains("c.xml:2: not well-formed"));
    CHECK_THAT(error_in("\x01\x02\x03"), Catch::Contains("c.xml:1:"));
    CHECK_THAT(error_in(""), Catch::Contains("c.xml:1:"));
    CHECK_THAT(
        error_in("<component_profile><name>x</name><execution_environment><library_name>x</library_name>"
                 "</execution_environment><execution_semantics><type>a\nb</type></execution_semantics>"
                 "</component_profile>"),
        Catch::Contains("c.xml:1: execution type 'a b'"));
}
