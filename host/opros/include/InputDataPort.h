// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTDATAPORT_H_
#define INPUTDATAPORT_H_

#include <EncodedPush.h>
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

    [[gnu::hot]] virtual ReturnType push(opros_any& data) { return push_data(data); }
    /// [any-thread] Puts a copy of the value into the queue.
    virtual ReturnType push(dataType& data) {
        opros_any_view::of<dataType> view(data);
        return push(static_cast<opros_any&>(view));
    }
    /// Decodes a value into the queue. OPROS_UNSUPPORTED_METHOD: the type cannot be archived. Throws what the
    /// archive throws.
    virtual ReturnType push(opros::archive::iarchive& in) { return opros::detail::push_decoded(*this, in); }
    virtual ReturnType pushData(unsigned char* data, int size) {
        return opros::detail::push_encoded(*this, m_arc, data, size);
    }
    [[gnu::hot]] virtual bool checkType(opros_any& data) { return data.holds<dataType>(); }
    virtual bool checkType(DataPort* dst) {
        opros_any value = sample();
        return dst->checkType(value);
    }
    virtual opros_any sample() const { return opros_any(dataType()); }
};

#endif
