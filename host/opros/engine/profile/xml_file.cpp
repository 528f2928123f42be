// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/xml_file.hpp"

#include "host/opros/engine/profile/encoding.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

namespace tandem::engine {

std::string tag(const char* name) { return std::string("<").append(name).append(">"); }

namespace {

std::string read_profile_bytes(const std::filesystem::path& file) {
    const auto fail = [&](const std::string& why) {
        throw SetupError("profile " + file.string() + " cannot be read: " + why);
    };
    // Checks the type first: opening a pipe would block, and a device may never end.
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) fail("no such file");
    if (error) fail(error.message());
    if (!std::filesystem::is_regular_file(status)) fail("it is not a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail("permission denied");
    // Reads one byte more than allowed, which detects any larger file without reading it to the end.
    std::string bytes(max_profile_bytes + 1, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > max_profile_bytes)
        fail("it has more than " + std::to_string(max_profile_bytes) + " bytes, which no profile needs");
    return bytes;
}

} // namespace

XmlFile::XmlFile(const std::filesystem::path& file) : XmlFile(file, read_profile_bytes(file)) {}

XmlFile::XmlFile(const std::filesystem::path& file, std::string_view bytes)
    : file_(file), text_(to_utf8(bytes)) {
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n') newline_offsets_.push_back(i);
    // pugixml would end the text at a zero byte and accept the part before it.
    if (const auto zero = text_.find('\0'); zero != std::string::npos)
        throw SetupError({file_, line_at(static_cast<std::ptrdiff_t>(zero))},
                         "not well-formed XML: there is a zero byte");
    const auto result = document_.load_buffer(text_.data(), text_.size(),
                                              pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
    if (!result)
        throw SetupError({file_, line_at(result.offset)},
                         std::string("not well-formed XML: ") + result.description());
    reject_entities();
}

// pugixml does not expand entities of the document type, so it would misread a file that uses them. A file with
// nested entities is an attack on parsers that do expand them.
void XmlFile::reject_entities() const {
    for (const pugi::xml_node& node : document_.children())
        if (node.type() == pugi::node_doctype &&
            std::string_view(node.value()).find("<!ENTITY") != std::string_view::npos)
            fail(node,
                 "the document type declares entities, expected plain XML; write their text in their place");
}

int XmlFile::line_at(std::ptrdiff_t offset) const {
    // pugixml returns -1 for a node without an offset.
    const auto position = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    const auto before = std::lower_bound(newline_offsets_.begin(), newline_offsets_.end(), position);
    return 1 + static_cast<int>(before - newline_offsets_.begin());
}

SourceLocation XmlFile::location(const pugi::xml_node& node) const {
    return {file_, line_at(node.offset_debug())};
}

void XmlFile::fail(const pugi::xml_node& node, const std::string& what) const {
    throw SetupError(location(node), what);
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

std::string XmlFile::to_posix_path(std::string text) {
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

std::string XmlFile::trim(std::string_view text) {
    const char* blank = " \t\r\n";
    const auto first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(blank) - first + 1));
}

std::string XmlFile::keyword(std::string_view text) {
    std::string word = trim(text);
    std::transform(word.begin(), word.end(), word.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return word;
}

std::string XmlFile::child_text(const pugi::xml_node& node, const char* child) {
    return trim(node.child(child).child_value());
}

std::string XmlFile::required_child_text(const pugi::xml_node& node, const char* child) const {
    std::string value = child_text(node, child);
    if (value.empty())
        fail(node.child(child) ? node.child(child) : node, tag(node.name()) + " lacks its " + tag(child));
    return value;
}

std::string XmlFile::required_attribute(const pugi::xml_node& node, const char* name) const {
    std::string value = trim(node.attribute(name).value());
    if (value.empty()) fail(node, tag(node.name()) + " lacks its attribute " + name);
    return value;
}

double XmlFile::number(const pugi::xml_node& element, double default_value) const {
    const std::string value = trim(element.child_value());
    if (value.empty()) return default_value;
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || !std::isfinite(number))
        fail(element, tag(element.name()) + " is '" + value + "', expected a number");
    return number;
}

} // namespace tandem::engine
