// SPDX-License-Identifier: Apache-2.0
// omniORB's TRANSIENT does not distinguish a process that has ended from a network that is down. A socket does.
#include "host/rtm/runtime/network/peer_process.hpp"
#include "host/local/local_endpoint.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <netdb.h>
#include <omniORB4/giopEndpoint.h>
#include <omniORB4/omniIOR.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace RTC {
namespace {

// Returns 0 if connected, otherwise the error; ETIMEDOUT if there is no answer in time.
int errno_of_connecting(const addrinfo& address, std::chrono::milliseconds timeout) {
    const int fd = ::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0) return errno;
    int error = ::connect(fd, address.ai_addr, address.ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
        pollfd waiting{fd, POLLOUT, 0};
        socklen_t size = sizeof error;
        if (::poll(&waiting, 1, static_cast<int>(timeout.count())) != 1 ||
            ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) != 0)
            error = ETIMEDOUT;
    }
    ::close(fd);
    return error;
}

// Returns ECONNREFUSED if an address refuses and none accepts.
int errno_of_connecting(const GiopAddress& address, std::chrono::milliseconds timeout) {
    if (!address.socket.empty()) return tandem::local::accepts_connections(address.socket) ? 0 : ECONNREFUSED;
    addrinfo hints{}, *list = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    if (::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &list) != 0) return EHOSTUNREACH;
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owned(list, ::freeaddrinfo);
    int result = EHOSTUNREACH;
    for (const addrinfo* entry = list; entry != nullptr && result != 0; entry = entry->ai_next) {
        const int error = errno_of_connecting(*entry, timeout);
        if (error == 0 || error == ECONNREFUSED) result = error;
    }
    return result;
}

} // namespace

PeerState probe_peer(CORBA::Object_ptr object, std::chrono::milliseconds timeout) {
    if (CORBA::is_nil(object) || object->_PR_getobj() == nullptr) return PeerState::ended;
    const omniIOR_var ior = object->_PR_getobj()->_getIOR();
    PeerState state = PeerState::silent;
    const auto& addresses = ior->getIORInfo()->addresses();
    for (auto* each : addresses) {
        const GiopAddress address = parse_giop_address(each->address());
        // If the reference has several addresses, a socket that does not exist here belongs to a process on another
        // machine with the same host name.
        if (addresses.size() > 1 && !address.socket.empty() && ::access(address.socket.c_str(), F_OK) != 0)
            continue;
        const int error = errno_of_connecting(address, timeout);
        if (error == 0) return PeerState::listens;
        if (error == ECONNREFUSED) state = PeerState::ended;
    }
    return state;
}

bool is_object_gone(const CORBA::SystemException& e, CORBA::Object_ptr object, bool is_on_another_machine) {
    const CORBA::Exception* thrown = &e;
    if (CORBA::TIMEOUT::_downcast(thrown) != nullptr) return false;
    if (CORBA::OBJECT_NOT_EXIST::_downcast(thrown) != nullptr ||
        CORBA::OBJ_ADAPTER::_downcast(thrown) != nullptr || CORBA::INV_OBJREF::_downcast(thrown) != nullptr)
        return true;
    if (CORBA::TRANSIENT::_downcast(thrown) == nullptr && CORBA::COMM_FAILURE::_downcast(thrown) == nullptr)
        return false;
    return !is_on_another_machine || probe_peer(object, std::chrono::milliseconds(500)) == PeerState::ended;
}

} // namespace RTC
