// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/shared_memory/shared_memory_endpoints.hpp"
#include "PortSharedMemorySkel.h"
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/shared_memory/shared_message.hpp"
#include <cerrno>
#include <cstring>
#include <mutex>
#include <rtm/SystemLogger.h>
#include <utility>

namespace RTC {
namespace {

/// Writes messages to an object that the other end has opened.
class SharedMessageSender {
  public:
    /// Creates an object for messages of that length, unless there is one, and makes `reader` open it. Returns false if
    /// /dev/shm refuses it. Throws CORBA::SystemException.
    bool prepare(OpenRTM::PortSharedMemory_ptr reader, unsigned long length, bool little_endian) {
        if (object_.fits(length)) return true;
        if (object_.size() != 0) reader->close_memory(false); // else OpenRTM-aist keeps the old object open
        if (!object_.create(length)) return false;
        reader->setEndian(little_endian);
        reader->open_memory(object_.size(), object_.name().c_str());
        return true;
    }
    bool write(const ByteData& bytes) { return object_.write(bytes); }
    /// Sends the next message in a new object, because the reader may still be reading this one, or has not opened it.
    void abandon() { object_.remove(); }

  private:
    SharedMessageWriter object_;
};

/// The operations that only one of the two kinds of peers calls.
class SharedMemoryServant : public POA_OpenRTM::PortSharedMemory {
  public:
    void create_memory(CORBA::ULongLong, const char*) override { throw CORBA::NO_IMPLEMENT(); }
    void open_memory(CORBA::ULongLong, const char*) override { throw CORBA::NO_IMPLEMENT(); }
    void close_memory(CORBA::Boolean) override {}
    void setInterface(OpenRTM::PortSharedMemory_ptr) override {}
    void setEndian(CORBA::Boolean) override {}
    OpenRTM::PortStatus put() override { throw CORBA::NO_IMPLEMENT(); }
    OpenRTM::PortStatus get() override { throw CORBA::NO_IMPLEMENT(); }
};

/// The receiving end's servant: opens the object that the sender names. [ORB threads]
class SharedMemoryReaderServant : public SharedMemoryServant {
  public:
    void open_memory(CORBA::ULongLong, const char* name) override {
        std::lock_guard<std::mutex> lock(mutex_);
        if (object_.open(name)) return;
        report_failure(errno);
        throw CORBA::BAD_PARAM();
    }
    void close_memory(CORBA::Boolean) override {
        std::lock_guard<std::mutex> lock(mutex_);
        object_.close();
    }
    void setEndian(CORBA::Boolean little_endian) override {
        std::lock_guard<std::mutex> lock(mutex_);
        little_endian_ = little_endian;
    }
    bool read(ByteData& bytes) {
        std::lock_guard<std::mutex> lock(mutex_);
        return object_.read(bytes, little_endian_);
    }
    void remove_name() {
        std::lock_guard<std::mutex> lock(mutex_);
        object_.remove_name();
    }

  private:
    // Once: the sender tries again with each message. OpenRTM-aist's does not even notice.
    void report_failure(int error) {
        if (std::exchange(has_reported_, true)) return;
        const Logger rtclog("shared_memory");
        RTC_ERROR(("the sender's shared memory object cannot be opened (%s): no message arrives; is the "
                   "sender in another "
                   "container, or of another user? Connect with interface_type=corba_cdr",
                   std::strerror(error)));
    }
    std::mutex mutex_;
    bool little_endian_ = true; // of the length; the sender tells it before the first message
    bool has_reported_ = false;
    SharedMessageReader object_;
};

/// Push, the receiving end.
class SharedMemoryInPortServant : public SharedMemoryReaderServant {
  public:
    SharedMemoryInPortServant(std::shared_ptr<PushReceiver> receiver, bool little_endian)
        : receiver_(std::move(receiver)), little_endian_(little_endian) {}
    OpenRTM::PortStatus put() override {
        ByteData bytes;
        if (!read(bytes)) return OpenRTM::PORT_ERROR;
        bytes.isLittleEndian(little_endian_); // agreed for the connection
        return to_port_status(receiver_->receive_by_call(bytes));
    }

  private:
    std::shared_ptr<PushReceiver> receiver_;
    bool little_endian_;
};

/// Push, the sending end.
class SharedMemoryReceiver : public RemoteReceiver {
  public:
    explicit SharedMemoryReceiver(CORBA::Object_ptr object)
        : object_(OpenRTM::PortSharedMemory::_unchecked_narrow(object)) {}
    std::optional<DataPortStatus> put(const ByteData& bytes) override {
        try {
            if (sender_.prepare(object_.in(), bytes.getDataLength(), bytes.getEndian()) &&
                sender_.write(bytes))
                return from_port_status(object_->put());
            sender_.abandon();
            return DataPortStatus::PORT_ERROR;
        } catch (const CORBA::SystemException& e) {
            sender_.abandon();
            return status_of(e);
        }
    }
    void set_timeout(std::chrono::milliseconds timeout) override { set_call_timeout(object_.in(), timeout); }

  private:
    OpenRTM::PortSharedMemory_var object_;
    SharedMessageSender sender_;
};

/// Pull, the sending end. Its calls to the peer have a time limit, because they occupy an ORB thread. [ORB threads]
class SharedMemoryOutPortServant : public SharedMemoryServant {
  public:
    explicit SharedMemoryOutPortServant(std::shared_ptr<PullBuffer> buffer) : buffer_(std::move(buffer)) {}
    void setInterface(OpenRTM::PortSharedMemory_ptr reader) override {
        std::lock_guard<std::mutex> lock(mutex_);
        reader_ = OpenRTM::PortSharedMemory::_duplicate(reader);
        if (!CORBA::is_nil(reader)) set_call_timeout(reader, std::chrono::seconds(2));
        sender_.abandon();
    }
    void close_memory(CORBA::Boolean) override {
        std::lock_guard<std::mutex> lock(mutex_);
        sender_.abandon();
    }
    OpenRTM::PortStatus get() override {
        std::lock_guard<std::mutex> lock(mutex_);
        if (CORBA::is_nil(reader_.in())) return OpenRTM::PORT_ERROR;
        ByteData bytes;
        const OpenRTM::PortStatus status = to_port_status(buffer_->fetch(bytes));
        if (status != OpenRTM::PORT_OK) return status;
        try {
            if (sender_.prepare(reader_.in(), bytes.getDataLength(), bytes.getEndian()) &&
                sender_.write(bytes))
                return status;
        } catch (const CORBA::SystemException&) {
            // The peer that asks does not answer. It learns that its message is lost.
        }
        sender_.abandon();
        return OpenRTM::PORT_ERROR;
    }

  private:
    std::mutex mutex_;
    OpenRTM::PortSharedMemory_var reader_;
    std::shared_ptr<PullBuffer> buffer_;
    SharedMessageSender sender_;
};

/// Pull, the receiving end.
class SharedMemorySender : public RemoteSender {
  public:
    explicit SharedMemorySender(CORBA::Object_ptr object)
        : object_(OpenRTM::PortSharedMemory::_unchecked_narrow(object)),
          reader_(new SharedMemoryReaderServant), holder_(reader_) {}
    // When told to, OpenRTM-aist's sender removes the name, but then closes a descriptor twice.
    ~SharedMemorySender() override { reader_->remove_name(); }
    std::optional<DataPortStatus> get(ByteData& bytes) override {
        try {
            if (!is_introduced_) introduce();
            const DataPortStatus status = from_port_status(object_->get());
            if (status != DataPortStatus::PORT_OK || reader_->read(bytes)) return status;
            return DataPortStatus::PORT_ERROR;
        } catch (const CORBA::SystemException& e) {
            return status_of(e);
        }
    }
    bool responds() override { return is_responding(object_.in()); }
    void set_timeout(std::chrono::milliseconds timeout) override { set_call_timeout(object_.in(), timeout); }

  private:
    // Not during connecting, because the peer's process may then be waiting for this one.
    void introduce() {
        object_->setInterface(OpenRTM::PortSharedMemory::_unchecked_narrow(holder_.reference()));
        is_introduced_ = true;
    }
    OpenRTM::PortSharedMemory_var object_;
    SharedMemoryReaderServant* reader_; // owned by holder_
    ServantHolder holder_;
    bool is_introduced_ = false;
};

} // namespace

std::unique_ptr<RemoteReceiver> create_shared_memory_receiver(CORBA::Object_ptr object) {
    return std::make_unique<SharedMemoryReceiver>(object);
}
PortableServer::ServantBase* create_shared_memory_servant(std::shared_ptr<PushReceiver> receiver,
                                                          bool little_endian) {
    return new SharedMemoryInPortServant(std::move(receiver), little_endian);
}
std::unique_ptr<RemoteSender> create_shared_memory_sender(CORBA::Object_ptr object) {
    return std::make_unique<SharedMemorySender>(object);
}
PortableServer::ServantBase* create_shared_memory_servant(std::shared_ptr<PullBuffer> buffer) {
    return new SharedMemoryOutPortServant(std::move(buffer));
}

} // namespace RTC
