// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_PROPERTY_H_
#define DEVICE_PROPERTY_H_

#include <ArchiveFactory.h>
#include <ReturnType.h>

#include <map>
#include <string>

using namespace std; // components rely on it

namespace opros {
namespace detail {
/// Notes, for a message, that a component or device has asked for a property that it does not have (ours).
void note_absent_property(const std::string& name);
} // namespace detail
} // namespace opros

/// Named values for a device or a component.
class Property {
  public:
    Property() {}
    virtual ~Property() {}
    Property(const Property&) = default;
    Property& operator=(const Property&) = default;

    void SetProperty(std::map<std::string, std::string> values) { data.swap(values); }
    std::map<std::string, std::string> GetProperty() { return data; }
    void SetValue(std::string name, std::string value) { data[name] = value; }
    std::string GetValue(std::string name) {
        FindName(name);
        return data[name];
    }
    bool FindName(std::string name) {
        if (data.count(name) != 0) return true;
        opros::detail::note_absent_property(name);
        return false;
    }

    void save(opros::archive::oarchive& ar, const unsigned int) { ar << data; }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> data; }

  protected:
    friend class opros::archive::access;
    std::map<std::string, std::string> data;
};

inline std::string typeName(Property*) { return "Property"; }

namespace OPRoS {

/// The form for components of OPRoS v2, with the status of the call that produced it.
class Property : public ::Property {
  public:
    Property() : status(OPROS_SUCCESS) {}
    ReturnType status;

    void save(opros::archive::oarchive& ar, const unsigned int) { ar << data << status; }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> data >> status; }
};

inline std::string typeName(Property*) { return "Property"; }

} // namespace OPRoS

#endif
