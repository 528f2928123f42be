// SPDX-License-Identifier: Apache-2.0
#ifndef PORT_H_
#define PORT_H_

#include <OPRoSTypes.h>

#include <string>

class Port {
  public:
    Port();
    Port(const std::string& name, const PortType& type);
    virtual ~Port();
    virtual std::string& getName();
    virtual PortType getType();
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
