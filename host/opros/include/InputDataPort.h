// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTDATAPORT_H_
#define INPUTDATAPORT_H_

#include <InputDataPortInterface.h>

#include <typeinfo>

/// The input data port of a component: a member, added with addPort(), from whose queue the component takes values in
/// its cycle. Without a policy and a limit it is a FIFO of 15, which a profile may replace.
template <typename dataType>
class InputDataPort : public InputDataPortInterface {
  public:
    InputDataPort() {}
    InputDataPort(DataPortPolicy data_policy, unsigned int queue_limit)
        : InputDataPortInterface(data_policy, queue_limit) {}
    InputDataPort(const std::string& name) : InputDataPortInterface(name) {}
    InputDataPort(const std::string& name, DataPortPolicy data_policy, unsigned int queue_limit)
        : InputDataPortInterface(name, data_policy, queue_limit) {}

    /// The value within an opros_any that pop() or peek() has given. NULL when it is of another type.
    dataType* getContentPointer(opros_any& data) { return ANY_CASTING(dataType, &data); }
    /// Throws std::bad_cast when the data are of another type.
    dataType getContent(opros_any& data) {
        dataType* content = ANY_CASTING(dataType, &data);
        if (!content) throw std::bad_cast();
        return *content;
    }

    virtual ReturnType push(opros_any& data) { return push_data(data); }
    /// [any-thread] Puts a copy of the value into the queue.
    virtual ReturnType push(dataType& data) {
        opros_any_view::of<dataType> view(data);
        return push(static_cast<opros_any&>(view));
    }
    /// Decodes a value into the queue. OPROS_UNSUPPORTED_METHOD: the type cannot be archived. Throws what the
    /// archive throws.
    virtual ReturnType push(opros::archive::iarchive& in) {
        opros_any value = sample();
        if (!value.serializable()) return OPROS_UNSUPPORTED_METHOD;
        value.decode(in);
        return push(value);
    }
    virtual ReturnType pushData(unsigned char* data, int size) {
        if (!m_arc) return OPROS_UNSUPPORTED_METHOD;
        std::stringstream bytes(
            std::string(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)));
        opros::archive::iarchive* archive = m_arc->getInputArchive(&bytes);
        const ReturnType result = push(*archive);
        m_arc->release(archive);
        return result;
    }
    virtual bool checkType(opros_any& data) { return data.holds<dataType>(); }
    virtual bool checkType(DataPort* dst) {
        opros_any value = sample();
        return dst->checkType(value);
    }
    virtual opros_any sample() const { return opros_any(dataType()); }
};

#endif
