// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORT_H
#define RTC_INPORT_H
#include <algorithm>
#include <memory>
#include <rtm/InPortBase.h>
#include <rtm/PortCallback.h>
#include <string>
#include <vector>

namespace RTC {

/// A data port that receives values of one IDL struct into a variable of its component. Registers the type's CDR
/// serializer. All functions: [owner's thread], which is the only thread that uses the variable.
template <class DataType>
class InPort : public InPortBase {
  public:
    InPort(const char* name, DataType& value)
        : InPortBase(name, CORBA_Util::toRepositoryId<DataType>()), m_name(name), m_value(value) {
        CdrMemoryStreamInit<DataType>();
        addProperty("dataport.marshaling_types",
                    coil::eraseBlank(coil::flatten(getSerializerList<DataType>())).c_str());
    }
    /// The form of 1.x. Its further arguments configured a buffer of the port and have no effect here.
    InPort(const char* name, DataType& value, int /*bufsize*/, bool /*read_block*/ = false,
           bool /*write_block*/ = false, int /*read_timeout*/ = 0, int /*write_timeout*/ = 0)
        : InPort(name, value) {}

    virtual const char* name() { return m_name.c_str(); }

    /// Returns true if a connector has an unread value. With `name`: only this connector. With `names`: stores the
    /// names of all such connectors.
    bool isNew() override { return InPortBase::isNew(); }
    virtual bool isNew(std::string name) {
        const std::unique_lock<DataMutex> lock(m_dataMutex);
        auto* connector = findReadableLocked(name, false);
        return connector != nullptr;
    }
    virtual bool isNew(coil::vstring& names) { return selectConnectorNames(names, true); }
    bool isEmpty() override { return InPortBase::isEmpty(); }
    /// Returns the opposite of isNew(), in the same forms.
    virtual bool isEmpty(std::string name) { return !isNew(name); }
    virtual bool isEmpty(coil::vstring& names) { return selectConnectorNames(names, false); }

    /// Reads the oldest value into the variable. If the buffer is empty, its policy decides (default readback: the
    /// last value again, returns true). Returns false, with the reason in getStatus(), if the port is not connected,
    /// no value has ever arrived, or the message is not of this type. The variable may then be partly overwritten.
    bool read() {
        if (m_OnRead != nullptr) (*m_OnRead)();
        return ((hasFastPath() && readInPlace()) || readConnector(nullptr)) && convertRead();
    }
    /// Reads like read(), from the connector of this name. An empty name means read().
    bool read(std::string name) override {
        if (name.empty()) return read();
        if (m_OnRead != nullptr) (*m_OnRead)();
        return readConnector(&name) && convertRead();
    }
    virtual void update() { read(); }
    void operator>>(DataType& rhs) {
        read();
        rhs = m_value;
    }

    /// Returns the status of the last read(). An InPort has one status, independent of the index.
    DataPortStatus getStatus(int /*index*/) { return m_status[0]; }
    DataPortStatusList getStatusList() { return m_status; }
    /// Function objects called before a read, and with the value read. NULL: none. The caller keeps ownership.
    void setOnRead(OnRead<DataType>* on_read) { m_OnRead = on_read; }
    void setOnReadConvert(OnReadConvert<DataType>* on_rconvert) { m_OnReadConvert = on_rconvert; }

    // Created on demand: most ports have no direct connection.
    std::shared_ptr<DirectBufferBase> directBuffer() override {
        // A pointer to the base, so that each data type does not compile its own shared_ptr.
        if (m_directBuffer == nullptr)
            m_directBuffer.reset(static_cast<DirectBufferBase*>(new DirectBuffer<DataType>()));
        return m_directBuffer;
    }
    // The message is bytes here, so setting its time decodes and encodes it. [sender's or ORB thread]
    void stampOnReceive(ByteData& bytes) override {
        CORBA_CdrSerializer<DataType> stream;
        DataType data = DataType();
        stream.isLittleEndian(bytes.getEndian());
        stream.writeData(bytes.getBuffer(), bytes.getDataLength());
        if (!stream.deserialize(data)) return;
        stampIfPossible(data, 0);
        stream.isLittleEndian(bytes.getEndian());
        stream.serialize(data);
        bytes.setDataLength(stream.getDataLength());
        stream.readData(bytes.getBuffer(), bytes.getDataLength());
    }

  protected:
    void rehearseMessage() override {
        if (!m_dataMutex.makeIfOwner(m_sample)) return;
        CdrUnmarshal<DataType> reader(*m_sample);
        readFastPath(reader);
    }

  private:
    // Returns false if the fast path does not apply.
    bool readInPlace() {
        CdrUnmarshal<DataType> reader(m_value);
        if (!readFastPath(reader)) return false;
        if (!reader.valid) m_status[0] = DataPortStatus::BUFFER_ERROR;
        return true;
    }
    // Reads from the named connector, or from any if `name` is NULL. Returns false if there is none.
    bool readConnector(const std::string* name) {
        const std::unique_lock<DataMutex> lock(m_dataMutex);
        const bool is_sole = m_connectors.size() == 1 && name == nullptr; // then no search is needed
        auto* connector = is_sole ? m_connectors.front()
                                  : findReadableLocked(name != nullptr ? *name : std::string(), true);
        if (connector == nullptr) return false;
        m_status[0] = connector->read(m_value);
        if (is_sole && connector->readsInPlace()) findFastPath();
        return true;
    }
    bool convertRead() {
        if (m_status[0] != DataPortStatus::PORT_OK) return false;
        if (m_OnReadConvert != nullptr) m_value = (*m_OnReadConvert)(m_value);
        return true;
    }
    bool selectConnectorNames(coil::vstring& names, bool has_data) {
        names.clear();
        const std::unique_lock<DataMutex> lock(m_dataMutex);
        for (auto* connector : m_connectors)
            if ((connector->readableCount() > 0) == has_data) names.push_back(connector->name());
        return !names.empty();
    }

    std::string m_name;
    DataType& m_value;
    OnRead<DataType>* m_OnRead = nullptr;
    OnReadConvert<DataType>* m_OnReadConvert = nullptr;
    std::unique_ptr<DataType> m_sample; // for rehearse()
    // Shared by all direct connections, like m_thebuffer by the others.
    std::shared_ptr<DirectBufferBase> m_directBuffer;
};

} // namespace RTC

// As in OpenRTM-aist: components use the manager without including its header. Last, because it needs the
// declarations above.
#include <rtm/Manager.h>
#endif
