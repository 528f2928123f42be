// SPDX-License-Identifier: Apache-2.0
#ifndef PROPERTYINTERFACE_H_
#define PROPERTYINTERFACE_H_

#include <ReturnType.h>

#include <map>
#include <string>

/// The properties of a component: names and values, all strings. The host sets them between the constructor and
/// onInitialize(). Properties of the application override those of the component profile. Not thread-safe.
class PropertyInterface {
  public:
    PropertyInterface();
    virtual ~PropertyInterface();
    virtual void setProperty(const std::string& name, const std::string& value);
    /// Returns the value, which may be changed through the reference, or an empty string if no property has this name.
    virtual std::string& getProperty(const std::string& name);
    virtual std::map<std::string, std::string>& getPropertyMap();

  private:
    std::map<std::string, std::string> m_properties;
    std::string m_absent;
};

#endif
