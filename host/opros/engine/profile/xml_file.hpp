// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/profile.hpp"

#include <initializer_list>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::engine {

/// No profile is larger: those of real components have 1 to 10 KB.
constexpr std::size_t max_profile_bytes = 1 << 20;

/// An element as messages name it: "<name>".
std::string tag(const char* name);

/// An XML file with its line numbers, in any encoding that it declares. Every complaint is a SetupError with
/// the place.
class XmlFile {
  public:
    explicit XmlFile(const std::filesystem::path& file);
    /// The bytes of a file, as they lie in it.
    XmlFile(const std::filesystem::path& file, std::string_view bytes);

    /// The root element, which must have one of these names.
    pugi::xml_node root(std::initializer_list<const char*> names) const;
    pugi::xml_node root() const { return document_.document_element(); }
    SourceLocation location(const pugi::xml_node& node) const;
    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const;

    /// Profiles come from Windows: its backslashes separate folders.
    static std::string to_posix_path(std::string text);
    static std::string trim(std::string_view text);
    /// A word that a profile chooses from a few: trimmed, in lower case.
    static std::string keyword(std::string_view text);
    /// Text of the child element, trimmed; empty when there is none.
    static std::string child_text(const pugi::xml_node& node, const char* child);
    std::string required_child_text(const pugi::xml_node& node, const char* child) const;
    std::string required_attribute(const pugi::xml_node& node, const char* name) const;
    /// The element's number, or the default when it is absent or empty. Finite.
    double number(const pugi::xml_node& element, double default_value) const;
    double number(const pugi::xml_node& node, const char* child, double default_value) const {
        return number(node.child(child), default_value);
    }

  private:
    int line_at(std::ptrdiff_t offset) const;
    void reject_entities() const;

    std::filesystem::path file_;
    std::string text_;
    std::vector<std::size_t> newline_offsets_;
    pugi::xml_document document_;
};

} // namespace tandem::engine
