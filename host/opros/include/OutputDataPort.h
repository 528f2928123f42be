// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTDATAPORT_H_
#define OUTPUTDATAPORT_H_

#include <OutputDataPortInterface.h>

/// The output data port of a component: a member, added with addPort(). [any-thread] push() delivers a copy to each
/// connected input port before it returns, and never waits for a consumer.
template <typename dataType>
class OutputDataPort : public OutputDataPortInterface {
  public:
    OutputDataPort() {}
    OutputDataPort(const std::string& name) : OutputDataPortInterface(name) {}

    virtual ReturnType push(opros_any& data) { return push_data(data); }
    /// The value stays the caller's; no copy is made on the way to the receivers' queues.
    virtual ReturnType push(const dataType& data) {
        opros_any_view::of<dataType> view(data);
        return push(static_cast<opros_any&>(view));
    }
    /// Decodes a value and sends it. OPROS_UNSUPPORTED_METHOD: the type cannot be archived. Throws what the archive
    /// throws.
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

  protected:
    virtual ReturnType marshal(opros_any& data, std::string& outdata) {
        if (!m_arc || !data.serializable()) return OPROS_UNSUPPORTED_METHOD;
        std::stringstream bytes;
        opros::archive::oarchive* archive = m_arc->getOutputArchive(&bytes);
        data.encode(*archive);
        m_arc->release(archive);
        outdata = bytes.str();
        return OPROS_SUCCESS;
    }
};

#endif
