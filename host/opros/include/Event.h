// SPDX-License-Identifier: Apache-2.0
#ifndef EVENT_H_
#define EVENT_H_

#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <string>

/// An event: an id, the names of its sender, and a content of any type (EventData: of one type). The sender may
/// delete its event once push() has returned, since each receiver gets a clone. Not thread-safe.
class Event {
  public:
    Event();
    virtual ~Event();
    /// Returns the kind of event, which the sender chooses. The default is "event".
    virtual std::string& getId();
    virtual const std::string& getId() const;
    virtual void setId(const std::string& strid);
    /// Returns the topic, for event sources outside OPRoS. Ports of this host ignore it.
    virtual std::string& getTopic();
    virtual const std::string& getTopic() const;
    virtual void setTopic(const std::string& topic);
    /// Return the names of the sending component and port, if the sender has set them.
    virtual std::string& getComponentId();
    virtual const std::string& getComponentId() const;
    virtual void setComponentId(const std::string& strid);
    virtual std::string& getPortId();
    virtual const std::string& getPortId() const;
    virtual void setPortId(const std::string& strid);
    virtual opros_any& getContent();
    virtual const opros_any& getContent() const;
    /// Copies the content. Returns OPROS_BAD_INPUT_PARAMETER if it is not of the event's content type.
    virtual ReturnType setContent(opros_any& con);
    virtual bool checkContentType(opros_any& con) = 0;
    /// Returns a copy, which the caller deletes.
    virtual Event* clone() = 0;

  protected:
    std::string m_id, m_topic, m_componentId, m_portId;
    opros_any m_content;
};

#endif
