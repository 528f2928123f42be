// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/component_host.hpp"

#include "host/opros/engine/load/load_component.hpp"
#include "host/rt/periodic_tick.hpp"

#include <MethodInvokeException.h>
#include <algorithm>
#include <dlfcn.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace tandem::engine {
namespace {

// The common ones are decimal, those of device components hexadecimal in their definitions.
std::string code_text(ReturnType code) {
    return code < 1000 ? fmt::format("{}", code) : fmt::format("{:#x}", code);
}

/// Says for the time of its life what the component is busy with.
class CallbackScope {
  public:
    CallbackScope(std::atomic<const char*>& place, const char* what)
        : place_(place), before_(place.exchange(what)) {}
    ~CallbackScope() { place_ = before_; }
    CallbackScope(const CallbackScope&) = delete;
    CallbackScope& operator=(const CallbackScope&) = delete;

  private:
    std::atomic<const char*>& place_;
    const char* before_;
};

} // namespace

ComponentHost::ComponentHost(const Subcomponent& entry, ComponentProfile profile,
                             const std::vector<std::filesystem::path>& dirs,
                             const std::optional<plugin::ProbeOptions>& probe)
    : name_(entry.name), profile_(std::move(profile)) {
    auto loaded = load_component(profile_, dirs, probe);
    library_ = std::move(loaded.library);
    component_ = std::move(loaded.component);
    component_->setId(name_);
    set_component_properties(*component_, profile_, entry.properties, dirs);
}

std::string ComponentHost::enter_error(const char* what, const std::string& why) {
    const std::string text = "component " + name_ + ": " + what + " threw an exception: " + why;
    spdlog::error("{}; it goes to ERROR, the others go on", text);
    error_reported_ = true;
    try {
        component_->stopOnError();
    } catch (const std::exception& error) {
        spdlog::error("component {}: onError threw an exception, too: {}", name_, error.what());
    } catch (...) {
        spdlog::error("component {}: onError threw an exception of unknown type, too", name_);
    }
    return text;
}

std::string ComponentHost::run_guarded(const char* what, const std::function<void()>& code) {
    const CallbackScope busy(current_callback_, what);
    try {
        code();
        return "";
    } catch (const MethodInvokeException& error) {
        // A service that fails now may work in the next cycle: the real engine, too, leaves the component
        // ACTIVE.
        if (failed_calls_.should_log())
            spdlog::warn("component {}: {}: {} ({} so far)", name_, what, error.what(),
                         failed_calls_.count());
        return "";
    } catch (const std::exception& error) {
        return enter_error(what, error.what());
    } catch (...) {
        return enter_error(what, "of unknown type");
    }
}

bool ComponentHost::run_transition(const char* what, ReturnType (LifecycleInterface::*step)()) {
    ReturnType result = OPROS_CALLEE_ERROR; // stays if the callback throws
    dlerror(); // device components ask it after their dlsym(), and would take what others have left there for
               // theirs
    std::string why;
    const std::string thrown = run_guarded(what, [&] {
        try {
            result = (component_.get()->*step)();
            why = "its callback returned code " + code_text(component_->getErrorInfo());
        } catch (const MethodInvokeException& error) {
            why = std::string("its callback made a call that failed: ") + error.what();
        }
    });
    if (thrown.empty() && result == OPROS_SUCCESS) return true;
    if (thrown.empty()) spdlog::error("component {}: {} failed, {}", name_, what, why);
    return false;
}

void ComponentHost::initialize() {
    initialized_ = run_transition("initialize", &LifecycleInterface::initialize);
    if (initialized_)
        configure_input_ports();
    else
        mark_failed();
}

void ComponentHost::start() {
    if (!failed_ && !run_transition("start", &LifecycleInterface::start)) mark_failed();
}

void ComponentHost::mark_failed() {
    failed_ = error_reported_ = true;
    run_transition("fail", &LifecycleInterface::fail);
}

// What the code has chosen counts, and a profile often lists ports that the code does not have.
void ComponentHost::configure_input_ports() {
    for (const std::string& name : component_->getPortNames(OPROS_DATA)) {
        auto* input = dynamic_cast<InputDataPortInterface*>(component_->getPort(name));
        if (!input) continue;
        for (const DataPortProfile& port : profile_.data_ports)
            if (port.name == name && port.queue) input->setQueue(port.queue->policy, port.queue->size);
        input->setListener(&input_signal_);
        input_ports_.push_back(input);
    }
}

std::size_t ComponentHost::queued_value_count() const {
    std::size_t sum = 0;
    for (InputDataPortInterface* input : input_ports_) sum += static_cast<std::size_t>(input->getSize());
    return sum;
}

bool ComponentHost::has_sources() const {
    return std::any_of(input_ports_.begin(), input_ports_.end(),
                       [](const auto* input) { return input->hasSources(); });
}

void ComponentHost::stop() {
    if (is_active()) run_transition("stop", &LifecycleInterface::stop);
}

void ComponentHost::destroy() {
    if (initialized_ && component_->getStatus() != OPROS_CS_DESTROYED)
        run_transition("destroy", &LifecycleInterface::destroy);
}

void ComponentHost::destroy_instance() {
    const CallbackScope busy(current_callback_, "its destructor");
    component_.reset();
}

void ComponentHost::unload_library() {
    const CallbackScope busy(current_callback_, "its static destructors");
    library_.reset();
}

// Real components return errors for passing conditions such as no input, and the real engine takes no notice:
// so it is said once, and the component stays ACTIVE.
void ComponentHost::log_return_code(const char* what, ReturnType code, ReturnType& last) {
    if (code != last && code != OPROS_SUCCESS && code != OPROS_SUCCESS_SYNC &&
        code != OPROS_UNSUPPORTED_METHOD)
        spdlog::warn("component {}: {} returns code {}", name_, what, code_text(code));
    last = code;
}

void ComponentHost::log_own_error() {
    const bool broken = component_->getStatus() == OPROS_CS_ERROR;
    if (broken && !error_reported_) spdlog::error("component {} has gone to ERROR by itself", name_);
    error_reported_ = broken;
}

std::string ComponentHost::execute(bool warm_up) {
    if (!is_active()) {
        if (!warm_up) log_own_error();
        return "";
    }
    return run_guarded("onExecute", [this, warm_up] {
        if (warm_up) return rt::prefetch(*component_);
        log_return_code("onExecute", component_->onExecute(), last_execute_);
    });
}

std::string ComponentHost::update() {
    if (!is_active()) return "";
    return run_guarded("onUpdated",
                       [this] { log_return_code("onUpdated", component_->onUpdated(), last_update_); });
}

void ComponentHost::add_dependency(ComponentHost& target) {
    const std::uint64_t bit = dependency_mask_ + 1; // the lowest bit not yet in use
    if (bit == 0)
        throw SetupError(profile_.location, "component '" + name_ + "' depends on more than 64 others");
    dependency_mask_ |= bit;
    target.dependents_.emplace_back(this, bit);
}

void ComponentHost::notify_dependents() {
    for (auto& [dependent, bit] : dependents_) {
        dependent->completed_dependencies_.fetch_or(bit, std::memory_order_acq_rel);
        dependent->input_signal_.arrived();
    }
}

bool ComponentHost::consume_dependency_cycles() {
    if (dependency_mask_ == 0) return true;
    std::uint64_t all = dependency_mask_;
    return completed_dependencies_.compare_exchange_strong(all, 0, std::memory_order_acq_rel);
}

} // namespace tandem::engine
