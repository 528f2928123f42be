// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "proxy/link/link.hpp"
#include "proxy/wire/cdr.hpp"

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::test {

/// The second side of a link, as InterceptorComp is it, which takes the messages of the first side's port `temperature`.
class PeerHost final : private link::LinkHandler {
  public:
    explicit PeerHost(const std::string& name)
        : link_(shm::Side::second, {.name = name}, {}, static_cast<link::LinkHandler&>(*this)) {
        link_.open();
    }
    ~PeerHost() override { link_.close(); }

    /// Counts of the messages so far.
    std::vector<double> values() {
        const std::lock_guard lock(mutex_);
        while (link_.reader("temperature").read(false, [&](const shm::Record& record) {
            values_.push_back(wire::CdrReader(record.bytes).get<double>());
        })) {
        }
        return values_;
    }
    bool was_activated() const { return activated_; }
    bool was_deactivated() const { return deactivated_; }

  private:
    std::string check_peer_ports(link::PortTable&) override { return ""; }
    void link_state_changed(bool) override {}
    void deadline_missed(const std::string&) override {}
    void peer_connected() override {}
    void peer_disconnected() override {}
    link::Reply serve(const link::Request& request) override {
        if (request.operation == link::control::activate) activated_ = true;
        if (request.operation == link::control::deactivate) deactivated_ = true;
        return {};
    }
    std::mutex mutex_;
    std::vector<double> values_;
    std::atomic<bool> activated_{false}, deactivated_{false};
    link::Link link_;
};

} // namespace tandem::test
