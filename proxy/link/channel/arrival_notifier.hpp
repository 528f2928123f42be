// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/channel/doorbell_turn.hpp"
#include "proxy/link/session/link_state.hpp"
#include "shm/wait/wait_options.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace tandem::link {

/// Notifies event-driven consumers of arrived messages. Its thread sleeps on this side's doorbell in the segment,
/// which the peer rings after each message of the requested ports (ChannelWriter::set_peer_listens). The thread
/// starts with the first listener: a link whose consumers all poll has no such thread, and its writers ring nothing.
/// If all listeners belong to one consumer, this consumer may sleep on the doorbell instead of the thread
/// (DoorbellTurn).
class ArrivalNotifier {
  public:
    /// All references must outlive this object.
    ArrivalNotifier(const LinkState& state, const shm::WaitOptions& wait) : state_(state), wait_(wait) {}
    ~ArrivalNotifier() { stop(); }
    ArrivalNotifier(const ArrivalNotifier&) = delete;
    ArrivalNotifier& operator=(const ArrivalNotifier&) = delete;

    /// Calls `listener` in the notifier thread after messages of the channel have arrived, at least once for all that
    /// arrived together. An empty function removes the listener: on return it is not running and will not be called
    /// again. The listener must not block. `consumer` identifies the thread that the listener wakes, if this thread
    /// calls wait_as(). [any-thread but the notifier's]
    void set_listener(const ChannelReader& channel, std::function<void()> listener,
                      const void* consumer = nullptr);

    enum class Wait {
        refused, ///< not now: the notifier thread calls the listeners
        woken,   ///< no message has come
        arrived  ///< messages for the consumer; its listeners are not called
    };
    /// Waits for messages in the consumer's own thread. Returns refused at once without a session, or while others
    /// listen.
    Wait wait_as(const void* consumer);
    /// Ends the consumer's current call of wait_as(), or the next one. [any-thread]
    void wake(const void* consumer) { turn_.wake(consumer); }
    /// Sets whether the peer of this session has confirmed (control::listen) that it rings for all ports that
    /// currently have listeners. Until then, the thread also checks once a second. [any-thread but the notifier's]
    void set_peer_rings(const std::shared_ptr<LinkSession>& session, bool rings);
    /// Ends the thread. Call it after LinkState::start_closing(). [not in a listener]
    void stop();

  private:
    struct Listener {
        const ChannelReader* channel; ///< outlives this object
        std::function<void()> arrived;
        const void* consumer = nullptr;
        std::uint64_t seen = 0; ///< messages sent by the ring's writer when the listener was last called
    };
    void run();
    std::chrono::nanoseconds look_again_in(const std::shared_ptr<LinkSession>& session);
    void wait_at_doorbell(const std::shared_ptr<LinkSession>& session);
    bool notify(const void* consumer);
    const void* sole_consumer() const;
    void wake();

    const LinkState& state_;
    const shm::WaitOptions wait_;
    DoorbellTurn turn_;
    rt::ShortMutex mutex_;               ///< guards the members below; held while listeners are called
    std::vector<Listener> listeners_;    ///< at most one per channel
    std::weak_ptr<LinkSession> rung_in_; ///< the session whose peer rings for all listeners
    std::thread thread_;
    bool stopping_ = false;
};

} // namespace tandem::link
