// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OUTPORT_H
#define RTC_OUTPORT_H
#include <coil/OS.h>
#include <coil/TimeMeasure.h>
#include <functional>
#include <memory>
#include <rtm/OutPortBase.h>
#include <rtm/PortCallback.h>
#include <string>
#include <vector>

namespace RTC {

/// A data port that sends values of one IDL struct. Registers the type's CDR serializer. All functions: [owner's
/// thread].
template <class DataType>
class OutPort : public OutPortBase {
  public:
    OutPort(const char* name, DataType& value)
        : OutPortBase(name, CORBA_Util::toRepositoryId<DataType>()), m_name(name), m_value(value) {
        CdrMemoryStreamInit<DataType>();
        addProperty("dataport.marshaling_types",
                    coil::eraseBlank(coil::flatten(getSerializerList<DataType>())).c_str());
    }
    /// The form of 1.x. Its length configured a buffer of the port and has no effect here.
    OutPort(const char* name, DataType& value, int /*length*/) : OutPort(name, value) {}

    virtual const char* name() { return m_name.c_str(); }

    /// Sends the value to every connector, and serializes it once for all connectors that send the same bytes.
    /// Returns true if all have accepted it; false, with getStatus(), if one has not or there is none. Ends
    /// connections whose receiver is gone. May block for each connector, depending on its buffer's policy and
    /// `put_timeout`.
    virtual bool write(DataType& value) {
        if (m_onWrite != nullptr) (*m_onWrite)(value);
        if (m_onWriteConvert == nullptr) return hasFastPath() ? sendFastPath(value) : send(value);
        DataType converted = (*m_onWriteConvert)(value);
        return send(converted);
    }
    bool write() override { return write(m_value); }
    bool operator<<(DataType& value) { return write(value); }

    /// Returns the status of the last write() by the connector's position. Throws std::out_of_range.
    DataPortStatus getStatus(int index) { return m_status.at(static_cast<std::size_t>(index)); }
    DataPortStatusList getStatusList() { return m_status; }
    /// Function objects called before a write, and to replace the value. NULL: none. The caller keeps ownership.
    void setOnWrite(OnWrite<DataType>* on_write) { m_onWrite = on_write; }
    void setOnWriteConvert(OnWriteConvert<DataType>* on_wconvert) { m_onWriteConvert = on_wconvert; }

  protected:
    void rehearseMessage() override {
        if (!m_dataMutex.makeIfOwner(m_sample)) return;
        if (hasFastPath())
            sendFastPath(*m_sample);
        else
            rehearseWrite(CdrMarshal<DataType>(*m_sample));
    }

  private:
    bool sendFastPath(DataType& value) {
        const FastPath result = writeFastPath(CdrMarshal<DataType>(value));
        return result == FastPath::none ? send(value) : result == FastPath::accepted;
    }

    bool send(DataType& value) {
        std::unique_lock<DataMutex> lock(m_dataMutex);
        if (m_connectors.size() != 1 || m_status.size() != 1) {
            lock.unlock();
            return sendToAll(value);
        }
        m_status[0] = m_connectors.front()->write(value);
        if (m_connectors.front()->writesInPlace()) findFastPath();
        if (m_status[0] != DataPortStatus::CONNECTION_LOST) return m_status[0] == DataPortStatus::PORT_OK;
        const std::vector<std::string> lost{m_connectors.front()->id()};
        lock.unlock();
        dropLostConnections(lost);
        return false;
    }

    bool sendToAll(DataType& value) {
        std::vector<std::string> lost;
        bool all_accepted = true;
        {
            const std::unique_lock<DataMutex> lock(m_dataMutex);
            if (m_connectors.empty()) return false;
            m_status.resize(m_connectors.size());
            // Numbers are copied into each receiver's buffer as fast as their bytes. A long value is not copied twice.
            const bool in_place = m_connectors.size() == 1 || isLong(value) ||
                                  CdrMarshal<DataType>(value).numbers().tm != nullptr;
            OutPortConnector* encoded = nullptr; // the last connector that has serialized the value
            for (std::size_t i = 0; i < m_connectors.size(); ++i) {
                OutPortConnector* connector = m_connectors[i];
                if (encoded != nullptr && connector->canShareBytesOf(*encoded)) {
                    m_status[i] = connector->write(encoded->serializedBytes());
                } else {
                    m_status[i] = connector->write(value, in_place);
                    if (connector->hasSerialized() && m_status[i] != DataPortStatus::PORT_ERROR)
                        encoded = connector;
                }
                if (m_status[i] != DataPortStatus::PORT_OK) all_accepted = false;
                if (m_status[i] == DataPortStatus::CONNECTION_LOST) lost.push_back(connector->id());
            }
        }
        // Without the mutex, because disconnecting locks it.
        if (!lost.empty()) dropLostConnections(lost);
        return all_accepted;
    }

    std::string m_name;
    DataType& m_value;
    OnWrite<DataType>* m_onWrite = nullptr;
    OnWriteConvert<DataType>* m_onWriteConvert = nullptr;
    std::unique_ptr<DataType> m_sample; // for rehearse()
};

} // namespace RTC

// As in OpenRTM-aist: components use the manager without including its header. Last, because it needs the
// declarations above.
#include <rtm/Manager.h>
#endif
