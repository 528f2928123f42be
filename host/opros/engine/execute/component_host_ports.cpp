// SPDX-License-Identifier: Apache-2.0
// The part of ComponentHost for the data ports of its component.
#include "host/opros/engine/execute/component_host.hpp"
#include "host/rt/periodic_tick.hpp"

#include <algorithm>

namespace tandem::engine {
namespace {

template <class Ports>
void remove_port(Ports& ports, const std::string& name) {
    std::erase_if(ports, [&](const auto& each) { return each.first == name; });
}

/// Replaces a port of the same name.
template <class Ports, class DataPort>
void set_port(Ports& ports, const std::string& name, DataPort* port) {
    remove_port(ports, name);
    ports.emplace_back(name, port);
}

} // namespace

// Only ports that the component's code has added, because profiles list others as well.
void ComponentHost::configure_data_ports() {
    for (const std::string& name : component_->getPortNames(OPROS_DATA))
        if (Port* port = component_->getPort(name)) add_data_port(name, *port);
}

// setQueue() keeps a queue that the code has chosen.
void ComponentHost::add_data_port(const std::string& name, Port& port) {
    if (auto* output = dynamic_cast<OutputDataPortInterface*>(&port)) {
        const std::lock_guard lock(data_ports_mutex_);
        set_port(output_ports_, name, output);
    }
    auto* input = dynamic_cast<InputDataPortInterface*>(&port);
    if (!input) return;
    for (const DataPortProfile& listed : profile_.data_ports)
        if (listed.name == name && listed.queue) input->setQueue(listed.queue->policy, listed.queue->size);
    // Only an aperiodic component sleeps until inputs arrive. For any other component no source need wake a thread.
    if (profile_.execution_type == ExecutionType::aperiodic) input->setListener(&input_signal_);
    const std::lock_guard lock(data_ports_mutex_);
    set_port(input_ports_, name, input);
}

void ComponentHost::remove_data_port(const std::string& name) {
    const std::lock_guard lock(data_ports_mutex_);
    remove_port(input_ports_, name);
    remove_port(output_ports_, name);
}

void ComponentHost::rehearse_ports() {
    const std::lock_guard lock(data_ports_mutex_);
    const std::int64_t end = rt::monotonic_ns() + rt::rehearsal_limit_ns;
    const auto rehearse = [&](const auto& ports) {
        for (const auto& [name, port] : ports) {
            if (rt::monotonic_ns() > end) return;
            port->rehearse();
        }
    };
    rehearse(input_ports_);
    rehearse(output_ports_);
}

std::size_t ComponentHost::waiting_value_count() const {
    const rt::ShortLock lock(data_ports_mutex_);
    std::size_t sum = 0;
    for (const auto& [name, input] : input_ports_) sum += input->countWaiting();
    return sum;
}

bool ComponentHost::has_polled_sources() const {
    const std::lock_guard lock(data_ports_mutex_);
    return std::any_of(input_ports_.begin(), input_ports_.end(),
                       [](const auto& entry) { return entry.second->hasPolledSources(); });
}

} // namespace tandem::engine
