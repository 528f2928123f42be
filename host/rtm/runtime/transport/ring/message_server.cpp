// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/ring/message_server.hpp"
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include <atomic>
#include <pthread.h>
#include <rtm/SystemLogger.h>

namespace RTC {

namespace shm = tandem::shm;

struct MessageServer::State {
    State(MessageRingReader& reader, std::shared_ptr<const ServantOwner> servant_owner,
          Receive receive_messages)
        : segment(reader.segment()), calls(reader.call_queue(), {.mode = shm::WaitMode::futex}),
          owner(std::move(servant_owner)), receive(std::move(receive_messages)) {}

    /// [the server's thread]
    void run() {
        pthread_setname_np(pthread_self(), "tandem-messages");
        while (!stopped.load(std::memory_order_relaxed))
            if (auto call = calls.take(shm::longest_wait)) answer(*call);
    }
    void answer(shm::IncomingCall& call) {
        const UpcallScope scope(owner.get(), "put");
        for (bool has_thrown = false;; has_thrown = true) {
            try {
                const auto status = receive();
                // The sender's write() returns PORT_ERROR, as if a call of the ORB had ended in an exception.
                if (!status && has_thrown) return call.reply(shm::CallStatus::exception);
                const auto answer =
                    static_cast<std::byte>(to_port_status(status.value_or(DataPortStatus::PORT_OK)));
                return call.reply(shm::CallStatus::ok, std::span(&answer, 1));
            } catch (const std::exception& error) {
                log_exception(error.what());
            } catch (const CORBA::Exception& error) {
                log_exception(error._name());
            } catch (...) { // a listener is a user's code and may throw any type
                log_exception("an exception that is not a std::exception");
            }
        }
    }
    static void log_exception(const char* text) {
        const Logger rtclog("connections");
        RTC_DEBUG(("a listener of an InPort has thrown: %s", text));
    }
    void stop() {
        stopped = true;
        calls.shut_down();
        segment
            ->end_sleeps(); // also where the sender has truncated the file with the word to wake the thread by
    }

    const std::shared_ptr<shm::Segment> segment;
    shm::CallServer calls;
    const std::shared_ptr<const ServantOwner> owner;
    const Receive receive;
    std::atomic<bool> stopped{false};
};

MessageServer::MessageServer(MessageRingReader& reader, std::shared_ptr<const ServantOwner> owner,
                             Receive receive)
    : state_(std::make_shared<State>(reader, std::move(owner), std::move(receive))),
      thread_(tandem::process::start_thread([state = state_] { state->run(); })) {
    reader.permit_calls();
}

MessageServer::~MessageServer() {
    state_->stop();
    // A listener may end the connection that has called it.
    if (thread_.get_id() == std::this_thread::get_id())
        thread_.detach();
    else
        thread_.join();
}

} // namespace RTC
