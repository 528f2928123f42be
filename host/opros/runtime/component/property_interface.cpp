// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/component/absent_property.hpp"

#include <device/Property.h>

#include <atomic>
#include <utility>

namespace {

std::atomic<AbsentPropertyHandler> absent_property_handler{nullptr};
thread_local std::string absent_property;

} // namespace

void set_absent_property_handler(AbsentPropertyHandler handler) { absent_property_handler = handler; }

void opros::detail::note_absent_property(const std::string& name) { absent_property = name; }
std::string take_absent_property() { return std::exchange(absent_property, {}); }

PropertyInterface::PropertyInterface() = default;
PropertyInterface::~PropertyInterface() = default;
void PropertyInterface::setProperty(const std::string& name, const std::string& value) {
    m_properties[name] = value;
}
// Returns a reference even for an absent name, as in upstream's interface: to a member that is emptied each time, in
// case a component has written to it. Two threads must not ask for absent properties at the same time.
std::string& PropertyInterface::getProperty(const std::string& name) {
    const auto found = m_properties.find(name);
    if (found != m_properties.end()) return found->second;
    opros::detail::note_absent_property(name);
    if (const AbsentPropertyHandler handler = absent_property_handler) handler(*this, name);
    m_absent.clear();
    return m_absent;
}
std::map<std::string, std::string>& PropertyInterface::getPropertyMap() { return m_properties; }
