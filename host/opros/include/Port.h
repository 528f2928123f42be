// SPDX-License-Identifier: Apache-2.0
#ifndef PORT_H_
#define PORT_H_

#include <OPRoSTypes.h>

#include <string>

/// Base class of all ports. Profiles use the name given to addPort(), not getName().
class Port {
  public:
    Port();
    Port(const std::string& name, const PortType& type);
    virtual ~Port();
    virtual std::string& getName();
    virtual PortType getType();
    /// Drops the stored values. Called when the component stops.
    virtual void reset() = 0;

    /// Returns a default-constructed value of the port's data type, or an empty one if the port has no known type
    /// (ours).
    virtual opros_any sample() const;
    /// Returns why checkType() has just returned false, if the port knows more than the type's name (ours).
    virtual std::string typeError() const;

  protected:
    std::string m_name;
    PortType m_type;
};

#endif
