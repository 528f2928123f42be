// SPDX-License-Identifier: Apache-2.0
#ifndef PROPERTYINTERFACE_H_
#define PROPERTYINTERFACE_H_

#include <ReturnType.h>

#include <map>
#include <string>

/// A component's properties: names and values, all strings. The host sets them after the constructor and before
/// onInitialize(): those of the component profile, then those of the application, which override them. Not
/// thread-safe.
class PropertyInterface {
  public:
    PropertyInterface();
    virtual ~PropertyInterface();
    virtual void setProperty(const std::string& name, const std::string& value);
    /// The value, which may be changed through the reference; an empty string when there is none of this name.
    virtual std::string& getProperty(const std::string& name);
    virtual std::map<std::string, std::string>& getPropertyMap();

  private:
    std::map<std::string, std::string> m_properties;
    std::string m_absent;
};

#endif
