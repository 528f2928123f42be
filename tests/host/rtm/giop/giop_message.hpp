// SPDX-License-Identifier: Apache-2.0
// GIOP messages written byte by byte, after the CORBA specification, because an ORB only writes valid ones.
#pragma once
#include <arpa/inet.h>
#include <cstring>
#include <netinet/in.h>
#include <omniORB4/CORBA.h>
#include <random>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace testing {

using Bytes = std::vector<unsigned char>;

/// A call of one operation of one object, with valid arguments in both byte orders.
struct Call {
    std::string key, operation;
    Bytes arguments[2]; // big-endian, little-endian
};

/// The key by which a request names the object: read from the IIOP profile of its IOR.
inline std::string object_key(CORBA::ORB_ptr orb, CORBA::Object_ptr object) {
    CORBA::String_var text = orb->object_to_string(object); // IOR:<hex of type id and profiles>
    Bytes ior;
    for (const char* at = text.in() + 4; at[0] != '\0' && at[1] != '\0'; at += 2)
        ior.push_back(static_cast<unsigned char>(std::stoi(std::string(at, 2), nullptr, 16)));
    cdrMemoryStream in(ior.data(), ior.size());
    in.setByteSwapFlag(in.unmarshalBoolean());
    CORBA::String_var type = in.unmarshalString();
    CORBA::ULong profiles, tag, length;
    profiles <<= in;
    tag <<= in;
    length <<= in;
    in.setByteSwapFlag(in.unmarshalBoolean()); // an encapsulation, which starts at a multiple of 4
    in.unmarshalOctet();
    in.unmarshalOctet();
    CORBA::String_var host = in.unmarshalString();
    in.unmarshalUShort();
    CORBA::ULong size;
    size <<= in;
    std::string key(size, '\0');
    in.get_octet_array(reinterpret_cast<CORBA::Octet*>(key.data()), static_cast<int>(size));
    return key;
}

// Arguments of a call, as omniORB marshals them.
inline void marshal(cdrStream& to, const char* text) { to.marshalString(text); }
inline void marshal(cdrStream& to, CORBA::Object_ptr object) { CORBA::Object::_marshalObjRef(object, to); }
template <class T>
void marshal(cdrStream& to, const T& value) {
    value >>= to;
}

template <class... Arguments>
Call call(const std::string& key, const std::string& operation, const Arguments&... arguments) {
    Call made{key, operation, {}};
    for (const bool little : {false, true}) {
        cdrMemoryStream out;
        out.setByteSwapFlag(little);
        (marshal(out, arguments), ...);
        const auto* begin = static_cast<const unsigned char*>(out.bufPtr());
        made.arguments[little].assign(begin, begin + out.bufSize());
    }
    return made;
}

/// Writes one message in one byte order. Numbers are aligned to 4 bytes, as CDR demands.
class MessageWriter {
  public:
    MessageWriter(bool little, unsigned minor, unsigned type)
        : little_(little), bytes{'G',
                                 'I',
                                 'O',
                                 'P',
                                 1,
                                 static_cast<unsigned char>(minor),
                                 static_cast<unsigned char>(little),
                                 static_cast<unsigned char>(type),
                                 0,
                                 0,
                                 0,
                                 0} {}
    void number(std::uint32_t value) {
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        bytes.resize(bytes.size() + 4);
        put(bytes.size() - 4, value);
    }
    void text(const std::string& value, bool with_end) {
        number(static_cast<std::uint32_t>(value.size() + (with_end ? 1 : 0)));
        bytes.insert(bytes.end(), value.begin(), value.end());
        if (with_end) bytes.push_back(0);
    }
    void append(const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
    void align8() {
        while (bytes.size() % 8 != 0) bytes.push_back(0);
    }
    Bytes finish() {
        put(8, static_cast<std::uint32_t>(bytes.size() - 12));
        return bytes;
    }

  private:
    void put(std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i)
            bytes[at + i] = static_cast<unsigned char>(value >> 8 * (little_ ? i : 3 - i));
    }
    bool little_;

  public:
    Bytes bytes;
};

/// A request of GIOP 1.`minor` with a valid header; the arguments may be anything.
inline Bytes request(const std::string& key, const std::string& operation, const Bytes& arguments,
                     unsigned minor, bool little) {
    MessageWriter m(little, minor, 0);
    if (minor < 2) m.number(0); // no service contexts
    m.number(7);                // request id
    m.append(minor == 2 ? Bytes{3, 0, 0, 0} : Bytes{1, 0, 0, 0});
    if (minor == 2) m.number(0); // target: object key
    m.text(key, false);
    m.text(operation, true);
    if (minor == 2) {
        m.number(0); // service contexts
        if (!arguments.empty()) m.align8();
    } else {
        // GIOP 1.0 and 1.1 do not align the arguments: the principal, whose content nobody reads, fills up to a
        // multiple of 8.
        while (m.bytes.size() % 4 != 0) m.bytes.push_back(0);
        const std::size_t filler = (8 - (m.bytes.size() + 4) % 8) % 8;
        m.text(std::string(filler, '\0'), false);
    }
    m.append(arguments);
    return m.finish();
}

/// Returns the same message in fragments of GIOP 1.2: the first has about `first` bytes, the others about
/// `each`.
inline std::vector<Bytes> in_fragments(const Bytes& whole, std::size_t first, std::size_t each) {
    const bool little = whole[6] & 1;
    std::vector<Bytes> pieces;
    std::size_t at = std::min(whole.size(), 12 + (first / 8 + 1) * 8); // pieces end at multiples of 8
    Bytes head(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at));
    while (true) {
        const bool more = at < whole.size();
        head[6] = static_cast<unsigned char>(little | (more ? 2 : 0));
        MessageWriter sized(little, 2, head[7]);
        sized.bytes = head;
        pieces.push_back(sized.finish());
        if (!more) return pieces;
        MessageWriter next(little, 2, 7);
        next.number(7); // of request 7
        const std::size_t end = std::min(whole.size(), at + (each / 8 + 1) * 8);
        next.append(Bytes(whole.begin() + static_cast<std::ptrdiff_t>(at),
                          whole.begin() + static_cast<std::ptrdiff_t>(end)));
        head = next.bytes;
        at = end;
    }
}

/// A TCP connection to the port on the loopback interface with time limits of 5 s; -1: refused.
inline int connect_loopback(const std::string& port) {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    timeval bound{5, 0};
    setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &bound, sizeof bound);
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &bound, sizeof bound);
    if (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return fd;
    close(fd);
    return -1;
}

/// Sends the whole message. Returns false if the host has closed the connection or has not read for 5 s.
inline bool send_all(int fd, const Bytes& message) {
    return send(fd, message.data(), message.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(message.size());
}

} // namespace testing
