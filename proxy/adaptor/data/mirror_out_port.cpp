// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/data/mirror_out_port.hpp"

#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace tandem::adaptor {

MirrorOutPort::MirrorOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener)
    : peer_(std::move(peer)), channel_(channel), set_listener_(std::move(set_listener)) {}

MirrorOutPort::~MirrorOutPort() { detach(); }

bool MirrorOutPort::checkType(DataPort* target) {
    auto* input = dynamic_cast<InputDataPortInterface*>(target);
    if (!input || target_) {
        type_error_ =
            fmt::format("port '{}': {}", peer_.name,
                        input ? "it is connected already, and what crosses the link goes to one port; let "
                                "that component pass it on"
                              : "the target is not an input data port");
        return false;
    }
    const auto check = check_type(input->sample(), peer_, false);
    type_error_ = check.error;
    if (!check.error.empty()) {
        refusals_.push_back(check.error);
        return false;
    }
    // With equal signatures a leading time belongs to the OPRoS type; otherwise only to the peer's.
    value_has_time_ = wire::is_timed(peer_.signature) && check.match == wire::SignatureMatch::equal;
    if (input->addSource(this) != OPROS_SUCCESS) {
        type_error_ = fmt::format("port '{}': the target takes no values from a bridge", peer_.name);
        return false;
    }
    target_ = input;
    return true;
}

void MirrorOutPort::detach() {
    if (target_) target_->removeSource(this);
    target_ = nullptr;
}

opros::archive::iarchive* MirrorOutPort::next() {
    // Held until done(): a rebind or another read would free the memory of the message.
    channel_lock_ = channel_.lock();
    const auto record = channel_.read_locked();
    if (!record) {
        channel_lock_.unlock();
        return nullptr;
    }
    message_bytes_ = record->bytes.size();
    const wire::CdrReader reader(record->bytes);
    return value_has_time_ ? &archive_.emplace(reader, record->stamp_ns) : &archive_.emplace(reader);
}

void MirrorOutPort::done() {
    archive_.reset();
    channel_lock_.unlock();
}

bool MirrorOutPort::setListener(DataPortListener* listener) {
    // The peer is asked to ring the doorbell only when that changes: it costs a call across the link.
    if (listener != listener_) set_listener_(listener);
    listener_ = listener;
    return true;
}

void MirrorOutPort::undecodable(const std::string& why) {
    // Connected types match, so this happens only if the peer is broken; then it may happen in every cycle.
    if (undecodable_.should_log())
        spdlog::error("port '{}': a message of {} bytes does not decode ({}) and is dropped, {} so far",
                      peer_.name, message_bytes_, why, undecodable_.count());
}

} // namespace tandem::adaptor
