// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/application.hpp"

#include "host/opros/engine/connect/make_connection.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/start_order.hpp"
#include "host/process/bounded_call.hpp"

#include <algorithm>
#include <spdlog/spdlog.h>
#include <stdexcept>

namespace tandem::engine {

Application::Application(const ApplicationOptions& options)
    : options_(options),
      workers_(std::make_shared<WorkerPool>(options.jobs_per_worker, options.lockstep_socket.empty())) {}

Application::Application(const std::filesystem::path& file, const ApplicationOptions& options)
    : Application(options) {
    const ApplicationProfile profile =
        flatten_composites(read_application_profile(file), options_.plugin_dirs);
    load(profile);
    sort_components(profile);
    for (ComponentHost* component : order_) {
        report_setup_step(*component, "onInitialize");
        component->initialize();
        require_success_if_strict(*component, "initialize");
    }
    connect_all(profile);
}

Application::~Application() {
    unload();
    if (stuck_components_.empty()) return;
    for (auto& link : connections_) static_cast<void>(link.release());
    for (auto& component : components_) static_cast<void>(component.release());
    static auto* const kept = new std::vector<std::shared_ptr<WorkerPool>>;
    kept->push_back(workers_);
}

void Application::load(const ApplicationProfile& profile) {
    std::vector<std::string> failures;
    for (const Subcomponent& entry : profile.subcomponents) {
        ComponentProfile component = read_component_profile(entry.file);
        auto dirs = options_.plugin_dirs;
        dirs.insert(dirs.begin(), profile.location.file.parent_path());
        try {
            components_.push_back(
                std::make_unique<ComponentHost>(entry, std::move(component), dirs, options_.probe));
            libraries_.push_back(components_.back()->library());
        } catch (const SetupError& error) {
            if (options_.strict || profile.subcomponents.size() == 1) throw;
            failures.push_back(error.what());
            spdlog::error("{}; component {} is left out, the others go on", error.what(), entry.name);
        }
    }
    if (components_.empty()) throw SetupError(failures.front());
}

void Application::sort_components(const ApplicationProfile& profile) {
    for (const std::string& name : start_order(profile))
        if (ComponentHost* component = find_component(name)) order_.push_back(component);
    for (const Dependency& dependency : profile.dependencies) {
        ComponentHost* source = find_component(dependency.source);
        ComponentHost* target = find_component(dependency.target);
        if (source && target) source->add_dependency(*target);
    }
}

void Application::connect_all(const ApplicationProfile& profile) {
    for (const ConnectionProfile& connection : profile.connections) {
        try {
            connect_ports(connection);
        } catch (const SetupError& error) {
            if (options_.strict) throw;
            spdlog::error("{}; this connection is left out, the others are made", error.what());
        }
    }
}

void Application::connect_ports(const ConnectionProfile& connection) {
    if (!connection.error.empty()) throw SetupError(connection.location, connection.error);
    ComponentHost* source = find_component(connection.source.component);
    ComponentHost* target = find_component(connection.target.component);
    const bool from = source && !source->has_failed(), to = target && !target->has_failed();
    if (from && to)
        connections_.push_back(make_connection(connection, *source, *target, *workers_));
    else
        spdlog::warn("{}: connection left out, component {} has failed", connection.location.text(),
                     (from ? connection.target : connection.source).component);
}

void Application::report_setup_step(const ComponentHost& component, const char* call_back) const {
    if (options_.on_setup_step) options_.on_setup_step(component.name(), call_back);
}

void Application::require_success_if_strict(const ComponentHost& component, const char* step) const {
    if (options_.strict && component.has_failed())
        throw SetupError(
            "component '" + component.name() + "' did not " + step +
            ", the line above says why; mend that, or let the others run without it: leave out --strict");
}

ComponentHost* Application::find_component(const std::string& name) {
    for (const auto& component : components_)
        if (component->name() == name) return component.get();
    return nullptr;
}

void Application::start() {
    if (started_) return;
    started_ = true;
    for (ComponentHost* component : order_) {
        report_setup_step(*component, "onStart");
        component->start();
        require_success_if_strict(*component, "start");
    }
    if (std::all_of(order_.begin(), order_.end(),
                    [](const ComponentHost* each) { return each->has_failed(); }))
        throw SetupError("no component has started, the lines above say why");
    if (!options_.lockstep_socket.empty()) {
        step_server_ = std::make_shared<rt::StepServer>(options_.lockstep_socket,
                                                        [this](const std::string& name) { step(name); });
        return;
    }
    executors_ = make_executors(order_, options_.executors);
    for (auto& executor : executors_) executor->start();
}

// One after the other: what started first, hardware as a rule, keeps running, its watchdog with it, until all
// that use it have stopped. However long one of them takes, or hangs, nobody drives on old commands
// meanwhile.
void Application::stop() {
    if (!started_) return;
    started_ = false;
    for (const auto& executor : executors_) executor_stats_.push_back(executor->stats());
    if (step_server_ && !process::BoundedCall::returns_within(
                            options_.grace, [server = std::move(step_server_)]() mutable { server.reset(); }))
        for (ComponentHost* component : order_)
            if (component->current_callback()) mark_stuck(*component);
    for (auto component = order_.rbegin(); component != order_.rend(); ++component)
        stop_component(**component);
}

/// A component that hangs in onExecute may come back when it is told to stop.
void Application::stop_component(ComponentHost& component) {
    const auto mine = std::find_if(executors_.begin(), executors_.end(),
                                   [&](const auto& executor) { return executor->runs(component); });
    const bool alone = mine == executors_.end() || (*mine)->stop_within(options_.grace);
    run_bounded(component, &ComponentHost::stop);
    if (!alone && !(*mine)->stop_within(options_.grace)) {
        for (ComponentHost* each : (*mine)->components())
            if (each->current_callback()) mark_stuck(*each);
        static_cast<void>(mine->release()); // its thread uses it as long as the process lives
    }
    if (mine != executors_.end()) executors_.erase(mine);
}

void Application::run_bounded(ComponentHost& component, void (ComponentHost::*step)()) {
    if (!process::BoundedCall::returns_within(options_.grace, [&component, step] { (component.*step)(); }))
        mark_stuck(component);
}

void Application::mark_stuck(const ComponentHost& component) {
    if (std::find(stuck_components_.begin(), stuck_components_.end(), component.name()) !=
        stuck_components_.end())
        return;
    stuck_components_.push_back(component.name());
    const char* what = component.current_callback();
    spdlog::error("component {} does not come back from {} within {} s; the host ends without it",
                  component.name(), what ? what : "a call-back",
                  std::chrono::duration<double>(options_.grace).count());
}

void Application::stop_workers() {
    if (process::BoundedCall::returns_within(options_.grace, [pool = workers_] { pool->stop(); })) return;
    for (ComponentHost* component : order_)
        if (component->current_callback()) mark_stuck(*component);
}

void Application::shut_down() {
    if (ended_) return;
    ended_ = true;
    stop();
    stop_workers();
    if (stuck_components_.empty()) connections_.clear();
    for (auto component = order_.rbegin(); component != order_.rend(); ++component)
        if (std::find(stuck_components_.begin(), stuck_components_.end(), (*component)->name()) ==
            stuck_components_.end())
            run_bounded(**component, &ComponentHost::destroy);
}

// What hangs may use the others, and a static destructor that hangs keeps the dynamic linker from everybody.
void Application::unload() {
    shut_down();
    if (unloaded_ || !stuck_components_.empty()) return;
    unloaded_ = true;
    for (const auto& component : components_) run_bounded(*component, &ComponentHost::destroy_instance);
    if (!stuck_components_.empty()) return;
    libraries_.clear();
    std::vector<std::filesystem::path> files;
    for (const auto& component : components_) {
        files.push_back(component->library()->path());
        run_bounded(*component, &ComponentHost::unload_library);
        if (!stuck_components_.empty()) return;
    }
    for (std::size_t i = 0; i < files.size(); ++i)
        if (plugin::Library::is_loaded(files[i])) components_still_loaded_.push_back(components_[i]->name());
}

void Application::step(const std::string& name) {
    ComponentHost* component = find_component(name);
    if (!component) {
        std::string known;
        for (const auto& each : components_) known += (known.empty() ? "" : ", ") + each->name();
        throw std::runtime_error("no component '" + name + "', the application has " + known);
    }
    std::string thrown = component->execute();
    if (thrown.empty()) thrown = component->update();
    if (!thrown.empty()) throw std::runtime_error(thrown);
}

} // namespace tandem::engine
