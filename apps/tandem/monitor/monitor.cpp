// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/commands.hpp"
#include "apps/tandem/monitor/control/control.hpp"
#include "apps/tandem/monitor/foxglove/channels.hpp"
#include "apps/tandem/monitor/metrics.hpp"
#include "apps/tandem/monitor/samples/sample_feed.hpp"
#include "apps/tandem/monitor/state_json.hpp"
#include "apps/tandem/monitor/state_reader.hpp"
#include "apps/tandem/monitor/web/server.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <optional>
#include <thread>

namespace tandem::monitor {
namespace {

/// Interval for reading the links and updating the pages.
constexpr std::chrono::milliseconds look_interval{200};

/// Reads the links periodically and passes the state to the server. [one thread]
class Monitor {
  public:
    /// `service` must outlive the context, because its sessions use it to the end.
    Monitor(boost::asio::io_context& context, const command::MonitorOptions& options, Service& service,
            const std::atomic<bool>& stop)
        : reader_(options.links, &stop), service_(service),
          server_(context, options.bind, options.port, service),
          channels_(
              context, [this]() -> const State& { return state_; }, &stop),
          samples_(
              context, [this]() -> const State& { return state_; }, &stop),
          timer_(context) {
        service.channels = &channels_;
        service.samples = &samples_;
        service.session_id = std::to_string(std::time(nullptr));
        service.other_origins = {options.other_origins.begin(), options.other_origins.end()};
        service.hosts = AllowedHosts(options.allowed_hosts);
        service.files = read_page_files();
        service.metrics = [this] { return metrics_text(state_); };
        if (options.control) {
            control_.emplace(
                context, [this]() -> const State& { return state_; }, options.systems);
            service.control = &*control_;
        }
        look();
    }
    /// The sessions live until the end of the context.
    ~Monitor() {
        service_.channels = nullptr;
        service_.samples = nullptr;
    }
    Monitor(const Monitor&) = delete;
    Monitor& operator=(const Monitor&) = delete;
    /// Returns the page's address, with the token if there is one.
    std::string url() const { return server_.url() + (control_ ? "#token=" + control_->token() : ""); }

  private:
    void look() {
        timer_.expires_after(look_interval);
        timer_.async_wait([this](const boost::system::error_code& aborted) {
            if (!aborted) look();
        });
        State state = reader_.read(state_);
        log_.add(events_between(state_, state));
        // Without /dev/shm, keeps the last state to compare the next one with.
        if (state.error.empty())
            state_ = std::move(state);
        else
            state_.error = std::move(state.error);
        state_.recording_failure = control_ ? control_->recording_failure() : "";
        const auto control =
            control_ ? control_->status() : nlohmann::ordered_json{{"allowed", false}, {"recording", ""}};
        service_.state =
            std::make_shared<std::string>(state_json(state_, judge(state_), log_.events(), control));
        server_.publish();
    }

    StateReader reader_;
    State state_;
    EventLog log_;
    Service& service_;
    std::optional<Control> control_;
    Server server_;
    Channels channels_;
    SampleFeed samples_;
    boost::asio::steady_timer timer_;
};

/// Stops the context after SIGINT or SIGTERM. Waits in its own thread, so that a handler of the context that takes long
/// sees the flag and ends early. Create it before other threads.
class StopOnSignal {
  public:
    StopOnSignal(boost::asio::io_context& context, std::atomic<bool>& stop) {
        signals_.async_wait([&](const boost::system::error_code& aborted, int) {
            if (aborted) return;
            stop = true;
            context.stop();
        });
        thread_ = std::thread([this] { waiting_.run(); });
    }
    ~StopOnSignal() {
        waiting_.stop();
        thread_.join();
    }
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

  private:
    boost::asio::io_context waiting_{1};
    boost::asio::signal_set signals_{waiting_, SIGINT, SIGTERM};
    std::thread thread_;
};

/// A failure in one session, for lack of memory, ends only this session.
void run(boost::asio::io_context& context) {
    while (true) {
        try {
            context.run();
            return;
        } catch (const std::exception& error) {
            command::print_note("tandem: {}\n", error.what());
        }
    }
}

} // namespace
} // namespace tandem::monitor

namespace tandem::command {

int monitor(const MonitorOptions& options) {
    monitor::Service service;
    boost::asio::io_context context(1); // one thread
    std::atomic<bool> stop = false;
    const monitor::StopOnSignal stop_on_signal(context, stop);
    monitor::Monitor monitor(context, options, service, stop);
    print_text(monitor.url() + "\n");
    if (!service.loopback)
        command::print_note(
            "tandem: other machines can read this without a password{}; to prevent this, use --bind "
            "127.0.0.1\n",
            options.control ? ", and control the system with the token, which is sent unencrypted" : "");
    monitor::run(context);
    return 0;
}

} // namespace tandem::command
