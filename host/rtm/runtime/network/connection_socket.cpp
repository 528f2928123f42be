// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/connection_socket.hpp"

#include <omniORB4/CORBA.h>
#include <omniORB4/giopEndpoint.h>
#include <omniORB4/internal/SocketCollection.h>

namespace RTC {

// Access to a protected member: an explicit instantiation may name it.
using SocketMember = omni::SocketHandle_t omni::SocketHolder::*;
struct Socket {
    friend SocketMember member_of(Socket);
};
template <class Name, SocketMember member>
struct OpenedSocket {
    friend SocketMember member_of(Name) { return member; }
};
template struct OpenedSocket<Socket, &omni::SocketHolder::pd_socket>;

int socket_of(omni::giopConnection& connection) {
    const auto* holder = dynamic_cast<const omni::SocketHolder*>(&connection);
    return holder == nullptr ? -1 : holder->*member_of(Socket{});
}

} // namespace RTC
