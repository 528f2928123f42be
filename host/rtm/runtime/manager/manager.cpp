// SPDX-License-Identifier: Apache-2.0
// The manager's life: start, activation, run loop, orderly end.
#include "host/plugin/abi.hpp"
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/sdo/shared_composite.hpp"
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <poll.h>
#include <rtm/CdrRingBuffer.h>
#include <rtm/ExtTrigExecutionContext.h>
#include <rtm/PeriodicExecutionContext.h>
#include <rtm/SimulatorExecutionContext.h>
#include <rtm/TandemAbi.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace RTC {
namespace {

std::mutex the_mutex;
// Never deleted: components and static objects of plugins ask for it to the very end.
Manager* the_manager = nullptr;
HostOptions the_options;

// Rung by terminate() (also in signal handlers) and invoke().
const int wake_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
std::atomic<int> end_wanted{0}; // lock-free, so signal handlers may write it

void ring() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_fd, &one, sizeof one); // full means rung already
}

void sleep_until_rung(int milliseconds) {
    pollfd fd{wake_fd, POLLIN, 0};
    if (::poll(&fd, 1, milliseconds) <= 0) return;
    std::uint64_t count;
    [[maybe_unused]] const auto got = ::read(wake_fd, &count, sizeof count);
}

void on_signal(int) { Manager::terminate(); }

void handle_signal(int number) {
    struct sigaction present;
    if (sigaction(number, nullptr, &present) == 0 && present.sa_handler != SIG_DFL)
        return; // the program has its own
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(number, &action, nullptr);
}

} // namespace

HostOptions host_options() { return the_options; }

Manager::Manager(const Options& options) : m_impl(std::make_unique<Impl>()) {
    m_impl->options = options;
    the_options = options;
}
Manager::~Manager() = default;

Manager& Manager::start(int argc, char** argv, const Options& options) {
    std::lock_guard<std::mutex> lock(the_mutex);
    if (the_manager != nullptr) return *the_manager;
    // A component's own program is linked to this library, whatever headers it was built against.
    tandem::plugin::require_abi_of_process(tandem::plugin::Model::rtm, TANDEM_RTM_ABI);
    std::unique_ptr<Manager> manager(new Manager(options));
    read_configuration(*manager->m_impl, argc, argv);
    start_orb(*manager->m_impl);
    manager->registerECFactory("PeriodicExecutionContext", ECCreate<RTC_exp::PeriodicExecutionContext>,
                               ECDelete<RTC_exp::PeriodicExecutionContext>);
    // Ours has what it is for: priority, affinity, absolute time.
    manager->registerECFactory("RTPreemptEC", ECCreate<RTC_exp::PeriodicExecutionContext>,
                               ECDelete<RTC_exp::PeriodicExecutionContext>);
    manager->registerECFactory("ExtTrigExecutionContext", ECCreate<ExtTrigExecutionContext>,
                               ECDelete<ExtTrigExecutionContext>);
    manager->registerECFactory("SimulatorExecutionContext", ECCreate<SimulatorExecutionContext>,
                               ECDelete<SimulatorExecutionContext>);
    for (const char* name : {"SynchExtTriggerEC", "OpenHRPExecutionContext"})
        manager->registerECFactory(name, ECCreate<OpenHRPExecutionContext>,
                                   ECDelete<OpenHRPExecutionContext>);
    CdrBufferFactory::instance().addFactory("ring_buffer", coil::Creator<CdrBufferBase, CdrRingBuffer>,
                                            coil::Destructor<CdrBufferBase, CdrRingBuffer>);
    register_shared_composite(*manager);
    manager->m_impl->naming_manager = std::make_unique<NamingManager>(manager.get());
    the_manager = manager.release();
    start_connection_keeper(*the_manager, *the_manager->m_impl);
    publish_manager(*the_manager, *the_manager->m_impl);
    return *the_manager;
}

Manager* Manager::init(int argc, char** argv) {
    try {
        return &start(argc, argv, Options());
    } catch (const std::runtime_error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        std::exit(1);
    }
}

Manager& Manager::instance() {
    {
        std::lock_guard<std::mutex> lock(the_mutex);
        if (the_manager != nullptr) return *the_manager;
    }
    static char name[] = "tandem";
    char* argv[] = {name, nullptr};
    return *init(1, argv);
}

coil::Properties& Manager::getConfig() { return m_impl->config; }
coil::Properties Manager::Impl::settings() const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    return config;
}
bool Manager::Impl::change_setting(const std::string& key, std::string value) {
    if (key.empty() || !normalize_value(key, value)) return false;
    std::lock_guard<std::recursive_mutex> lock(mutex);
    config.setProperty(key, value);
    return true;
}
std::string Manager::Impl::setting(const std::string& key) const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    return config.getProperty(key);
}
std::string& Manager::getLogLevel() { return m_impl->config["logger.log_level"]; }
void Manager::setModuleInitProc(ModuleInitProc proc) { m_impl->init_proc = proc; }

namespace {

// In the order in which OpenRTM-aist does these things.
template <class Attempt>
void activate_all(Manager& manager, ModuleInitProc init_proc, Attempt attempt) {
    const coil::Properties& config = manager.getConfig();
    auto each = [&](const char* key, auto action) {
        for (const auto& entry : coil::split(config.getProperty(key), ",", true))
            attempt(std::string(key) + ": ", [&] { action(entry); });
    };
    for (const char* key : {"manager.preload.modules", "manager.modules.preload"})
        each(key, [&](const std::string& entry) {
            const std::size_t open = entry.find('(');
            const std::size_t close = entry.find(')', open);
            const std::string init =
                open == std::string::npos ? "" : entry.substr(open + 1, close - open - 1);
            manager.loadOrThrow(coil::eraseBothEndsBlank(entry.substr(0, open)),
                                coil::eraseBothEndsBlank(init));
        });
    attempt("", [&] { open_log_streams(manager.impl()); });
    if (init_proc != nullptr) init_proc(&manager);
    each("manager.components.precreate", [&](const std::string& entry) { manager.createOrThrow(entry); });
    each("manager.components.preconnect", [&](const std::string& entry) { manager.connectOrThrow(entry); });
    each("manager.components.preactivation",
         [&](const std::string& entry) { manager.activateComponentOrThrow(entry); });
}

} // namespace

bool Manager::activateManager() {
    Logger& rtclog = m_impl->log;
    activate_all(*this, m_impl->init_proc, [&](const std::string& place, auto action) {
        try {
            action();
        } catch (const ManagerError& e) {
            RTC_ERROR(("%s%s", place.c_str(), e.what()));
        }
    });
    return true;
}

void Manager::activateOrThrow() {
    const std::string file = m_impl->conf_file.string();
    activate_all(*this, m_impl->init_proc, [&](const std::string& place, auto action) {
        try {
            action();
        } catch (const ManagerError& e) {
            throw ManagerError((file.empty() ? "" : file + ": ") + place + e.what());
        }
    });
}

void Manager::terminate() {
    end_wanted = 1;
    ring();
}

bool Manager::endWanted() { return end_wanted != 0; }

void Manager::join() {}

void Manager::invoke(std::function<void()> fn, std::chrono::nanoseconds delay) {
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        m_impl->tasks.emplace_back(std::chrono::steady_clock::now() + delay, std::move(fn));
    }
    ring();
}

Manager::TaskId Manager::addTask(std::function<void()> fn, std::chrono::nanoseconds period) {
    auto task = std::make_shared<coil::PeriodicFunction>(std::move(fn), period);
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        m_impl->periodic_tasks.push_back(task);
    }
    m_impl->schedule_periodic(*this, task, period);
    return task.get();
}

void Manager::Impl::schedule_periodic(Manager& manager, const std::shared_ptr<coil::PeriodicFunction>& task,
                                      std::chrono::nanoseconds period) {
    manager.invoke(
        [this, &manager, task, period] {
            if (!task->tick(period)) return schedule_periodic(manager, task, period);
            std::lock_guard<std::recursive_mutex> lock(mutex);
            std::erase(periodic_tasks, task);
        },
        period);
}

void Manager::Impl::run_due_tasks() {
    std::vector<std::function<void()>> due;
    {
        std::lock_guard<std::recursive_mutex> lock(mutex);
        const auto now = std::chrono::steady_clock::now();
        for (auto& task : tasks)
            if (task.first <= now) due.push_back(std::move(task.second));
        std::erase_if(tasks, [&](const auto& task) { return task.first <= now; });
    }
    for (auto& task : due) task();
}

namespace {

// How long the manager has been without components; leaves when rtc.conf says it shall.
class LonelinessWatch {
  public:
    explicit LonelinessWatch(const coil::Properties& config) {
        auto yes = [&](const char* key) { return coil::toBool(config.getProperty(key), "YES", "NO", true); };
        const bool master = coil::toBool(config.getProperty("manager.is_master"), "YES", "NO", false);
        leaves_when_idle_ = !master && yes("manager.shutdown_auto");
        leaves_after_last_ = !master && yes("manager.shutdown_on_nortcs");
        double seconds = 20;
        coil::stringTo(seconds, config.getProperty("manager.auto_shutdown_duration").c_str());
        patience_ = std::chrono::duration<double>(seconds);
    }
    bool had_enough(bool has_components, bool had_components) {
        const auto now = std::chrono::steady_clock::now();
        if (has_components) since_ = now;
        if (!has_components && had_components && leaves_after_last_) return true;
        return leaves_when_idle_ && now - since_ > patience_;
    }

  private:
    bool leaves_when_idle_ = false, leaves_after_last_ = false;
    std::chrono::duration<double> patience_{};
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

} // namespace

void Manager::runManager(bool no_block) {
    if (no_block) return;
    for (int number : {SIGINT, SIGTERM, SIGHUP}) handle_signal(number);
    LonelinessWatch lonely(m_impl->settings());
    while (!end_wanted) {
        sleep_until_rung(100);
        m_impl->run_due_tasks();
        cleanupComponents();
        const bool has_components = !getComponents().empty();
        if (lonely.had_enough(has_components, m_impl->ever_had_components)) break;
    }
    shutdown();
}

bool Manager::endedInOrder() const { return m_impl->ended_in_order; }
bool Manager::restartWanted() const { return m_impl->restart_wanted; }

void Manager::addManagerActionListener(RTM::ManagerActionListener* listener, bool autoclean) {
    m_impl->listeners.manager_.addListener(listener, autoclean);
}
void Manager::removeManagerActionListener(RTM::ManagerActionListener* listener) {
    m_impl->listeners.manager_.removeListener(listener);
}
void Manager::addModuleActionListener(RTM::ModuleActionListener* listener, bool autoclean) {
    m_impl->listeners.module_.addListener(listener, autoclean);
}
void Manager::removeModuleActionListener(RTM::ModuleActionListener* listener) {
    m_impl->listeners.module_.removeListener(listener);
}
void Manager::addRtcLifecycleActionListener(RTM::RtcLifecycleActionListener* listener, bool autoclean) {
    m_impl->listeners.rtclifecycle_.addListener(listener, autoclean);
}
void Manager::removeRtcLifecycleActionListener(RTM::RtcLifecycleActionListener* listener) {
    m_impl->listeners.rtclifecycle_.removeListener(listener);
}
void Manager::addNamingActionListener(RTM::NamingActionListener* listener, bool autoclean) {
    m_impl->listeners.naming_.addListener(listener, autoclean);
}
void Manager::removeNamingActionListener(RTM::NamingActionListener* listener) {
    m_impl->listeners.naming_.removeListener(listener);
}

} // namespace RTC
