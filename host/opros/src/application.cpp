// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/application.hpp"

#include "host/opros/src/connect.hpp"
#include "host/opros/src/start_order.hpp"

#include <spdlog/spdlog.h>
#include <stdexcept>

namespace tandem::engine {

Application::Application(const ApplicationOptions& options)
    : options_(options),
      workers_(options.lockstep_socket.empty() ? options.workers : 0, options.jobs_per_worker) {}

Application::Application(const std::filesystem::path& file, const ApplicationOptions& options)
    : Application(options) {
    const ApplicationProfile profile = read_application_profile(file);
    load(profile);
    order(profile);
    for (ComponentHost* component : order_) {
        component->initialize();
        demand_success(*component, "initialize");
    }
    connect_all(profile);
}

Application::~Application() {
    stop();
    workers_.stop();
    links_.clear();
    for (auto component = order_.rbegin(); component != order_.rend(); ++component) (*component)->destroy();
}

void Application::load(const ApplicationProfile& profile) {
    for (const Subcomponent& entry : profile.subcomponents) {
        const auto file = find_component_profile(profile, entry, options_.plugin_dirs);
        auto dirs = options_.plugin_dirs;
        dirs.insert(dirs.begin(), profile.place.file.parent_path());
        components_.push_back(
            std::make_unique<ComponentHost>(entry, read_component_profile(file), dirs, options_.probe));
        libraries_.push_back(components_.back()->library());
    }
}

void Application::order(const ApplicationProfile& profile) {
    for (const std::string& name : start_order(profile)) order_.push_back(find(name));
    for (const Dependency& dependency : profile.dependencies)
        find(dependency.source)->depends_on(*find(dependency.target));
}

void Application::connect_all(const ApplicationProfile& profile) {
    for (const Connection& connection : profile.connections) {
        ComponentHost& source = *find(connection.source.component);
        ComponentHost& target = *find(connection.target.component);
        if (source.failed() || target.failed()) {
            spdlog::warn("{}: connection left out, component {} has failed", connection.place.text(),
                         (source.failed() ? source : target).name());
            continue;
        }
        links_.push_back(connect(connection, source, target, workers_, links_.size()));
    }
}

/// A robot without one of its parts is not what the profile describes: that is for its user to allow.
void Application::demand_success(const ComponentHost& component, const char* step) const {
    if (options_.strict && component.failed())
        throw SetupError(
            "component '" + component.name() + "' did not " + step +
            ", the line above says why; mend that, or let the others run without it: --keep-going");
}

ComponentHost* Application::find(const std::string& name) {
    for (const auto& component : components_)
        if (component->name() == name) return component.get();
    return nullptr;
}

void Application::start() {
    if (started_) return;
    started_ = true;
    for (ComponentHost* component : order_) {
        component->start();
        demand_success(*component, "start");
    }
    if (!options_.lockstep_socket.empty()) {
        step_server_ = std::make_unique<rt::StepServer>(options_.lockstep_socket,
                                                        [this](const std::string& name) { step(name); });
        return;
    }
    executors_ = make_executors(order_, options_.executors);
    for (auto& executor : executors_) executor->start();
}

// One after the other: what started first, hardware as a rule, keeps running, its watchdog with it, until all that use
// it have stopped. However long one of them takes, or hangs, nobody drives on old commands meanwhile.
void Application::stop() {
    if (!started_) return;
    started_ = false;
    step_server_.reset();
    for (auto component = order_.rbegin(); component != order_.rend(); ++component) {
        std::erase_if(executors_, [&](const auto& executor) { return executor->runs(**component); });
        (*component)->stop();
    }
}

void Application::step(const std::string& name) {
    ComponentHost* component = find(name);
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
