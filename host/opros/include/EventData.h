// SPDX-License-Identifier: Apache-2.0
#ifndef EVENTDATA_H_
#define EVENTDATA_H_

#include <Event.h>

#include <cstring>
#include <ostream>

/// An event with a content of one type. Typed event ports send such events.
template <typename dataType>
class EventData : public Event {
  public:
    virtual bool checkContentType(opros_any& data) { return data.holds<dataType>(); }
    /// Returns the content, or NULL if none has been set.
    virtual dataType* getContentData() { return ANY_CASTING(dataType, &m_content); }
    virtual const dataType* getContentData() const { return ANY_CASTING(dataType, &m_content); }
    /// Copies the content.
    virtual ReturnType setContentData(const dataType& data) {
        opros_any content = data;
        return setContent(content);
    }
    virtual Event* clone() { return new EventData<dataType>(*this); }

    friend std::ostream& operator<<(std::ostream& os, const EventData<dataType>& event) {
        return os << "[eventid:" << event.getId() << ",topic:" << event.getTopic()
                  << ",componentid:" << event.getComponentId() << ",portid:" << event.getPortId() << "]";
    }
};

// On an archive, an event is its four names, a flag for the content, and the content.
template <class T, typename = opros::archive::if_serializable<T>>
void save_this(opros::archive::oarchive& ar, EventData<T>& t) {
    ar << t.getId() << t.getTopic() << t.getComponentId() << t.getPortId();
    const T* content = t.getContentData();
    ar << (content != 0);
    if (content) ar << *content;
}
template <class T, typename = opros::archive::if_serializable<T>>
void load_this(opros::archive::iarchive& ar, EventData<T>& t) {
    ar >> t.getId() >> t.getTopic() >> t.getComponentId() >> t.getPortId();
    bool has_content = false;
    ar >> has_content;
    if (!has_content) return;
    T content = T();
    ar >> content;
    t.setContentData(content);
}
template <class T>
std::string typeName(EventData<T>*) {
    return "EventData<" + getTypeName<T>() + ">";
}

#endif
