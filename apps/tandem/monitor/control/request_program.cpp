// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/request_program.hpp"

#include <boost/asio/write.hpp>
#include <sys/socket.h>

#include <system_error>

namespace tandem::monitor {
namespace {

using SocketFailure = boost::system::error_code;
constexpr std::chrono::milliseconds watch_pause{500};
/// Time limit for the program to close its connections.
constexpr std::chrono::seconds end_bound{3};

command::Frame failure(const std::string& text) { return {{{"ok", false}, {"text", text}}, {}}; }

} // namespace

/// Pending operations keep it alive; they end with the socket.
struct RequestProgram::Connection {
    explicit Connection(boost::asio::io_context& context) : socket(context) {}
    ~Connection() {
        SocketFailure ignored;
        socket.close(ignored); // ends the program's input
        if (child) child->wait(end_bound);
    }
    boost::asio::local::stream_protocol::socket socket;
    std::optional<process::ChildProcess> child;
    std::deque<std::string> queue; ///< the first is being sent
    std::size_t waiting = 0;       ///< bytes in `queue`
    std::string received;
    std::array<char, 65536> bytes{};
};

RequestProgram::RequestProgram(boost::asio::io_context& context, std::string program,
                               std::string call_timeout_s)
    : context_(context), program_(std::move(program)), call_timeout_s_(std::move(call_timeout_s)),
      timer_(context) {}

RequestProgram::~RequestProgram() = default;

/// Throws std::system_error.
void RequestProgram::start() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw std::system_error(errno, std::generic_category(), "socketpair");
    const process::FileDescriptor of_child(ends[1]);
    auto connection = std::make_shared<Connection>(context_);
    connection->socket.assign(boost::asio::local::stream_protocol(), ends[0]);
    process::ChildOptions options;
    options.input = options.output = of_child.get();
    connection->child.emplace(
        std::vector<std::string>{program_, "rtm", "requests", "--timeout", call_timeout_s_}, options);
    connection_ = std::move(connection);
    read();
}

bool RequestProgram::send(const command::Frame& frame) {
    try {
        if (connection_ == nullptr) start();
    } catch (const std::system_error&) {
        return false;
    }
    std::string text = encode(frame);
    if (connection_->waiting + text.size() > max_waiting) return false;
    connection_->waiting += text.size();
    connection_->queue.push_back(std::move(text));
    if (connection_->queue.size() == 1) write();
    return true;
}

void RequestProgram::write() {
    boost::asio::async_write(
        connection_->socket, boost::asio::buffer(connection_->queue.front()),
        [this, connection = connection_](const SocketFailure& failed, std::size_t bytes) {
            if (connection != connection_) return; // ended meanwhile; even `this` may be gone
            if (failed) return end("the program that makes CORBA requests has ended");
            connection->waiting -= bytes;
            connection->queue.pop_front();
            if (!connection->queue.empty()) write();
        });
}

void RequestProgram::read() {
    connection_->socket.async_read_some(
        boost::asio::buffer(connection_->bytes),
        [this, connection = connection_](const SocketFailure& failed, std::size_t bytes) {
            if (failed == boost::asio::error::operation_aborted || connection != connection_) return;
            if (failed) return end("the program that makes CORBA requests has ended");
            connection->received.append(connection->bytes.data(), bytes);
            try {
                while (const auto reply = command::take_frame(connection->received)) {
                    take(*reply);
                    if (connection != connection_) return;
                }
            } catch (const std::runtime_error& error) {
                return end(error.what());
            }
            read();
        });
}

void RequestProgram::take(const command::Frame& reply) {
    if (const auto pending = pending_.find(reply.head.value("id", 0)); pending != pending_.end()) {
        const Done done = std::move(pending->second.done);
        pending_.erase(pending);
        return done(reply);
    }
    if (const auto found = publishers_.find(reply.head.value("publisher", 0)); found != publishers_.end()) {
        const Failed failed = found->second; // a copy, because the callback can remove the publisher
        failed(reply.head.value("text", ""), false);
    }
}

/// The next request starts a new program.
void RequestProgram::end(const std::string& why) {
    if (connection_->child) connection_->child->kill();
    connection_.reset();
    for (auto& [id, pending] : std::exchange(pending_, {})) pending.done(failure(why));
    for (auto& [publisher, failed] : std::exchange(publishers_, {})) failed(why, true);
}

void RequestProgram::ask(command::Frame request, Done done) {
    if (pending_.size() >= max_pending) return done(failure("64 requests are pending; try again"));
    const int id = next_id_++;
    request.head["id"] = id;
    pending_[id] = {std::chrono::steady_clock::now() + max_time, std::move(done)};
    if (!send(request)) {
        const Done refused = std::move(pending_[id].done);
        pending_.erase(id);
        return refused(failure("too many requests are waiting; try again"));
    }
    if (!watches_) watch();
}

bool RequestProgram::tell(const command::Frame& request) { return send(request); }

int RequestProgram::add_publisher(Failed failed) {
    publishers_[next_publisher_] = std::move(failed);
    return next_publisher_++;
}

void RequestProgram::remove_publisher(int publisher) {
    if (publishers_.erase(publisher) != 0 && connection_ != nullptr)
        tell({{{"op", "close"}, {"publisher", publisher}}, {}});
}

void RequestProgram::watch() {
    watches_ = !pending_.empty();
    if (!watches_) return;
    // The program answers requests in order, so the first is the oldest.
    if (std::chrono::steady_clock::now() > pending_.begin()->second.end) end("no answer within 30 s");
    timer_.expires_after(watch_pause);
    timer_.async_wait([this](const SocketFailure& aborted) {
        if (!aborted) watch();
    });
}

} // namespace tandem::monitor
