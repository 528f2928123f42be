// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/request_admission.hpp"

#include "host/rtm/runtime/network/connection_limits.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <omniORB4/CORBA.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/internal/giopStream.h>
#include <omniORB4/internal/orbParameters.h>
#include <omniORB4/omniInterceptors.h>
#include <string>

#include <omniORB4/internal/GIOP_S.h> // needs the others before it

namespace RTC {
namespace {

constexpr std::size_t uncounted = 64 * 1024; // a request of this size costs less than its thread

// Headers of fragments add to the size that giopMaxMsgSize permits.
std::size_t largest_request() {
    const std::size_t most = omni::orbParameters::giopMaxMsgSize;
    return most + most / 64;
}

/// The memory of the large requests that are being received or served: for each machine one of the largest size, in all
/// four. [any-thread]
class RequestMemory {
  public:
    bool take(const std::string& machine, std::size_t bytes, std::chrono::milliseconds longest) {
        std::unique_lock lock(mutex_);
        const bool fits = released_.wait_for(lock, longest, [&] {
            const auto found = of_machines_.find(machine);
            const std::size_t used = found == of_machines_.end() ? 0 : found->second;
            return used + bytes <= largest_request() && all_ + bytes <= 4 * largest_request();
        });
        if (!fits) return false;
        of_machines_[machine] += bytes;
        all_ += bytes;
        return true;
    }
    void give_back(const std::string& machine, std::size_t bytes) {
        {
            const std::lock_guard lock(mutex_);
            const auto found = of_machines_.find(machine);
            if ((found->second -= bytes) == 0) of_machines_.erase(found);
            all_ -= bytes;
        }
        released_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable released_;
    std::map<std::string, std::size_t> of_machines_;
    std::size_t all_ = 0;
};

// Never destroyed: threads of the ORB may outlive static objects.
RequestMemory& memory() {
    static auto& the_memory = *new RequestMemory;
    return the_memory;
}

/// The request that this thread receives or serves.
struct Current {
    std::size_t announced = 0; ///< bytes, by the headers of its messages
    std::size_t taken = 0;     ///< of the memory
    bool occupies_thread = false;
    bool is_refused = false;
};
constinit thread_local Current current;

// Threads that connections share, and whose requests have not arrived yet. If only a few are left, these do not wait
// long, since other peers need them.
std::atomic<int> occupied_threads{0};
constexpr int many_threads = shared_threads * 3 / 4;
constexpr std::chrono::milliseconds short_wait_for_header{50}, short_wait_for_rest{2000};

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

// Of this thread, for the header or for the rest of a request.
std::chrono::milliseconds longest_wait() {
    const auto usual = connection_limits().request;
    if (!current.occupies_thread || occupied_threads <= many_threads) return usual;
    return std::min(usual, current.announced == 0 ? short_wait_for_header : short_wait_for_rest);
}

std::string machine_of(omni::GIOP_S& request) {
    return parse_giop_address(request.strand().connection->peeraddress()).host;
}

// An option in corba.args replaces these deadlines.
bool has_other_deadlines() { return omni::orbParameters::serverCallTimeOutPeriod; }

void start_deadline(omni::GIOP_S& request) {
    if (has_other_deadlines()) return;
    const auto longest = static_cast<unsigned long>(longest_wait().count());
    omni_time_t deadline;
    omni_thread::get_time(deadline, omni_time_t(longest / 1000, longest % 1000 * 1'000'000));
    request.setDeadline(deadline);
}

void stop_deadline(omni::GIOP_S& request) {
    if (!has_other_deadlines()) request.clearDeadline();
}

CORBA::Boolean on_reply(omni::omniInterceptors::serverSendReply_T::info_T& reply) {
    stop_deadline(reply.giop_s);
    return true;
}

CORBA::Boolean on_exception(omni::omniInterceptors::serverSendException_T::info_T& reply) {
    stop_deadline(reply.giop_s);
    return true;
}

bool is_overdue(omni::GIOP_S& request) {
    omni_time_t now;
    omni_thread::get_time(now);
    return !has_other_deadlines() && request.getDeadline() && request.getDeadline() <= now;
}

} // namespace

void begin_request(omni::GIOP_S& request, bool shares_thread) {
    if (!shares_thread) return;
    occupy_thread();
    start_deadline(request);
}

const char* admit_message(omni::GIOP_S& request, std::size_t size, bool is_complete) {
    const bool is_first = current.announced == 0;
    current.announced += size;
    if (is_first && is_complete) {
        release_thread();
        stop_deadline(request);
    } else if (is_first || (!is_complete && !request.getDeadline())) {
        start_deadline(request);
    }
    if (is_first && size > omni::orbParameters::giopMaxMsgSize)
        return nullptr; // omniORB answers with an error
    if (current.announced <= uncounted) return nullptr;
    if (current.announced > largest_request())
        return refuse("its messages are larger than -ORBgiopMaxMsgSize");
    const std::size_t more = current.announced - current.taken;
    if (!memory().take(machine_of(request), more, longest_wait()))
        return refuse("other requests of its machine occupy the memory for large requests");
    current.taken += more;
    if (is_first && !is_complete)
        start_deadline(request); // again: it has not been read during the wait for memory
    return nullptr;
}

void end_request(omni::GIOP_S* request) {
    if (current.taken > 0) memory().give_back(machine_of(*request), current.taken);
    release_thread();
    const bool is_refused = current.is_refused;
    current = {};
    if (request == nullptr || is_refused) return;
    omni::giopStrand& connection = request->strand();
    if (connection.state() != omni::giopStrand::DYING) return;
    if (was_closed_for_another(connection))
        log_excess_connection(connection);
    else if (is_overdue(*request))
        log_closed_connection(connection, "its request was not complete in time; corba.request_timeout of "
                                          "rtc.conf sets the time");
}

void set_up_request_deadlines() {
    omni::omniInterceptors* interceptors = omniORB::getInterceptors();
    interceptors->serverSendReply.add(on_reply);
    interceptors->serverSendException.add(on_exception);
}

} // namespace RTC
