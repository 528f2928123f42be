// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/src/profile.hpp"

#include <initializer_list>
#include <pugixml.hpp>
#include <string>

namespace tandem::engine {

/// An XML file with its line numbers. Every complaint is a SetupError with the place.
class XmlFile {
  public:
    explicit XmlFile(const std::filesystem::path& file);

    /// The root element, which must have one of these names.
    pugi::xml_node root(std::initializer_list<const char*> names) const;
    Place place(const pugi::xml_node& node) const;
    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const;

    /// Text of the child element, trimmed; empty when there is none.
    static std::string text(const pugi::xml_node& node, const char* child);
    std::string required_text(const pugi::xml_node& node, const char* child) const;
    std::string required_attribute(const pugi::xml_node& node, const char* name) const;
    /// The child's number, or the default when it is absent or empty.
    double number(const pugi::xml_node& node, const char* child, double otherwise) const;

  private:
    int line_at(std::ptrdiff_t offset) const;

    std::filesystem::path file_;
    std::string bytes_;
    pugi::xml_document document_;
};

} // namespace tandem::engine
