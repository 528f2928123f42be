// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/peer_answers.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/network/peer_process.hpp"
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <rtm/SystemLogger.h>
#include <utility>

namespace RTC {

PeerAnswers::PeerAnswers(CORBA::Object_ptr object)
    : object_(CORBA::Object::_duplicate(object)), other_machine_(address_on_another_machine(object)) {}

void PeerAnswers::answered() {
    if (!is_on_another_machine()) return;
    answered_at_ = std::chrono::steady_clock::now();
    if (!is_silent_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_silent_) return;
    Logger rtclog("connections");
    RTC_WARN(("%s answers again; %u messages to it had no answer", other_machine_.c_str(), unanswered_));
    unanswered_ = 0;
    notice_.reset();
    is_silent_ = false;
}

std::optional<DataPortStatus> PeerAnswers::failed(const CORBA::SystemException& e, Time begun) {
    auto status = status_of(e);
    if (!is_on_another_machine()) return status;
    // COMPLETED_NO: connecting or sending has timed out, and no whole message has left this machine. Otherwise, a
    // process that listens is hanging, and may take this message later, after newer ones.
    if (!status && e.completed() != CORBA::COMPLETED_NO &&
        probe_peer(object_.in(), std::chrono::milliseconds(500)) == PeerState::listens)
        return DataPortStatus::CONNECTION_LOST;
    if (status == DataPortStatus::CONNECTION_LOST && !is_object_gone(e, object_.in(), true))
        status = std::nullopt; // a network failure, which is temporary
    if (!status) log_silence(begun);
    return status;
}

// Calls may overlap. A call that began before the last answer reports an outdated state.
void PeerAnswers::log_silence(Time begun) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (begun < answered_at_.load()) return;
    ++unanswered_;
    if (is_silent_) return;
    is_silent_ = true;
    const std::string line = other_machine_ + " does not answer: messages to it are lost until it does";
    Logger rtclog("connections");
    RTC_WARN(("%s", line.c_str()));
    notice_.emplace(tandem::process::NoticeKind::lost, line);
}

void PeerErrors::note(const ConnectorInfo& connection, const char* peer, DataPortStatus status) {
    if (status == DataPortStatus::CONNECTION_LOST || std::exchange(has_logged_, true)) return;
    const std::string type = corba_interface_type(connection.properties);
    Logger rtclog("connections");
    RTC_ERROR(("connection %s: the %s answers with %s, and messages are lost; its process may log why%s",
               connection.name.c_str(), peer, toString(status),
               type == "corba_cdr" ? "" : (", or use interface_type corba_cdr instead of " + type).c_str()));
}

} // namespace RTC
