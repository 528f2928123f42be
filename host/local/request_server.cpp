// SPDX-License-Identifier: Apache-2.0
#include "host/local/request_server.hpp"

#include "host/local/frame_socket.hpp"
#include "host/process/file_descriptor.hpp"
#include "host/process/start_thread.hpp"
#include "shm/os/close_on_fork_descriptor.hpp"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <list>
#include <mutex>
#include <optional>
#include <poll.h>
#include <pthread.h>
#include <stdexcept>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace tandem::local {
namespace {

using Clock = std::chrono::steady_clock;
using process::FileDescriptor;

constexpr int max_running = 20, max_hanging = 16;
// More than requests: one that is refused must be read first.
constexpr std::size_t max_clients = 32;
// How long a client may take to send its request, and to receive the reply.
constexpr std::chrono::seconds transfer_limit{5};

constexpr std::chrono::milliseconds pause_without_descriptors{200};

[[noreturn]] void fail(const std::filesystem::path& path) {
    throw std::runtime_error("socket " + path.string() + ": " + std::strerror(errno));
}

FileDescriptor listen_at(const std::filesystem::path& path) {
    const sockaddr_un address = socket_address(path);
    FileDescriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (!listener) fail(path);
    ::fchmod(listener.get(), 0600); // before bind: the file never has a wider mode
    if (::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) fail(path);
    if (::listen(listener.get(), max_clients) != 0) fail(path);
    return listener;
}

void signal(const FileDescriptor& event) {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(event.get(), &one, sizeof one);
}

void clear(const FileDescriptor& event) {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto got = ::read(event.get(), &count, sizeof count);
}

} // namespace

struct RequestServer::State {
    /// One request, from its arrival to its reply.
    struct Task {
        std::string request;
        Clock::time_point deadline;
        std::optional<std::string> reply; ///< guarded by State::mutex
    };

    struct Client {
        FileDescriptor socket;
        Clock::time_point deadline; ///< of the transfer
        FrameBuffer received{};
        std::shared_ptr<Task> task{}; ///< while it is answered
        std::string unsent{};
        bool closes = false; ///< when all is sent
    };

    std::filesystem::path path;
    RequestHandler handler;
    /// A child that a component forks must not keep the socket of a killed host open.
    std::unique_ptr<shm::CloseOnForkDescriptor> listener;
    FileDescriptor wake{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    std::thread thread;
    std::list<Client> clients; ///< used only by the thread

    std::mutex mutex;
    std::condition_variable ended; ///< a request
    int running = 0;               ///< requests
    bool stopping = false;

    void serve(const std::shared_ptr<State>& self);
    int wait_time() const;
    void accept_clients();
    bool advance(Client& client, const std::shared_ptr<State>& self);
    void begin(Client& client, std::string request, const std::shared_ptr<State>& self);
    void take_reply(Client& client);
    static void reply(Client& client, const std::string& text);
    bool is_stopping() {
        const std::lock_guard lock(mutex);
        return stopping;
    }
};

// -1 without clients: an idle host is not woken.
int RequestServer::State::wait_time() const {
    if (clients.empty()) return -1;
    auto first = Clock::time_point::max();
    for (const Client& client : clients)
        first = std::min(first, client.task ? client.task->deadline : client.deadline);
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(first - Clock::now()).count();
    return static_cast<int>(std::clamp<long>(left, 0, 3'600'000));
}

void RequestServer::State::serve(const std::shared_ptr<State>& self) {
    pthread_setname_np(pthread_self(), "control");
    while (!is_stopping()) {
        // A full server does not accept new clients, which wait in the queue of the socket.
        const short accepts = clients.size() < max_clients ? POLLIN : 0;
        std::vector<pollfd> watched{{wake.get(), POLLIN, 0}, {listener->get(), accepts, 0}};
        for (const Client& client : clients) {
            const auto events = client.unsent.empty() ? POLLIN : POLLIN | POLLOUT;
            watched.push_back({client.socket.get(), static_cast<short>(events), 0});
        }
        if (::poll(watched.data(), watched.size(), wait_time()) < 0 && errno != EINTR) return;
        clear(wake);
        std::erase_if(clients, [&](Client& client) { return !advance(client, self); });
        if (watched[1].revents != 0) accept_clients();
    }
    clients.clear();
}

void RequestServer::State::accept_clients() {
    while (clients.size() < max_clients) {
        FileDescriptor socket(::accept4(listener->get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (!socket) {
            // Without a descriptor to spare, the client stays in the queue, and poll() returns at once.
            if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
                std::this_thread::sleep_for(pause_without_descriptors);
            return;
        }
        if (peer_is_permitted(socket.get()))
            clients.push_back({std::move(socket), Clock::now() + transfer_limit});
    }
}

/// Returns false if the connection must be closed.
bool RequestServer::State::advance(Client& client, const std::shared_ptr<State>& self) {
    if (!client.received.fill(client.socket.get()))
        return false; // the answer() of a client that left still runs
    if (client.task)
        take_reply(client);
    else if (auto request = client.closes ? std::nullopt : client.received.take())
        begin(client, std::move(*request), self);
    if (client.task) return true;
    if (!send_some(client.socket.get(), client.unsent)) return false;
    if (client.closes && client.unsent.empty()) return false;
    return Clock::now() < client.deadline;
}

void RequestServer::State::begin(Client& client, std::string request, const std::shared_ptr<State>& self) {
    auto task = std::make_shared<Task>();
    task->request = std::move(request);
    task->deadline = Clock::now() + handler.time_limit(task->request);
    {
        const std::lock_guard lock(mutex);
        if (running >= (handler.may_hang(task->request) ? max_hanging : max_running))
            return reply(client, handler.refusal);
        ++running;
    }
    try {
        process::start_thread([self, task] {
            pthread_setname_np(pthread_self(), "control-request");
            std::string answer = self->handler.answer(task->request);
            const std::lock_guard lock(self->mutex);
            task->reply = std::move(answer);
            --self->running;
            self->ended.notify_all();
            signal(self->wake);
        }).detach();
        client.task = task;
    } catch (const process::NotStarted&) {
        const std::lock_guard lock(mutex);
        --running;
        reply(client, handler.refusal);
    }
}

void RequestServer::State::take_reply(Client& client) {
    std::optional<std::string> text;
    {
        const std::lock_guard lock(mutex);
        text = client.task->reply;
    }
    if (!text && Clock::now() < client.task->deadline) return;
    reply(client, text ? *text : handler.late_reply(client.task->request));
    client.task.reset();
}

void RequestServer::State::reply(Client& client, const std::string& text) {
    client.unsent = make_frame(text.size() > max_frame_bytes ? std::string() : text);
    client.closes = true;
    client.deadline = Clock::now() + transfer_limit;
}

RequestServer::RequestServer(const std::filesystem::path& socket, RequestHandler handler)
    : state_(std::make_shared<State>()) {
    state_->path = socket;
    state_->handler = std::move(handler);
    if (!state_->wake) fail(socket);
    state_->listener = std::make_unique<shm::CloseOnForkDescriptor>([&] { return listen_at(socket); });
    try {
        state_->thread = process::start_thread([state = state_] { state->serve(state); });
    } catch (const process::NotStarted& error) {
        ::unlink(socket.c_str());
        throw std::runtime_error("socket " + socket.string() + ": " + error.what());
    }
}

RequestServer::~RequestServer() { stop_within(std::chrono::nanoseconds(0)); }

bool RequestServer::stop_within(std::chrono::nanoseconds timeout) {
    if (state_->thread.joinable()) {
        ::unlink(state_->path.c_str());
        {
            const std::lock_guard lock(state_->mutex);
            state_->stopping = true;
        }
        signal(state_->wake);
        state_->thread.join();
        state_->listener.reset();
    }
    std::unique_lock lock(state_->mutex);
    if (!state_->ended.wait_for(lock, timeout, [this] { return state_->running == 0; })) return false;
    // The thread of the last request may hold the State for longer than what the handler uses lives.
    const RequestHandler ended = std::exchange(state_->handler, {});
    return true;
}

} // namespace tandem::local
