// SPDX-License-Identifier: Apache-2.0
#ifndef REQUIREDMETHODINTERFACE_H_
#define REQUIREDMETHODINTERFACE_H_

#include <Method.h>
#include <ServicePortConnector.h>

/// A method that can be connected without knowing its C++ type. Not while the component calls it. [main-thread]
class RequiredMethodInterface : public Method {
  public:
    RequiredMethodInterface() {}
    explicit RequiredMethodInterface(const std::string& name) : Method(name) {}
    virtual ReturnType Disconnect() = 0;
    /// Connects to a provided method. Returns OPROS_BAD_INPUT_PARAMETER if its types differ from those of this
    /// method.
    virtual ReturnType Connect(Method* peer) = 0;
    /// Connects to a connector, which must outlive the connection.
    virtual ReturnType Connect(ServicePortConnector* peer) = 0;
};

#endif
