// SPDX-License-Identifier: Apache-2.0
// Port and the three base classes of ports: everything independent of a port's direction and data type.
#include <DataPort.h>
#include <EventPort.h>
#include <ServicePort.h>

Port::Port() : m_type(OPROS_DATA) {}
Port::Port(const std::string& name, const PortType& type) : m_name(name), m_type(type) {}
Port::~Port() = default;
std::string& Port::getName() { return m_name; }
PortType Port::getType() { return m_type; }
// Defaults of Tandem's additions: a port without a data type and without its own reason for a refusal.
opros_any Port::sample() const { return opros_any(); }
std::string Port::typeError() const { return ""; }

DataPort::DataPort() : Port("", OPROS_DATA) {}
DataPort::DataPort(const std::string& name) : Port(name, OPROS_DATA) {}
DataPort::~DataPort() = default;

EventPort::EventPort() : Port("", OPROS_EVENT) {}
EventPort::EventPort(const std::string& name) : Port(name, OPROS_EVENT) {}
EventPort::~EventPort() = default;

ServicePort::ServicePort() : Port("", OPROS_SERVICE) {}
ServicePort::ServicePort(const std::string& name) : Port(name, OPROS_SERVICE) {}
ServicePort::~ServicePort() = default;
