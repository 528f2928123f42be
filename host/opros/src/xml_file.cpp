// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/xml_file.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

namespace tandem::engine {
namespace {

std::string trimmed(const std::string& text) {
    const char* blank = " \t\r\n";
    const auto first = text.find_first_not_of(blank);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string read_all(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!std::filesystem::is_regular_file(file) || !stream)
        throw SetupError("profile " + file.string() + " cannot be read: no such file");
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

std::string tag(const char* name) { return std::string("<").append(name).append(">"); }

} // namespace

XmlFile::XmlFile(const std::filesystem::path& file) : file_(file), bytes_(read_all(file)) {
    // Profiles declare encodings such as euc-kr: the names that matter are ASCII, the rest is left as it is.
    const auto result =
        document_.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
        throw SetupError({file_, line_at(result.offset)},
                         std::string("not well-formed XML: ") + result.description());
}

int XmlFile::line_at(std::ptrdiff_t offset) const {
    const auto end =
        bytes_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(bytes_.size()));
    return 1 + static_cast<int>(std::count(bytes_.begin(), end, '\n'));
}

Place XmlFile::place(const pugi::xml_node& node) const { return {file_, line_at(node.offset_debug())}; }

void XmlFile::fail(const pugi::xml_node& node, const std::string& what) const {
    throw SetupError(place(node), what);
}

pugi::xml_node XmlFile::root(std::initializer_list<const char*> names) const {
    const pugi::xml_node root = document_.document_element();
    std::string expected;
    for (const char* name : names) {
        if (std::string(root.name()) == name) return root;
        expected.append(expected.empty() ? "" : " or ").append(tag(name));
    }
    fail(root, "root element is " + tag(root.name()) + ", expected " + expected);
}

std::string XmlFile::text(const pugi::xml_node& node, const char* child) {
    return trimmed(node.child(child).child_value());
}

std::string XmlFile::required_text(const pugi::xml_node& node, const char* child) const {
    std::string value = text(node, child);
    if (value.empty())
        fail(node.child(child) ? node.child(child) : node, tag(node.name()) + " lacks its " + tag(child));
    return value;
}

std::string XmlFile::required_attribute(const pugi::xml_node& node, const char* name) const {
    std::string value = trimmed(node.attribute(name).value());
    if (value.empty()) fail(node, tag(node.name()) + " lacks its attribute " + name);
    return value;
}

double XmlFile::number(const pugi::xml_node& node, const char* child, double otherwise) const {
    const std::string value = text(node, child);
    if (value.empty()) return otherwise;
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size())
        fail(node.child(child), tag(child) + " is '" + value + "', expected a number");
    return number;
}

} // namespace tandem::engine
