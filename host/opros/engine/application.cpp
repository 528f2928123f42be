// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/application.hpp"

#include "host/log/log.hpp"
#include "host/opros/engine/load/absent_properties.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/load/load_probe.hpp"
#include "host/opros/engine/node/node_adaptor.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/start_order.hpp"
#include "host/process/bounded_call.hpp"
#include "host/process/published/notices.hpp"
#include "host/text/join.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tandem::engine {
namespace {

// How long a component whose grace time is over may take to return after onStop.
constexpr std::chrono::nanoseconds time_after_stop = std::chrono::seconds(1);

void log_node(const NodePart& part) {
    for (const std::string& notice : part.notices) log::warn("{}", notice);
    for (const ConnectionProfile& connection : part.crossing)
        if (connection.error.empty())
            log::info("connection {} -> {} leaves node '{}': rtm_host makes it", connection.source.text(),
                      connection.target.text(), part.node);
        else
            log::warn("{}: connection {} -> {} leaves node '{}' and is left out: {}",
                      connection.location.text(), connection.source.text(), connection.target.text(),
                      part.node, connection.error);
}

std::vector<ComponentHost*> pointers(const std::vector<std::unique_ptr<ComponentHost>>& components) {
    std::vector<ComponentHost*> all;
    all.reserve(components.size());
    for (const auto& component : components) all.push_back(component.get());
    return all;
}

/// Returns the executor of each component: NULL if it has none, or shares that of a component before it.
std::vector<Executor*> executors_to_end(const std::vector<ComponentHost*>& components,
                                        const std::vector<std::unique_ptr<Executor>>& executors) {
    std::vector<Executor*> found;
    for (const ComponentHost* component : components) {
        const auto its = std::find_if(executors.begin(), executors.end(),
                                      [&](const auto& each) { return each->runs(*component); });
        Executor* const executor = its == executors.end() ? nullptr : its->get();
        const bool is_first = std::find(found.begin(), found.end(), executor) == found.end();
        found.push_back(is_first ? executor : nullptr);
    }
    return found;
}

} // namespace

Application::Application(const ApplicationOptions& options) : options_(options) {
    watch_absent_properties(true);
}

Application::Application(const std::filesystem::path& file, const ApplicationOptions& options)
    : Application(options) {
    NodePart part =
        node_part(flatten_composites(read_application_profile(file), options_.plugin_dirs), options_.node);
    add_node_adaptor(part, options_.plugin_dirs);
    log_node(part);
    for (const ConnectionProfile& connection : part.crossing)
        if (connection.type == OPROS_SERVICE && connection.error.empty() &&
            part.nodes.at(connection.source.component) == part.node)
            users_of_nodes_.insert(connection.source.component);
    const ApplicationProfile& profile = part.application;
    // All libraries are loaded before the first component is initialized, so that a missing library is reported before
    // any hardware moves. Connections come last, because components may add ports in onInitialize.
    load(profile);
    sort_components(profile);
    directory_.set_profile_connections(profile.connections);
    initialize_all();
    connections_->connect_all(profile.connections, components_, options_.strict);
}

Application::~Application() {
    unload();
    if (stuck_components_.empty()) return;
    // A thread that has not returned may still use any of these members, for as long as the process lives.
    static_cast<void>(connections_.release());
    directory_.release_connections();
    for (auto& component : components_) static_cast<void>(component.release());
}

void Application::load(const ApplicationProfile& profile) {
    for (const std::string& line : profile.structure_errors) {
        log::warn("{}", line);
        process::publish_notice(process::NoticeKind::setting, line);
    }
    ComponentHostOptions host_options{options_.plugin_dirs, nullptr, options_.task_queue_capacity,
                                      options_.lockstep_socket.empty() ? TaskQueue::Mode::own_thread
                                                                       : TaskQueue::Mode::in_caller};
    host_options.plugin_dirs.insert(host_options.plugin_dirs.begin(), profile.location.file.parent_path());
    std::vector<ComponentProfile> component_profiles; // an invalid profile ends the set-up
    for (const Subcomponent& entry : profile.subcomponents)
        component_profiles.push_back(read_component_profile(entry.file));
    if (options_.probe) {
        host_options.probes = std::make_shared<plugin::ParallelProbes>(*options_.probe, load_probe_task);
        begin_probes(*host_options.probes, component_profiles, host_options.plugin_dirs);
    }
    std::string first_failure;
    for (std::size_t i = 0; i < profile.subcomponents.size(); ++i) {
        const Subcomponent& entry = profile.subcomponents[i];
        try {
            components_.push_back(
                std::make_unique<ComponentHost>(entry, std::move(component_profiles[i]), host_options));
            libraries_.push_back(components_.back()->library());
        } catch (const SetupError& error) {
            // If the application has only one component, nothing would be left. The error itself is then the better
            // message.
            if (options_.strict || profile.subcomponents.size() == 1) throw;
            if (first_failure.empty()) first_failure = error.what();
            left_out_.push_back(entry.name);
            log::error("{}; component {} is left out, and the other components continue", error.what(),
                       entry.name);
            process::publish_notice(process::NoticeKind::component,
                                    "component " + entry.name + " is left out: " + error.what());
        }
    }
    if (components_.empty()) throw SetupError(first_failure);
}

void Application::sort_components(const ApplicationProfile& profile) {
    for (const std::string& name : start_order(profile))
        if (ComponentHost* component = find_component(name)) start_order_.push_back(component);
    for (const Dependency& dependency : profile.dependencies) {
        ComponentHost* source = find_component(dependency.source);
        ComponentHost* target = find_component(dependency.target);
        if (source && target) source->add_dependency(*target);
    }
}

// Components that show other components come last: the others may add their ports in onInitialize().
void Application::initialize_all() {
    std::vector<ComponentHost*> directory_users;
    for (ComponentHost* component : start_order_) {
        auto* user = dynamic_cast<ComponentDirectoryUser*>(&component->component());
        if (!user) {
            initialize(*component);
            continue;
        }
        user->setComponentDirectory(&directory_);
        directory_users.push_back(component);
    }
    for (ComponentHost* component : directory_users) initialize(*component);
}

void Application::initialize(ComponentHost& component) {
    announce_setup_callback(component, "onInitialize");
    component.initialize();
    require_success_if_strict(component, "initialize");
}

void Application::announce_setup_callback(const ComponentHost& component, const char* callback) const {
    if (options_.on_setup_step) options_.on_setup_step(component.name(), callback);
}

void Application::require_success_if_strict(const ComponentHost& component, const char* transition) const {
    if (options_.strict && component.has_not_started())
        throw SetupError("component '" + component.name() + "' did not " + transition +
                         ", the line above says why; correct that, or leave out --strict to run the other "
                         "components without it");
}

ComponentHost* Application::find_component(const std::string& name) {
    for (const auto& component : components_)
        if (component->name() == name) return component.get();
    return nullptr;
}

std::vector<std::string> Application::components_not_running() const {
    std::vector<std::string> names = left_out_;
    for (const auto& component : components_)
        if (component->has_not_started()) names.push_back(component->name());
    return names;
}

void Application::start() {
    if (started_) return;
    started_ = true;
    for (ComponentHost* component : start_order_) {
        announce_setup_callback(*component, "onStart");
        component->start();
        if (!may_start_late(*component)) require_success_if_strict(*component, "start");
    }
    if (std::all_of(start_order_.begin(), start_order_.end(), [this](const ComponentHost* each) {
            return each->has_not_started() && !may_start_late(*each);
        }))
        throw SetupError("no component has started, the lines above say why");
    directory_.open();
    if (!options_.lockstep_socket.empty()) {
        step_server_ = std::make_shared<rt::StepServer>(options_.lockstep_socket,
                                                        [this](const std::string& name) { step(name); });
        return;
    }
    executors_ = make_executors(start_order_, options_.executors);
    for (auto& executor : executors_) executor->start();
    start_late();
}

/// Its onStart may have called a service of another node that is not available yet.
bool Application::may_start_late(const ComponentHost& component) const {
    return !component.has_failed() && users_of_nodes_.count(component.name()) != 0;
}

void Application::start_late() {
    std::vector<std::string> names;
    for (const ComponentHost* component : start_order_)
        if (component->has_not_started() && may_start_late(*component)) names.push_back(component->name());
    if (names.empty()) return;
    log::info("{} did not start and will be tried again: a service of another node may not be available yet",
              fmt::join(names, ", "));
    late_start_ = std::make_shared<LateStart>(directory_, std::move(names));
}

// Stops one component after the other. The components that started first, usually the hardware, keep running with their
// watchdogs until all components that use them have stopped. So the hardware never keeps following an old command,
// however long a component takes.
void Application::stop() {
    if (!started_) return;
    started_ = false;
    directory_.close(options_.grace); // no component is started again after it has been stopped
    for (const auto& executor : executors_) executor_stats_.push_back(executor->stats());
    end_bounded(step_server_);
    end_bounded(late_start_);
    stop_components({start_order_.rbegin(), start_order_.rend()});
}

// The destructor waits for the current step or attempt. The lambda owns the object, so that the object survives if its
// destructor does not return.
template <class Helper>
void Application::end_bounded(std::shared_ptr<Helper>& helper) {
    if (helper && !process::BoundedCall::returns_within(
                      options_.grace, [owned = std::move(helper)]() mutable { owned.reset(); }, {},
                      process::BoundedCall::WithoutThread::exit))
        for (ComponentHost* component : start_order_)
            if (component->current_callback()) mark_stuck(*component);
}

// Calls stop() even if the executor has not ended, because onStop may make a component return that waits in onExecute.
// The component is stuck only if it does not return soon after that. A second grace time would be longer than the time
// that a supervisor waits for this host.
void Application::stop_components(const std::vector<ComponentHost*>& components) {
    // For each component the end of its cycles, which has a limit already, and onStop.
    std::vector<ComponentHost*> calls;
    for (ComponentHost* component : components) calls.insert(calls.end(), 2, component);
    auto series = bounded_series(calls);
    const auto executors = executors_to_end(components, executors_);
    series.work = [calls, executors, grace = options_.grace](std::size_t i) {
        if (i % 2 != 0)
            calls[i]->stop();
        else if (Executor* const executor = executors[i / 2])
            static_cast<void>(executor->stop_within(grace));
    };
    series.timeout = [this](std::size_t i) { return i % 2 == 0 ? 2 * options_.grace : options_.grace; };
    process::BoundedCall::run_series(series);
    const auto deadline = std::chrono::steady_clock::now() + std::min(options_.grace, time_after_stop);
    for (auto& executor : executors_) {
        if (executor->stop_within(deadline - std::chrono::steady_clock::now())) continue;
        for (ComponentHost* each : executor->components())
            if (each->current_callback()) mark_stuck(*each);
        static_cast<void>(executor.release()); // leaked: its thread uses it as long as the process lives
    }
    // A call of the series that was left behind may still use its executor.
    if (!stuck_components_.empty())
        for (auto& executor : executors_) static_cast<void>(executor.release());
    executors_.clear();
}

/// Returns a series with a call for each component, without its work. It continues without a component after the grace time.
process::BoundedCall::Series Application::bounded_series(const std::vector<ComponentHost*>& components) {
    const auto mark = [this, components](std::size_t i) {
        mark_stuck(*components[i]);
        return true;
    };
    const auto log_slow = [this, components](std::size_t i, std::chrono::seconds time) {
        const char* callback = components[i]->current_callback();
        log::warn("{} of component {} has taken {} s so far; the host waits for it up to {} s",
                  callback ? callback : "a callback", components[i]->name(), time.count(),
                  std::chrono::duration<double>(options_.grace).count());
    };
    return {components.size(),
            {},
            [this](std::size_t) { return options_.grace; },
            mark,
            log_slow,
            process::BoundedCall::WithoutThread::exit};
}

/// Runs one step of ending the components in a separate thread.
void Application::run_bounded(const std::vector<ComponentHost*>& components, void (ComponentHost::*step)()) {
    auto series = bounded_series(components);
    series.work = [components, step](std::size_t i) { (components[i]->*step)(); };
    process::BoundedCall::run_series(series);
}

bool Application::is_stuck(const ComponentHost& component) const {
    return std::find(stuck_components_.begin(), stuck_components_.end(), component.name()) !=
           stuck_components_.end();
}

void Application::mark_stuck(const ComponentHost& component) {
    if (is_stuck(component)) return;
    stuck_components_.push_back(component.name());
    const char* callback = component.current_callback();
    log::error("component {} does not return from {} within {} s; the host exits without it",
               component.name(), callback ? callback : "a callback",
               std::chrono::duration<double>(options_.grace).count());
}

// Interrupts all task queues before it waits for the first, because a task may be in a call to another component.
void Application::stop_task_queues() {
    std::vector<std::shared_ptr<TaskQueue>> queues;
    for (const auto& component : components_) queues.push_back(component->task_queue());
    const auto stop = [queues] {
        for (const auto& queue : queues) queue->interrupt();
        for (const auto& queue : queues) queue->join();
    };
    if (process::BoundedCall::returns_within(options_.grace, stop, {},
                                             process::BoundedCall::WithoutThread::exit))
        return;
    for (ComponentHost* component : start_order_)
        if (component->current_callback()) mark_stuck(*component);
}

void Application::shut_down() {
    if (shut_down_) return;
    shut_down_ = true;
    stop();
    stop_task_queues();
    if (stuck_components_.empty()) {
        // The port of a bridge waits for calls under way. If one does not return, the bridge's onDestroy does not either,
        // and is named.
        static_cast<void>(process::BoundedCall::returns_within(
            options_.grace, [this] { directory_.disconnect_all(); }, {},
            process::BoundedCall::WithoutThread::exit));
        if (!connections_->disconnect_all(options_.grace)) static_cast<void>(connections_.release());
    }
    std::vector<ComponentHost*> returned(start_order_.rbegin(), start_order_.rend());
    std::erase_if(returned, [this](const ComponentHost* component) { return is_stuck(*component); });
    run_bounded(returned, &ComponentHost::destroy);
}

// Nothing is deleted while a component is stuck, because it may still call the others. A stuck destructor also ends the
// unloading: a static destructor that hangs holds the dynamic linker's lock, so every further dlclose() would hang,
// too.
void Application::unload() {
    shut_down();
    if (unloaded_ || !stuck_components_.empty()) return;
    unloaded_ = true;
    run_bounded(pointers(components_), &ComponentHost::destroy_instance);
    if (stuck_components_.empty()) unload_libraries();
}

void Application::unload_libraries() {
    libraries_.clear();
    std::vector<std::filesystem::path> files;
    for (const auto& component : components_) files.push_back(component->library()->path());
    const auto all = pointers(components_);
    auto series = bounded_series(all);
    series.work = [all](std::size_t i) { all[i]->unload_library(); };
    series.on_timeout = [this, all](std::size_t i) {
        mark_stuck(*all[i]);
        return false; // those of the others stay loaded
    };
    process::BoundedCall::run_series(series);
    if (!stuck_components_.empty()) return;
    for (std::size_t i = 0; i < files.size(); ++i)
        if (plugin::Library::is_loaded(files[i])) components_still_loaded_.push_back(components_[i]->name());
}

void Application::step(const std::string& name) {
    ComponentHost* component = find_component(name);
    if (!component) {
        const std::string known =
            text::join(components_, ", ", [](const auto& each) { return each->name(); });
        throw std::runtime_error("no component '" + name + "', the application has " + known);
    }
    std::string thrown = component->execute();
    if (thrown.empty()) thrown = component->update();
    if (!thrown.empty()) throw std::runtime_error(thrown);
}

} // namespace tandem::engine
