// SPDX-License-Identifier: Apache-2.0
#ifndef EVENT_H_
#define EVENT_H_

#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <string>

/// An event and where it comes from. The id defaults to "event".
class Event {
  public:
    Event();
    virtual ~Event();
    virtual std::string& getId();
    virtual const std::string& getId() const;
    virtual void setId(const std::string& strid);
    virtual std::string& getTopic();
    virtual const std::string& getTopic() const;
    virtual void setTopic(const std::string& topic);
    virtual std::string& getComponentId();
    virtual const std::string& getComponentId() const;
    virtual void setComponentId(const std::string& strid);
    virtual std::string& getPortId();
    virtual const std::string& getPortId() const;
    virtual void setPortId(const std::string& strid);
    virtual opros_any& getContent();
    virtual const opros_any& getContent() const;
    virtual ReturnType setContent(opros_any& con);
    virtual bool checkContentType(opros_any& con) = 0;
    virtual Event* clone() = 0;

  protected:
    std::string m_id, m_topic, m_componentId, m_portId;
    opros_any m_content;
};

#endif
