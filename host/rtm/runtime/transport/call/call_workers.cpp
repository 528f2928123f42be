// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/call/call_workers.hpp"
#include "host/rtm/runtime/network/sending_threads.hpp"
#include "host/rtm/runtime/transport/call/object_call.hpp"
#include "shm/call/call_server.hpp"
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <pthread.h>
#include <semaphore>
#include <vector>

namespace RTC {
namespace {

namespace shm = tandem::shm;

constexpr std::size_t kept_threads = 2;
// A oneway call no longer has a place in the queue while it runs. So that the calls in the queue always find a thread, also
// those within oneway calls, there are as many threads again.
constexpr std::ptrdiff_t max_oneway_calls = max_shared_calls;
constexpr std::size_t max_threads = max_shared_calls + max_oneway_calls;
// Time between two checks whether the caller of a waiting call has given up.
constexpr std::chrono::milliseconds pause{100};
constexpr std::chrono::seconds idle_time{1}; // after which further threads end

} // namespace

/// Keeps the order of oneway calls: a call of a thread begins after the oneway calls that the thread has made before.
/// [any-thread]
class OnewayOrder {
  public:
    /// The place of a call, from when it is taken to its end.
    class Place {
      public:
        Place(OnewayOrder& order, CORBA::ULongLong thread, bool is_oneway)
            : order_(order), thread_(thread), is_oneway_(is_oneway) {
            const std::lock_guard lock(order_.mutex_);
            if (is_oneway_)
                before_ = order_.count_oneway(thread_);
            else if (const auto found = order_.threads_.find(thread_); found != order_.threads_.end())
                before_ = found->second.taken;
        }
        ~Place() {
            if (!is_oneway_) return;
            const std::lock_guard lock(order_.mutex_);
            const auto found = order_.threads_.find(thread_);
            if (++found->second.ended == found->second.taken) order_.threads_.erase(found);
            order_.ended_.notify_all();
        }
        Place(const Place&) = delete;
        Place& operator=(const Place&) = delete;
        /// Waits until the oneway calls before this one have ended, at most `bound`. Returns false if they have not.
        bool wait(std::chrono::milliseconds bound) const {
            if (before_ == 0) return true;
            std::unique_lock lock(order_.mutex_);
            return order_.ended_.wait_for(lock, bound, [this] {
                const auto found = order_.threads_.find(thread_);
                return found == order_.threads_.end() || found->second.ended >= before_;
            });
        }

      private:
        OnewayOrder& order_;
        const CORBA::ULongLong thread_;
        const bool is_oneway_;
        std::uint64_t before_ = 0; // that many oneway calls of the thread end first, see Count
    };

  private:
    /// Of one thread. A thread that is counted again continues at the highest count, which exceeds every count that a call
    /// waits for.
    struct Count {
        std::uint64_t taken, ended;
    };
    std::uint64_t count_oneway(CORBA::ULongLong thread) {
        Count& count = threads_.try_emplace(thread, Count{highest_, highest_}).first->second;
        const std::uint64_t before = count.taken++;
        highest_ = std::max(highest_, count.taken);
        return before;
    }

    std::mutex mutex_;
    std::condition_variable ended_;
    std::uint64_t highest_ = 0;
    std::map<CORBA::ULongLong, Count> threads_; // those whose oneway calls have not all ended
};

struct CallWorkers::State : std::enable_shared_from_this<CallWorkers::State> {
    using Room = std::counting_semaphore<max_oneway_calls>;
    struct Release {
        void operator()(Room* room) const { room->release(); }
    };

    State(CallSegment from, CORBA::Object_ptr called)
        : segment(std::move(from.segment)), calls(from.calls, {.mode = shm::WaitMode::futex}),
          object(CORBA::Object::_duplicate(called)) {}

    /// Returns false if the process cannot create a thread.
    bool start_thread() {
        const std::lock_guard lock(mutex);
        if (threads == max_threads) return true;
        if (!start_sending_thread([self = shared_from_this()] { self->run(); })) return false;
        ++threads;
        return true;
    }
    /// Returns whether the calling thread, which is idle, must end.
    bool ends_this_thread() {
        const std::lock_guard lock(mutex);
        if (!stopped && threads <= kept_threads) return false;
        --threads;
        return true;
    }
    void run() {
        pthread_setname_np(pthread_self(), "tandem-calls");
        const omni_thread::ensure_self known_to_orb; // which cannot be destroyed before this ends
        for (;;) {
            ++idle;
            auto call = calls.take(threads > kept_threads ? idle_time : shm::longest_wait);
            const bool is_last = --idle == 0;
            if (call && stopped) { // not closed yet, or opened again by the caller's process
                call->reply(shm::CallStatus::shut_down);
                call.reset();
            }
            if (!call && ends_this_thread()) return;
            if (!call) continue;
            if (is_last) start_thread();
            answer(*call);
        }
    }
    /// A call whose request is malformed, or that runs out of memory, is answered with an error.
    void answer(shm::IncomingCall& call) {
        try {
            execute(call);
        } catch (const CORBA::SystemException&) {
            call.reply(shm::CallStatus::bad_arguments);
        } catch (const std::exception& error) {
            call.reply(shm::CallStatus::exception, error.what());
        }
    }
    void execute(shm::IncomingCall& call) {
        CallStream request(call.arguments(), CORBA::COMPLETED_NO);
        CORBA::ULong is_oneway = 0;
        CORBA::ULongLong thread = 0;
        is_oneway <<= request;
        thread <<= request;
        const CORBA::String_var operation(request.unmarshalRawString());
        if (is_oneway == 0) {
            const OnewayOrder::Place place(order, thread, false);
            if (!wait_while_wanted(call, [&] { return place.wait(pause); })) return;
            CallStream reply;
            call_object(object.in(), operation.in(), request, reply);
            return call.reply(shm::CallStatus::ok, reply.written());
        }
        if (!wait_while_wanted(call, [&] { return room.try_acquire_for(pause); })) return;
        const std::unique_ptr<Room, Release> taken(&room);
        const OnewayOrder::Place place(order, thread, true);
        const std::span<const std::byte> all = call.arguments();
        const std::vector<std::byte> copy(all.begin(), all.end()); // the caller may use the slot again
        CallStream arguments(copy, CORBA::COMPLETED_NO);
        arguments.skipInput(request.currentInputPtr());
        call.reply(shm::CallStatus::ok);
        while (!place.wait(pause)) continue;
        CallStream unused;
        call_object(object.in(), operation.in(), arguments, unused);
    }
    /// Returns false if the caller has given up, or this end has stopped, so that the call must go through the ORB. The call is
    /// then answered and must not run.
    template <class Wait>
    bool wait_while_wanted(shm::IncomingCall& call, const Wait& wait) {
        while (!wait()) {
            if (!call.cancelled()) continue;
            call.reply(shm::CallStatus::shut_down);
            return false;
        }
        return true;
    }
    void stop() {
        stopped = true;
        calls.shut_down();
        segment
            ->end_sleeps(); // also where the caller has truncated the file with the word to wake a thread by
    }

    const std::shared_ptr<shm::Segment> segment;
    shm::CallServer calls;
    const CORBA::Object_var object;
    OnewayOrder order;
    Room room{max_oneway_calls}; // for oneway calls that are answered and have not ended
    std::atomic<bool> stopped{false};
    std::atomic<unsigned> idle{0};
    std::mutex mutex; // guards changes of the next one
    std::atomic<std::size_t> threads{0};
};

CallWorkers::CallWorkers(CallSegment segment, CORBA::Object_ptr object)
    : state_(std::make_shared<State>(std::move(segment), object)) {
    if (!state_->start_thread())
        throw shm::Error(state_->segment->path() + ": no thread can be started to execute its calls");
}

CallWorkers::~CallWorkers() { state_->stop(); }

} // namespace RTC
