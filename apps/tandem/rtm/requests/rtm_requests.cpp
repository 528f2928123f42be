// SPDX-License-Identifier: Apache-2.0
// `tandem rtm requests`: processes requests from standard input in a loop.
#include "apps/tandem/rtm/requests/parameters.hpp"
#include "apps/tandem/rtm/requests/publishers.hpp"
#include "apps/tandem/rtm/requests/service_calls.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <cerrno>
#include <unistd.h>

namespace tandem::command {
namespace {

/// Dispatches requests.
class RequestServer {
  public:
    explicit RequestServer(const RtmClient& client)
        : components_(client), publishers_(components_), calls_(components_) {}

    /// Answers a request with an `id` by `id`, `ok` and `text`. Answers a request without an `id` only if it fails.
    std::optional<Frame> handle(const Frame& request) {
        Frame reply{{{"op", request.head.value("op", "")}, {"ok", true}, {"text", ""}}};
        for (const char* name : {"id", "publisher"})
            if (request.head.contains(name)) reply.head[name] = request.head[name];
        try {
            carry_out(request, reply);
        } catch (const std::exception& error) {
            reply.head["ok"] = false;
            reply.head["text"] = error.what();
        } catch (const CORBA::Exception& error) { // not a std::exception
            reply.head["ok"] = false;
            reply.head["text"] = std::string("CORBA exception ") + error._name();
        }
        if (!request.head.contains("id") && reply.head["ok"].get<bool>()) return std::nullopt;
        return reply;
    }

  private:
    void carry_out(const Frame& request, Frame& reply) {
        const auto op = request.head.at("op").get<std::string>();
        if (op == "send") return publishers_.send(request);
        if (op == "open") return publishers_.open(request.head);
        if (op == "close") return publishers_.close(request.head);
        if (op == "read") return reply.head.update(read_parameters(components_, request.head));
        if (op == "set") return set_parameters(components_, request.head);
        if (op == "call") {
            reply.bytes = calls_.call(request);
            return;
        }
        throw std::runtime_error("unknown request: " + op);
    }

    HostComponents components_;
    Publishers publishers_;
    ServiceCalls calls_;
};

void write_all(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const auto written = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
        if (written < 0 && errno != EINTR) throw std::runtime_error("the monitor has ended");
        if (written > 0) done += static_cast<std::size_t>(written);
    }
}

} // namespace

int rtm_requests(const RtmClientOptions& options) {
    RtmClientOptions no_search = options;
    no_search.name_servers = {"localhost"}; // unused, because components are found by their hosts' pids
    const RtmClient client(no_search, true);
    RequestServer server(client);
    std::string received;
    char bytes[65536];
    while (true) {
        while (const auto request = take_frame(received))
            if (const auto reply = server.handle(*request)) write_all(encode(*reply));
        const auto count = ::read(STDIN_FILENO, bytes, sizeof bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return 0;
        received.append(bytes, static_cast<std::size_t>(count));
    }
}

} // namespace tandem::command
