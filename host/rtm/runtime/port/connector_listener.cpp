// SPDX-License-Identifier: Apache-2.0
// Listeners of data connectors: names, conversions between their three forms, and the table of a port.
#include <algorithm>
#include <rtm/ConnectorListener.h>
#include <rtm/Timestamp.h>

namespace RTC {

const char* ConnectorDataListener::toString(ConnectorDataListenerType type) {
    static const char* const names[] = {"ON_BUFFER_WRITE",     "ON_BUFFER_FULL",   "ON_BUFFER_WRITE_TIMEOUT",
                                        "ON_BUFFER_OVERWRITE", "ON_BUFFER_READ",   "ON_SEND",
                                        "ON_RECEIVED",         "ON_RECEIVER_FULL", "ON_RECEIVER_TIMEOUT",
                                        "ON_RECEIVER_ERROR"};
    return type < ConnectorDataListenerType::CONNECTOR_DATA_LISTENER_NUM ? names[static_cast<int>(type)] : "";
}

const char* ConnectorListener::toString(ConnectorListenerType type) {
    static const char* const names[] = {"ON_BUFFER_EMPTY",   "ON_BUFFER_READ_TIMEOUT", "ON_SENDER_EMPTY",
                                        "ON_SENDER_TIMEOUT", "ON_SENDER_ERROR",        "ON_CONNECT",
                                        "ON_DISCONNECT"};
    return type < ConnectorListenerType::CONNECTOR_LISTENER_NUM ? names[static_cast<int>(type)] : "";
}

ConnectorDataListener::~ConnectorDataListener() = default;
// The default of each form calls the next older one (2.x bytes, 1.2 stream, 1.0 const stream), so that a
// listener written for any version overrides just its own.
ConnectorDataListener::ReturnCode ConnectorDataListener::operator()(ConnectorInfo& info, ByteData& data,
                                                                    const std::string&) {
    cdrMemoryStream stream;
    stream.setByteSwapFlag(data.getEndian());
    stream.put_octet_array(data.getBuffer(), static_cast<int>(data.getDataLength()));
    const ReturnCode result = (*this)(info, stream);
    if (result & DATA_CHANGED)
        data.writeData(static_cast<const unsigned char*>(stream.bufPtr()), stream.bufSize());
    return result;
}
ConnectorDataListener::ReturnCode ConnectorDataListener::operator()(ConnectorInfo& info,
                                                                    cdrMemoryStream& data) {
    (*this)(static_cast<const ConnectorInfo&>(info), static_cast<const cdrMemoryStream&>(data));
    return NO_CHANGE;
}
void ConnectorDataListener::operator()(const ConnectorInfo&, const cdrMemoryStream&) {}
bool ConnectorDataListener::takesValues(const std::type_info&) const { return false; }
ConnectorDataListener::ReturnCode ConnectorDataListener::notifyValue(ConnectorInfo&, void*) {
    return NO_CHANGE;
}

ConnectorListener::~ConnectorListener() = default;
ConnectorListener::ReturnCode ConnectorListener::operator()(ConnectorInfo& info) {
    (*this)(static_cast<const ConnectorInfo&>(info));
    return NO_CHANGE;
}
void ConnectorListener::operator()(const ConnectorInfo&) {}

// The second of each entry is `autoclean`: the holder deletes the listener.
template <class Listener>
ConnectorListeners::Holder<Listener>::~Holder() {
    for (auto& entry : listeners)
        if (entry.second) delete entry.first;
}

// `count` follows the list, so that notify() without listeners need not lock.
template <class Listener>
void ConnectorListeners::Holder<Listener>::add(Listener* listener, bool autoclean) {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    listeners.emplace_back(listener, autoclean);
    count.store(listeners.size(), std::memory_order_release);
}

template <class Listener>
bool ConnectorListeners::Holder<Listener>::remove(Listener* listener) {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    auto found = std::find_if(listeners.begin(), listeners.end(),
                              [&](auto& entry) { return entry.first == listener; });
    if (found == listeners.end()) return false;
    if (found->second) delete found->first;
    listeners.erase(found);
    count.store(listeners.size(), std::memory_order_release);
    return true;
}

ConnectorListeners::~ConnectorListeners() = default;

// The same order as connector_properties(): this side's own word first.
std::string ConnectorListeners::marshalingType(const ConnectorInfo& info, const std::string& end) {
    return info.properties.getProperty(end + ".marshaling_type",
                                       info.properties.getProperty("marshaling_type", "cdr"));
}

bool ConnectorListeners::addListener(ConnectorDataListenerType type, ConnectorDataListener* listener,
                                     bool autoclean) {
    if (index(type) >= data_.size() || listener == nullptr) return false;
    data_[index(type)].add(listener, autoclean);
    ++data_listeners_;
    return true;
}
bool ConnectorListeners::addListener(ConnectorListenerType type, ConnectorListener* listener,
                                     bool autoclean) {
    if (index(type) >= info_.size() || listener == nullptr) return false;
    info_[index(type)].add(listener, autoclean);
    return true;
}
bool ConnectorListeners::removeListener(ConnectorDataListenerType type, ConnectorDataListener* listener) {
    if (index(type) >= data_.size() || !data_[index(type)].remove(listener)) return false;
    --data_listeners_;
    return true;
}
bool ConnectorListeners::removeListener(ConnectorListenerType type, ConnectorListener* listener) {
    return index(type) < info_.size() && info_[index(type)].remove(listener);
}

// By index, and the mutex is recursive: a running listener may add or remove others of its kind.
template <class Listener>
template <class Call>
ConnectorListenerStatus::Enum ConnectorListeners::Holder<Listener>::notify(const Call& call) {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    auto result = ConnectorListenerStatus::NO_CHANGE;
    for (std::size_t i = 0; i < listeners.size(); ++i) result = result | call(*listeners[i].first);
    return result;
}

ConnectorListenerStatus::Enum ConnectorListeners::call(ConnectorDataListenerType type, ConnectorInfo& info,
                                                       ByteData& data, const std::string& marshalingtype) {
    return data_[index(type)].notify(
        [&](ConnectorDataListener& listener) { return listener(info, data, marshalingtype); });
}

ConnectorListenerStatus::Enum ConnectorListeners::call(ConnectorListenerType type, ConnectorInfo& info) {
    return info_[index(type)].notify([&](ConnectorListener& listener) { return listener(info); });
}

ConnectorListenerStatus::Enum ConnectorListeners::callWithValue(ConnectorDataListenerType type,
                                                                ConnectorInfo& info, void* value) {
    return data_[index(type)].notify(
        [&](ConnectorDataListener& listener) { return listener.notifyValue(info, value); });
}

bool ConnectorListeners::allTakeValues(const std::type_info& type) {
    bool all = true;
    for (auto& holder : data_) {
        if (holder.count.load(std::memory_order_acquire) == 0) continue;
        holder.notify([&](ConnectorDataListener& listener) {
            all = all && listener.takesValues(type);
            return ConnectorListenerStatus::NO_CHANGE;
        });
    }
    return all;
}

TimestampPolicy timestampPolicy(const coil::Properties& properties) {
    const std::string policy = coil::normalize(properties.getProperty("timestamp_policy"));
    if (policy == "on_write") return TimestampPolicy::on_write;
    if (policy == "on_send") return TimestampPolicy::on_send;
    if (policy == "on_received") return TimestampPolicy::on_received;
    if (policy == "on_read") return TimestampPolicy::on_read;
    return TimestampPolicy::none;
}

} // namespace RTC
