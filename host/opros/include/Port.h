// SPDX-License-Identifier: Apache-2.0
#ifndef PORT_H_
#define PORT_H_

#include <OPRoSTypes.h>

#include <string>

/// What all ports have in common. The name that counts in profiles is the one given to addPort(), not getName().
class Port {
  public:
    Port();
    Port(const std::string& name, const PortType& type);
    virtual ~Port();
    virtual std::string& getName();
    virtual PortType getType();
    /// Drops what the port has stored. Called when the component stops.
    virtual void reset() = 0;

    /// A default-constructed value of the port's data type; empty when it has none or does not know (ours).
    virtual opros_any sample() const;
    /// Why checkType() has just said no, when the port has more to say than its type's name (ours).
    virtual std::string typeError() const;

  protected:
    std::string m_name;
    PortType m_type;
};

#endif
