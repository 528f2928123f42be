// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTDATAPORT_H_
#define INPUTDATAPORT_H_

#include <EncodedPush.h>
#include <InputDataPortInterface.h>

#include <typeinfo>

/// An input data port: a member of the component, added with addPort(). The component takes values from its queue in
/// its cycle. Without a policy and a limit, the queue is a FIFO of 15, and a profile may replace it.
template <typename dataType>
class InputDataPort : public InputDataPortInterface {
  public:
    InputDataPort() {}
    InputDataPort(DataPortPolicy data_policy, unsigned int queue_limit)
        : InputDataPortInterface(data_policy, queue_limit) {}
    InputDataPort(const std::string& name) : InputDataPortInterface(name) {}
    InputDataPort(const std::string& name, DataPortPolicy data_policy, unsigned int queue_limit)
        : InputDataPortInterface(name, data_policy, queue_limit) {}

    /// Returns the value inside an opros_any from pop() or peek(), or NULL if it is of another type.
    dataType* getContentPointer(opros_any& data) { return ANY_CASTING(dataType, &data); }
    /// Returns a copy of the value. Throws std::bad_cast if the data are of another type.
    dataType getContent(opros_any& data) {
        dataType* content = ANY_CASTING(dataType, &data);
        if (!content) throw std::bad_cast();
        return *content;
    }

    virtual ReturnType push(opros_any& data) { return push_data(data); }
    /// Puts a copy of the value into the queue. [any-thread]
    virtual ReturnType push(dataType& data) {
        opros_any_view::of<dataType> view(data);
        return push(static_cast<opros_any&>(view));
    }
    /// Decodes a value into the queue. Returns OPROS_UNSUPPORTED_METHOD if the type cannot be archived. Exceptions of
    /// the archive pass through.
    virtual ReturnType push(opros::archive::iarchive& in) { return opros::detail::push_decoded(*this, in); }
    virtual ReturnType pushData(unsigned char* data, int size) {
        return opros::detail::push_encoded(*this, m_arc, data, size);
    }
    virtual bool checkType(opros_any& data) { return data.holds<dataType>(); }
    virtual bool checkType(DataPort* dst) {
        opros_any value = sample();
        return dst->checkType(value);
    }
    virtual opros_any sample() const { return opros_any(dataType()); }
    virtual bool canRehearsePush() const { return typeid(*this) == typeid(InputDataPort); }
};

#endif
