// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTDATAPORT_H_
#define OUTPUTDATAPORT_H_

#include <EncodedPush.h>
#include <OutputDataPortInterface.h>

#include <memory>

/// An output data port: a member of the component, added with addPort(). push() delivers a copy to each connected input
/// port before it returns, and never waits for a consumer. [any-thread] push
template <typename dataType>
class OutputDataPort : public OutputDataPortInterface {
  public:
    OutputDataPort() {}
    OutputDataPort(const std::string& name) : OutputDataPortInterface(name) {}

    virtual ReturnType push(opros_any& data) { return push_data(data); }
    /// Sends the value, which remains the caller's. It is copied only into the receivers' queues.
    virtual ReturnType push(const dataType& data) { return deliver(data, true); }
    /// Decodes a value and sends it. Returns OPROS_UNSUPPORTED_METHOD if the type cannot be archived. Exceptions of the
    /// archive pass through.
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
    virtual void rehearsePush() {
        if (!m_sample) m_sample.reset(new dataType());
        deliver(*m_sample, false);
    }

  private:
    // By push(), which a derived port may override, or, in a rehearsal, directly.
    ReturnType deliver(const dataType& data, bool by_push) {
        opros_any_view::of<dataType> view(data);
        return by_push ? push(static_cast<opros_any&>(view)) : OutputDataPortInterface::push_data(view);
    }

    std::unique_ptr<dataType> m_sample; // for rehearsePush()
};

#endif
