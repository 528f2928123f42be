// SPDX-License-Identifier: Apache-2.0
// Events are not synchronized: each receiver gets its own copy (Event::clone()).
#include <Event.h>

Event::Event() : m_id("event") {}
Event::~Event() = default;

std::string& Event::getId() { return m_id; }
const std::string& Event::getId() const { return m_id; }
void Event::setId(const std::string& strid) { m_id = strid; }
std::string& Event::getTopic() { return m_topic; }
const std::string& Event::getTopic() const { return m_topic; }
void Event::setTopic(const std::string& topic) { m_topic = topic; }
std::string& Event::getComponentId() { return m_componentId; }
const std::string& Event::getComponentId() const { return m_componentId; }
void Event::setComponentId(const std::string& strid) { m_componentId = strid; }
std::string& Event::getPortId() { return m_portId; }
const std::string& Event::getPortId() const { return m_portId; }
void Event::setPortId(const std::string& strid) { m_portId = strid; }
opros_any& Event::getContent() { return m_content; }
const opros_any& Event::getContent() const { return m_content; }

ReturnType Event::setContent(opros_any& con) {
    if (!checkContentType(con)) return OPROS_BAD_INPUT_PARAMETER;
    m_content = con;
    return OPROS_SUCCESS;
}
