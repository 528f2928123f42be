// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/request_admission.hpp"

#include "host/rtm/runtime/network/connection_limits.hpp"
#include "host/rtm/runtime/network/connection_socket.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/network/request_memory.hpp"

#include <algorithm>
#include <atomic>
#include <coil/stringutil.h>
#include <omniORB4/CORBA.h>
#include <omniORB4/callDescriptor.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/internal/giopStream.h>
#include <omniORB4/internal/orbParameters.h>
#include <omniORB4/omniInterceptors.h>
#include <string>
#include <sys/socket.h>

#include <omniORB4/internal/GIOP_S.h> // needs the others before it

namespace RTC {
namespace {

using std::chrono::milliseconds;

constexpr unsigned char request_type = 0, locate_request_type = 3;
constexpr std::size_t uncounted = std::size_t{64} * 1024; // a request of this size costs less than its thread

// Headers of fragments add to the size that giopMaxMsgSize permits.
std::size_t largest_request() {
    const std::size_t most = omni::orbParameters::giopMaxMsgSize;
    return most + most / 64;
}

// Never destroyed: threads of the ORB may outlive static objects.
RequestMemory& memory() {
    static auto& the_memory = *new RequestMemory(largest_request(), 4 * largest_request());
    return the_memory;
}

/// The request that this thread receives or serves.
struct Current {
    omni::GIOP_S* request = nullptr;
    std::size_t announced = 0; ///< bytes, by the headers of its messages
    TakenMemory memory;
    milliseconds limit{}; ///< of its deadline
    bool shares_thread = false;
    bool has_header = false;
    bool has_arrived = false;
    bool is_replying = false;
    bool occupies_thread = false;
    bool is_refused = false;
};
constinit thread_local Current current;

// Threads that connections share, and that wait for a client: for the rest of its request, or until it has read the
// reply. If many do, further ones do not wait long, since other clients need them. `many` is less than half: after a burst
// of connections omniORB may have made only half of the shared threads, and makes the others for later requests.
std::atomic<int> occupied_threads{0};
constexpr int many_threads = shared_threads * 3 / 8;
constexpr milliseconds short_wait_for_header{50}, short_wait{2000};

void occupy_thread() {
    current.occupies_thread = true;
    ++occupied_threads;
}

void release_thread() {
    if (current.occupies_thread) --occupied_threads;
    current.occupies_thread = false;
}

const char* refuse(const char* reason) {
    current.is_refused = true; // which is logged, so that a missed deadline is not
    return reason;
}

// The limit of this thread for the header, for the rest of a request, or for its reply.
milliseconds longest_wait() {
    const auto usual = connection_limits().request;
    if (!current.occupies_thread || occupied_threads <= many_threads) return usual;
    return std::min(usual, current.has_header ? short_wait : short_wait_for_header);
}

// All connections of a machine are one client. A Unix socket has no address, but the kernel knows its process.
std::string client_of(omni::GIOP_S& request) {
    omni::giopConnection& connection = *request.strand().connection;
    std::string host = parse_giop_address(connection.peeraddress()).host;
    if (!host.empty()) return host;
    ucred process{};
    socklen_t size = sizeof process;
    ::getsockopt(socket_of(connection), SOL_SOCKET, SO_PEERCRED, &process, &size);
    return "process " + std::to_string(process.pid);
}

// An option in corba.args replaces these deadlines.
bool has_other_deadlines() { return omni::orbParameters::serverCallTimeOutPeriod; }

omni_time_t to_omni_time(milliseconds time) {
    const auto number = static_cast<unsigned long>(time.count());
    return {number / 1000, number % 1000 * 1'000'000};
}

void start_deadline(omni::GIOP_S& request) {
    if (has_other_deadlines()) return;
    current.limit = longest_wait();
    omni_time_t deadline;
    omni_thread::get_time(deadline, to_omni_time(current.limit));
    request.setDeadline(deadline);
}

void stop_deadline(omni::GIOP_S& request) {
    if (!has_other_deadlines()) request.clearDeadline();
}

// A request is not read while it waits for memory.
bool take_memory(omni::GIOP_S& request, std::size_t more) {
    const auto begin = std::chrono::steady_clock::now();
    if (!memory().take(current.memory, client_of(request), more, longest_wait())) return false;
    const auto waited = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begin);
    if (!has_other_deadlines() && request.getDeadline())
        request.setDeadline(request.getDeadline() + to_omni_time(waited));
    return true;
}

// From here on, only the component uses the memory of the request and the time of its thread.
void note_arrival() {
    if (current.request == nullptr || current.has_arrived) return;
    current.has_arrived = true;
    memory().give_back(current.memory);
    release_thread();
    stop_deadline(*current.request);
}

void begin_to_receive(omni::GIOP_S& request, const ArrivingMessage& message) {
    current.has_header = true;
    if (!message.is_complete) {
        keep_from_closing(request.strand());
        start_deadline(request);
    } else if (message.type == request_type) {
        note_arrival();
    } else if (current.shares_thread) {
        start_deadline(request); // of its reply too: interceptors do not see that one
    }
}

// Called around each call of an object. All arguments of the request have been read.
void on_call(omniCallDescriptor* call, omniServant* servant) {
    note_arrival();
    call->interceptedCall(servant);
}

// A client that does not read must not keep a thread that others need.
void begin_reply(omni::GIOP_S& request) {
    note_arrival();
    if (!current.shares_thread || current.is_replying) return;
    current.is_replying = true;
    occupy_thread();
    start_deadline(request);
}

CORBA::Boolean on_reply(omni::omniInterceptors::serverSendReply_T::info_T& reply) {
    begin_reply(reply.giop_s);
    return true;
}

CORBA::Boolean on_exception(omni::omniInterceptors::serverSendException_T::info_T& reply) {
    begin_reply(reply.giop_s);
    return true;
}

bool is_overdue(omni::GIOP_S& request) {
    omni_time_t now;
    omni_thread::get_time(now);
    return !has_other_deadlines() && request.getDeadline() && request.getDeadline() <= now;
}

std::string describe_missed_deadline() {
    const auto in_seconds = std::chrono::duration<double>(current.limit).count();
    return std::string(current.is_replying ? "it did not read the reply" : "its request was not complete") +
           " within " + coil::otos(in_seconds) + " s; " +
           (current.limit == connection_limits().request
                ? "corba.request_timeout of rtc.conf sets the time"
                : "the time is short while many of the shared threads wait for clients");
}

} // namespace

void begin_request(omni::GIOP_S& request, bool shares_thread) {
    current.request = &request;
    current.shares_thread = shares_thread;
    if (!shares_thread) return;
    occupy_thread();
    start_deadline(request);
}

const char* admit_message(omni::GIOP_S& request, const ArrivingMessage& message) {
    const bool is_request = message.type == request_type || message.type == locate_request_type;
    if (is_request && current.has_header)
        return refuse("it began a request before the last fragment of another one");
    current.announced += message.size;
    if (is_request)
        begin_to_receive(request, message);
    else if (!message.is_complete && !request.getDeadline())
        start_deadline(request);
    if (is_request && message.size > omni::orbParameters::giopMaxMsgSize)
        return nullptr; // omniORB answers with an error
    if (current.announced <= uncounted) return nullptr;
    if (current.announced > largest_request())
        return refuse("its messages are larger than -ORBgiopMaxMsgSize");
    if (!take_memory(request, current.announced - current.memory.bytes))
        return refuse("other requests of its machine occupy the memory for large requests");
    return nullptr;
}

void end_request(omni::GIOP_S* request) {
    memory().give_back(current.memory);
    release_thread();
    if (request != nullptr && !current.is_refused) {
        omni::giopStrand& connection = request->strand();
        if (connection.state() != omni::giopStrand::DYING)
            note_use(connection);
        else if (was_closed_for_another(connection))
            log_excess_connection(connection);
        else if (is_overdue(*request))
            log_closed_connection(connection, describe_missed_deadline());
    }
    current = {};
}

void set_up_request_deadlines() {
    omni::omniInterceptors* interceptors = omniORB::getInterceptors();
    interceptors->serverSendReply.add(on_reply);
    interceptors->serverSendException.add(on_exception);
    omniCallDescriptor::removeInterceptor(on_call); // of an earlier ORB of this process
    omniCallDescriptor::addInterceptor(on_call);
}

} // namespace RTC
