// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/data/out_tap.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <DataPortListener.h>
#include <InputDataPortInterface.h>
#include <OutputDataPort.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors an output data port of the peer. It pushes nothing: each connected OPRoS input port reads in its component's
/// thread, through its source, an OutTap. The link's doorbell tells an event-driven consumer when to read.
class MirrorOutPort final : public OutputDataPortInterface, public RefusalRecord, private DataPortListener {
  public:
    /// Sets the listener for arrived messages; nullptr: none. On return the earlier one is not in use. With a single
    /// target, this is the target's own listener, whose thread may wait in the link.
    using SetListener = std::function<void(DataPortListener*)>;

    /// `peer` is the port's entry in the peer's table; `convert` is that of check_type(). The channel must outlive this
    /// port.
    MirrorOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener,
                  std::string convert = "");
    ~MirrorOutPort() override;

    // Values come only from the link.
    ReturnType push(opros_any&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType marshal(opros_any&, std::string&) override { return OPROS_UNSUPPORTED_METHOD; }

    bool checkType(opros_any&) override { return true; }
    /// Called when the host connects this port. Returns false if the target's type does not match the peer's signature;
    /// typeError() then has the reason. Otherwise becomes the target's source.
    bool checkType(DataPort* target) override;
    std::string typeError() const override { return type_error_; }
    void addConnection(IDataPortLink* connection) override;
    void removeConnection(IDataPortLink* connection) override;
    void clearConnection() override;

    // Used by the taps.
    const link::Port& peer() const { return peer_; }
    link::ChannelReader& channel() { return channel_; }
    bool has_other_targets() const { return has_other_targets_; } ///< with the channel's lock held
    /// Copies a message for all targets except `reader`. With the channel's lock held.
    void keep_for_others(const OutTap& reader, std::span<const std::byte> bytes, std::uint64_t stamp);
    /// Publishes how many messages may wait in the ring so that no target loses any, less one for each target other than
    /// `reader`, which is about to read. With the channel's lock held.
    void publish_room(const OutTap* reader);
    void set_listener(OutTap& tap, DataPortListener* listener);
    void set_depth(OutTap& tap, std::size_t depth);

  private:
    /// [notifier-thread] Notifies all targets that wait.
    void arrived() override;
    void remove(std::size_t tap);
    void set_channel_depth();

    const link::Port peer_;
    link::ChannelReader& channel_;
    const SetListener set_listener_;
    const std::string convert_;
    std::vector<std::unique_ptr<OutTap>>
        taps_;                         ///< changed with both locks: of the channel and of the listeners
    bool has_other_targets_ = false;   ///< changed with taps_
    std::mutex listeners_mutex_;       ///< the taps' listeners
    DataPortListener* told_ = nullptr; ///< the last argument of set_listener_
    std::string type_error_;
};

} // namespace tandem::adaptor
