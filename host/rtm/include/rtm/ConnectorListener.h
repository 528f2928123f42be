// SPDX-License-Identifier: Apache-2.0
// Callbacks of data connectors: types of events, base classes, and the table of a port's listeners.
#ifndef RTC_CONNECTORLISTENER_H
#define RTC_CONNECTORLISTENER_H
#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <rtm/ByteData.h>
#include <rtm/CORBA_CdrMemoryStream.h>
#include <rtm/ConnectorBase.h>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

namespace RTC {

/// What a listener has changed. Results of several listeners are combined with |.
class ConnectorListenerStatus {
  public:
    enum Enum {
        NO_CHANGE = 0,
        INFO_CHANGED = 1 << 0,
        DATA_CHANGED = 1 << 1,
        BOTH_CHANGED = INFO_CHANGED | DATA_CHANGED
    };
};
inline ConnectorListenerStatus::Enum operator|(ConnectorListenerStatus::Enum a,
                                               ConnectorListenerStatus::Enum b) {
    return static_cast<ConnectorListenerStatus::Enum>(static_cast<int>(a) | static_cast<int>(b));
}
inline ConnectorListenerStatus::Enum operator&(ConnectorListenerStatus::Enum a,
                                               ConnectorListenerStatus::Enum b) {
    return static_cast<ConnectorListenerStatus::Enum>(static_cast<int>(a) & static_cast<int>(b));
}

#define USE_CONNLISTENER_STATUS                                                                              \
    using ReturnCode = ::RTC::ConnectorListenerStatus::Enum;                                                 \
    using ::RTC::ConnectorListenerStatus::NO_CHANGE;                                                         \
    using ::RTC::ConnectorListenerStatus::INFO_CHANGED;                                                      \
    using ::RTC::ConnectorListenerStatus::DATA_CHANGED;                                                      \
    using ::RTC::ConnectorListenerStatus::BOTH_CHANGED

/// Events with a message.
enum class ConnectorDataListenerType : std::uint8_t {
    ON_BUFFER_WRITE = 0,
    ON_BUFFER_FULL,
    ON_BUFFER_WRITE_TIMEOUT,
    ON_BUFFER_OVERWRITE,
    ON_BUFFER_READ,
    ON_SEND,
    ON_RECEIVED,
    ON_RECEIVER_FULL,
    ON_RECEIVER_TIMEOUT,
    ON_RECEIVER_ERROR,
    CONNECTOR_DATA_LISTENER_NUM
};
/// Events without a message.
enum class ConnectorListenerType : std::uint8_t {
    ON_BUFFER_EMPTY = 0,
    ON_BUFFER_READ_TIMEOUT,
    ON_SENDER_EMPTY,
    ON_SENDER_TIMEOUT,
    ON_SENDER_ERROR,
    ON_CONNECT,
    ON_DISCONNECT,
    CONNECTOR_LISTENER_NUM
};

// The unscoped names that components for 1.x use.
constexpr auto ON_BUFFER_WRITE = ConnectorDataListenerType::ON_BUFFER_WRITE;
constexpr auto ON_BUFFER_FULL = ConnectorDataListenerType::ON_BUFFER_FULL;
constexpr auto ON_BUFFER_WRITE_TIMEOUT = ConnectorDataListenerType::ON_BUFFER_WRITE_TIMEOUT;
constexpr auto ON_BUFFER_OVERWRITE = ConnectorDataListenerType::ON_BUFFER_OVERWRITE;
constexpr auto ON_BUFFER_READ = ConnectorDataListenerType::ON_BUFFER_READ;
constexpr auto ON_SEND = ConnectorDataListenerType::ON_SEND;
constexpr auto ON_RECEIVED = ConnectorDataListenerType::ON_RECEIVED;
constexpr auto ON_RECEIVER_FULL = ConnectorDataListenerType::ON_RECEIVER_FULL;
constexpr auto ON_RECEIVER_TIMEOUT = ConnectorDataListenerType::ON_RECEIVER_TIMEOUT;
constexpr auto ON_RECEIVER_ERROR = ConnectorDataListenerType::ON_RECEIVER_ERROR;
constexpr auto ON_BUFFER_EMPTY = ConnectorListenerType::ON_BUFFER_EMPTY;
constexpr auto ON_BUFFER_READ_TIMEOUT = ConnectorListenerType::ON_BUFFER_READ_TIMEOUT;
constexpr auto ON_SENDER_EMPTY = ConnectorListenerType::ON_SENDER_EMPTY;
constexpr auto ON_SENDER_TIMEOUT = ConnectorListenerType::ON_SENDER_TIMEOUT;
constexpr auto ON_SENDER_ERROR = ConnectorListenerType::ON_SENDER_ERROR;
constexpr auto ON_CONNECT = ConnectorListenerType::ON_CONNECT;
constexpr auto ON_DISCONNECT = ConnectorListenerType::ON_DISCONNECT;
constexpr auto CONNECTOR_DATA_LISTENER_NUM = ConnectorDataListenerType::CONNECTOR_DATA_LISTENER_NUM;
constexpr auto CONNECTOR_LISTENER_NUM = ConnectorListenerType::CONNECTOR_LISTENER_NUM;

/// A listener to messages as bytes. It runs in the thread that causes the event: the writer's, the reader's or, for a
/// message of another process, a thread of the ORB or of the message's connection. Override one form: of 2.x
/// (ByteData), of 1.2 (a stream) or of 1.0 (const arguments, no result). If it returns DATA_CHANGED, the changed
/// bytes are passed on.
class ConnectorDataListener : public ConnectorListenerStatus {
  public:
    USE_CONNLISTENER_STATUS;
    static const char* toString(ConnectorDataListenerType type);
    virtual ~ConnectorDataListener();
    virtual ReturnCode operator()(ConnectorInfo& info, ByteData& data, const std::string& marshalingtype);
    virtual ReturnCode operator()(ConnectorInfo& info, cdrMemoryStream& data);
    virtual void operator()(const ConnectorInfo& info, const cdrMemoryStream& data);
    /// Ours, for messages that are not serialized: returns true if notifyValue() accepts values of this type.
    virtual bool takesValues(const std::type_info& type) const;
    virtual ReturnCode notifyValue(ConnectorInfo& info, void* value);
};

/// A listener to messages as values of one type. Does not report messages of other types.
template <class DataType>
class ConnectorDataListenerT : public ConnectorDataListener {
  public:
    USE_CONNLISTENER_STATUS;
    ~ConnectorDataListenerT() override { SerializerFactory::instance().deleteObject(m_cdr); }

    virtual ReturnCode operator()(ConnectorInfo& info, DataType& data) {
        static_cast<ConnectorDataListenerT&> (*this)(static_cast<const ConnectorInfo&>(info),
                                                     static_cast<const DataType&>(data));
        return NO_CHANGE;
    }
    virtual void operator()(const ConnectorInfo& /*info*/, const DataType& /*data*/) {}

    ReturnCode operator()(ConnectorInfo& info, ByteData& bytes, const std::string& marshalingtype) override {
        auto* stream = serializer(marshalingtype);
        if (stream == nullptr) return NO_CHANGE;
        DataType data = DataType();
        if (!m_is_standard_cdr || !detail::decode_timed_numbers(bytes, data)) {
            stream->isLittleEndian(bytes.getEndian());
            stream->writeData(bytes.getBuffer(), bytes.getDataLength());
            if (!stream->deserialize(data)) return NO_CHANGE;
        }
        ReturnCode result = (*this)(info, data);
        if (result & DATA_CHANGED) {
            stream->isLittleEndian(bytes.getEndian());
            stream->serialize(data);
            bytes.setDataLength(stream->getDataLength());
            stream->readData(bytes.getBuffer(), bytes.getDataLength());
        }
        return result;
    }
    bool takesValues(const std::type_info& type) const override { return type == typeid(DataType); }
    ReturnCode notifyValue(ConnectorInfo& info, void* value) override {
        return (*this)(info, *static_cast<DataType*>(value));
    }
    ReturnCode operator()(ConnectorInfo&, cdrMemoryStream&) override { return NO_CHANGE; }
    void operator()(const ConnectorInfo&, const cdrMemoryStream&) override {}

  private:
    ByteDataStream<DataType>* serializer(const std::string& marshalingtype) {
        if (m_cdr == nullptr || m_marshalingtype != marshalingtype) {
            SerializerFactory::instance().deleteObject(m_cdr);
            CdrMemoryStreamInit<DataType>();
            m_cdr = createSerializer<DataType>(marshalingtype);
            m_stream = dynamic_cast<ByteDataStream<DataType>*>(m_cdr);
            m_is_standard_cdr = m_cdr != nullptr && typeid(*m_cdr) == typeid(CORBA_CdrSerializer<DataType>);
            m_marshalingtype = marshalingtype;
        }
        return m_stream;
    }

    ByteDataStreamBase* m_cdr = nullptr;
    ByteDataStream<DataType>* m_stream = nullptr; // m_cdr, if it serializes this type
    bool m_is_standard_cdr = false;               // it only does what CDR requires
    std::string m_marshalingtype;
};

/// A listener to events without a message.
class ConnectorListener : public ConnectorListenerStatus {
  public:
    USE_CONNLISTENER_STATUS;
    static const char* toString(ConnectorListenerType type);
    virtual ~ConnectorListener();
    virtual ReturnCode operator()(ConnectorInfo& info);
    virtual void operator()(const ConnectorInfo& info);
};

/// The listeners of a port. Without listeners, notify() costs one atomic load. [any-thread]
class ConnectorListeners {
  public:
    ConnectorListeners() = default;
    ~ConnectorListeners();
    ConnectorListeners(const ConnectorListeners&) = delete;
    ConnectorListeners& operator=(const ConnectorListeners&) = delete;

    /// Adds a listener. With `autoclean`, removeListener() or the destructor deletes it. Returns false if the
    /// listener is NULL or the type is invalid.
    bool addListener(ConnectorDataListenerType type, ConnectorDataListener* listener, bool autoclean = true);
    bool addListener(ConnectorListenerType type, ConnectorListener* listener, bool autoclean = true);
    bool removeListener(ConnectorDataListenerType type, ConnectorDataListener* listener);
    bool removeListener(ConnectorListenerType type, ConnectorListener* listener);

    bool has(ConnectorDataListenerType type) const {
        return data_[index(type)].count.load(std::memory_order_acquire) != 0;
    }
    bool has(ConnectorListenerType type) const {
        return info_[index(type)].count.load(std::memory_order_acquire) != 0;
    }

    /// Returns true if there is a listener to any event with a message.
    bool hasDataListener() const { return data_listeners_.load(std::memory_order_acquire) != 0; }

    ConnectorListenerStatus::Enum notify(ConnectorDataListenerType type, ConnectorInfo& info, ByteData& data,
                                         const std::string& marshalingtype) {
        return has(type) ? call(type, info, data, marshalingtype) : ConnectorListenerStatus::NO_CHANGE;
    }
    /// Ours: returns true if every listener to messages accepts values of this type, so that their bytes are not
    /// needed.
    bool allTakeValues(const std::type_info& type);
    /// Ours: like notify(), for a message that is not serialized. Requires allTakeValues(). Listeners may change the
    /// value.
    ConnectorListenerStatus::Enum notifyValue(ConnectorDataListenerType type, ConnectorInfo& info,
                                              void* value) {
        return has(type) ? callWithValue(type, info, value) : ConnectorListenerStatus::NO_CHANGE;
    }
    /// For transports of libraries: uses the marshaling type of the receiving (In) or the sending end (Out).
    ConnectorListenerStatus::Enum notifyIn(ConnectorDataListenerType type, ConnectorInfo& info,
                                           ByteData& data) {
        return has(type) ? call(type, info, data, marshalingType(info, "inport"))
                         : ConnectorListenerStatus::NO_CHANGE;
    }
    ConnectorListenerStatus::Enum notifyOut(ConnectorDataListenerType type, ConnectorInfo& info,
                                            ByteData& data) {
        return has(type) ? call(type, info, data, marshalingType(info, "outport"))
                         : ConnectorListenerStatus::NO_CHANGE;
    }
    ConnectorListenerStatus::Enum notify(ConnectorListenerType type, ConnectorInfo& info) {
        return has(type) ? call(type, info) : ConnectorListenerStatus::NO_CHANGE;
    }

  private:
    static std::string marshalingType(const ConnectorInfo& info, const std::string& end);
    template <class Type>
    static std::size_t index(Type type) {
        return static_cast<std::size_t>(type);
    }
    /// The listeners to one type of event, each with its autoclean flag. `count` is their number and can be read
    /// without the mutex.
    template <class Listener>
    struct Holder {
        std::recursive_mutex mutex;
        std::vector<std::pair<Listener*, bool>> listeners;
        std::atomic<std::size_t> count{0};
        ~Holder();
        void add(Listener* listener, bool autoclean);
        bool remove(Listener* listener);
        template <class Call>
        ConnectorListenerStatus::Enum notify(const Call& call);
    };
    ConnectorListenerStatus::Enum call(ConnectorDataListenerType, ConnectorInfo&, ByteData&,
                                       const std::string&);
    ConnectorListenerStatus::Enum call(ConnectorListenerType, ConnectorInfo&);
    ConnectorListenerStatus::Enum callWithValue(ConnectorDataListenerType, ConnectorInfo&, void* value);

    static constexpr auto DataKinds =
        static_cast<std::size_t>(ConnectorDataListenerType::CONNECTOR_DATA_LISTENER_NUM);
    static constexpr auto InfoKinds = static_cast<std::size_t>(ConnectorListenerType::CONNECTOR_LISTENER_NUM);
    std::atomic<std::size_t> data_listeners_{0}; // number of listeners in data_; each message reads it
    std::array<Holder<ConnectorDataListener>, DataKinds> data_;
    std::array<Holder<ConnectorListener>, InfoKinds> info_;
};
using ConnectorListenersBase = ConnectorListeners;

} // namespace RTC
#endif
