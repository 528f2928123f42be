// SPDX-License-Identifier: Apache-2.0
#ifndef PROPERTYINTERFACE_H_
#define PROPERTYINTERFACE_H_

#include <ReturnType.h>

#include <map>
#include <string>

/// A component's properties, as its profile gives them: all are strings.
class PropertyInterface {
  public:
    PropertyInterface();
    virtual ~PropertyInterface();
    virtual void setProperty(const std::string& name, const std::string& value);
    /// The property's value; an empty string when there is none of this name.
    virtual std::string& getProperty(const std::string& name);
    virtual std::map<std::string, std::string>& getPropertyMap();

  private:
    std::map<std::string, std::string> m_properties;
    std::string m_absent;
};

#endif
