// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/component_host.hpp"

#include "host/crash/callback_scope.hpp"
#include "host/log/log.hpp"
#include "host/opros/engine/execute/return_code.hpp"
#include "host/opros/engine/load/device_library.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/process/published/inventory.hpp"
#include "host/rt/cycle_lines.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/rehearsal.hpp"

#include <MethodInvokeException.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <thread>
#include <typeinfo>

namespace tandem::engine {
namespace {

// How long a requested transition waits for the current cycle.
constexpr std::chrono::seconds max_cycle_wait{5};
// How long a reader of the properties waits for it.
constexpr std::chrono::seconds max_read_wait{1};

} // namespace

ComponentHost::PublishedState::PublishedState(Component& component, const ComponentProfile& profile)
    : component_(component), published_(component.getId(), process::ComponentState::inactive) {
    process::list_part(this, {"component", component.getId(), profile.name, name_of(profile.execution_type),
                              std::to_string(profile.period.count())});
    component_.addLifecycleListener(this);
}

ComponentHost::PublishedState::~PublishedState() {
    process::unlist_part(this);
    component_.removeLifecycleListener(this);
}

void ComponentHost::PublishedState::set_reason(const std::string& text) {
    const std::lock_guard lock(mutex_);
    reason_ = text;
    publish_reason();
}

void ComponentHost::PublishedState::publish_reason() {
    notice_.reset();
    if (in_error_ && !reason_.empty()) notice_.emplace(process::NoticeKind::component, reason_);
}

// Publishes the reason before the state, so that an observer that sees the state sees the reason, too.
void ComponentHost::PublishedState::stateChanged(LifecycleState state) {
    const std::lock_guard lock(mutex_);
    const bool in_error = state == OPROS_CS_ERROR;
    if (in_error_ != in_error) {
        in_error_ = in_error;
        if (!in_error) reason_.clear();
        publish_reason();
    }
    published_.set(state == OPROS_CS_ACTIVE  ? process::ComponentState::active
                   : state == OPROS_CS_ERROR ? process::ComponentState::error
                                             : process::ComponentState::inactive);
}

ComponentHost::ComponentHost(const Subcomponent& entry, ComponentProfile profile,
                             const ComponentHostOptions& options)
    : name_(entry.name), profile_(std::move(profile)), plugin_dirs_(options.plugin_dirs),
      task_queue_(std::make_shared<TaskQueue>(options.task_queue_capacity, options.task_mode)) {
    const crash::CallbackScope scope(this, name_.c_str(), "its creation", nullptr);
    auto loaded = load_component(profile_, options.plugin_dirs, options.probes.get());
    library_ = std::move(loaded.library);
    component_ = std::move(loaded.component);
    const Component& component = *component_;
    code_ = &typeid(component);
    component_->setId(name_);
    published_state_.emplace(*component_, profile_);
    for (const std::string& line : check_properties(profile_, entry, options.plugin_dirs)) {
        log::warn("{}", line);
        process::publish_notice(process::NoticeKind::setting, line);
    }
    set_component_properties(*component_, profile_, entry.properties, options.plugin_dirs);
}

// stopOnError() changes only an ACTIVE component. If onInitialize or onStart throws, the caller of run_transition() puts the
// component in ERROR.
std::string ComponentHost::enter_error(const char* callback, const std::string& why) {
    std::string text = "component " + name_ + ": " + callback + " threw an exception: " + why;
    if (!is_active()) {
        log::error("{}; the other components continue", text);
        return text;
    }
    log::error("{}; it goes to ERROR, and the other components continue", text);
    error_logged_ = true;
    set_last_error(text);
    try {
        component_->stopOnError();
    } catch (const std::exception& error) {
        log::error("component {}: onError threw an exception as well: {}", name_, error.what());
    } catch (...) { // the user's code may throw any type
        log::error("component {}: onError threw an exception of unknown type as well", name_);
    }
    return text;
}

std::string ComponentHost::run_guarded(const char* callback, const std::function<void()>& code) {
    return guard(callback, code);
}

// For the cycles, which do without a std::function.
template <class Code>
inline std::string ComponentHost::guard(const char* callback, const Code& code) {
    const crash::CallbackScope scope(this, name_.c_str(), callback, code_);
    try {
        code();
        return "";
    } catch (const MethodInvokeException& error) {
        // A service that fails now may work in the next cycle: the component stays ACTIVE, as with the
        // original engine.
        if (failed_calls_.should_log())
            log::warn("component {}: {}: {} ({} so far)", name_, callback, error.what(),
                      failed_calls_.count());
        return "";
    } catch (const std::exception& error) {
        return enter_error(callback, error.what());
    } catch (...) {
        return enter_error(callback, "of unknown type");
    }
}

std::string ComponentHost::run_transition(const char* callback,
                                          ReturnType (LifecycleInterface::*transition)()) {
    ReturnType result = OPROS_CALLEE_ERROR; // remains if the callback throws
    // Clears dlerror(). Device components call dlerror() after dlsym() without clearing it first, and would take an
    // earlier error of other code in this thread for their own.
    dlerror();
    forget_absent_property(); // of an earlier callback in this thread
    std::string why;
    std::string thrown = run_guarded(callback, [&] {
        try {
            result = (component_.get()->*transition)();
            if (result == OPROS_SUCCESS) return;
            const ReturnType code = component_->getErrorInfo();
            why = "it returned code " + describe_code(code) +
                  describe_missing_setting(code, *component_, profile_, plugin_dirs_);
        } catch (const MethodInvokeException& error) {
            // A transition, unlike a cycle, is not repeated, so this counts as a failed callback.
            why = std::string("it made a call that failed: ") + error.what();
        }
    });
    if (!thrown.empty()) { // run_guarded() has already logged it
        set_last_error(thrown);
        return thrown;
    }
    if (result == OPROS_SUCCESS) return "";
    std::string line = fmt::format("component {}: {} failed, {}", name_, callback, why);
    if (!is_known_error(line)) log::error("{}", line);
    set_last_error(line);
    return line;
}

void ComponentHost::initialize() {
    initialized_ = run_transition("onInitialize", &LifecycleInterface::initialize).empty();
    if (initialized_) {
        configure_data_ports();
        return;
    }
    failed_ = true;
    fail_set_up();
}

// A dependency may come later, for example a service of another machine that a tool connects.
void ComponentHost::start() {
    apply_properties();
    if (failed_) return;
    start_failed_ = !run_transition("onStart", &LifecycleInterface::start).empty();
    if (start_failed_) fail_set_up();
}

void ComponentHost::fail_set_up() {
    error_logged_ = true;
    run_transition("onError", &LifecycleInterface::fail);
}

void ComponentHost::stop() {
    if (is_active()) run_transition("onStop", &LifecycleInterface::stop);
}

const char* ComponentHost::current_callback() const {
    const auto running = crash::find_running_callback(this);
    return running ? running->name : nullptr;
}

void ComponentHost::destroy() {
    if (initialized_ && component_->getStatus() != OPROS_CS_DESTROYED)
        run_transition("onDestroy", &LifecycleInterface::destroy);
}

void ComponentHost::destroy_instance() {
    const crash::CallbackScope scope(this, name_.c_str(), "its destructor", code_);
    published_state_.reset();
    component_.reset();
}

void ComponentHost::unload_library() {
    const crash::CallbackScope scope(this, name_.c_str(), "its static destructors", code_);
    library_.reset();
}

// Real components return error codes for passing conditions such as "no input", and the original engine ignores them. A
// code is logged if it differs from the code of the previous cycle, and the component stays ACTIVE.
void ComponentHost::log_return_code(const char* callback, ReturnType code, ReturnType& last) {
    if (code != last && code != OPROS_SUCCESS && code != OPROS_SUCCESS_SYNC &&
        code != OPROS_UNSUPPORTED_METHOD)
        log::warn("component {}: {} returns code {}", name_, callback, describe_code(code));
    last = code;
}

// A component may call stopOnError() itself. Errors that the engine has caused are logged where they happen.
void ComponentHost::log_if_component_stopped_itself() {
    const bool in_error = component_->getStatus() == OPROS_CS_ERROR;
    if (in_error && !error_logged_) {
        const std::string line = "component " + name_ + ": it has gone to ERROR by itself";
        log::error("{}", line);
        set_last_error(line);
    }
    error_logged_ = in_error;
}

std::string ComponentHost::request(ComponentTransition transition) {
    if (failed_)
        return fmt::format("component {} has failed when it was initialized; start the host again", name_);
    if (const auto lock = wait_for_cycle(max_cycle_wait)) return make_transition(transition);
    const char* callback = current_callback();
    return fmt::format("component {} has not returned from {} for {} s", name_,
                       callback ? callback : "a callback", max_cycle_wait.count());
}

bool ComponentHost::start_again() {
    if (component_->getStatus() != OPROS_CS_ERROR) return true; // recovered by another caller
    {
        const std::lock_guard lock(last_error_mutex_);
        if (!last_error_.empty()) known_error_ = last_error_;
    }
    if (!request(TRANSITION_RECOVER).empty() || !request(TRANSITION_START).empty()) return false;
    log::info("component {} has started: the services of the other nodes are available", name_);
    const std::lock_guard lock(last_error_mutex_);
    known_error_.clear(); // the same error is new when it comes later
    return true;
}

/// Waits for a limited time only, because a cycle is the component's code.
std::unique_lock<rt::ShortMutex> ComponentHost::wait_for_cycle(std::chrono::milliseconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    std::unique_lock lock(cycle_mutex_, std::try_to_lock);
    while (!lock && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        lock = std::unique_lock(cycle_mutex_, std::try_to_lock);
    }
    return lock;
}

std::string ComponentHost::configure(const std::string& name, const std::string& value) {
    set_property(name, value);
    if (const auto lock = wait_for_cycle(max_cycle_wait)) {
        apply_properties();
        return "";
    }
    const char* callback = current_callback();
    return fmt::format("component {} has not returned from {} for {} s; {} is set when it returns", name_,
                       callback ? callback : "a callback", max_cycle_wait.count(), name);
}

std::optional<std::map<std::string, std::string>> ComponentHost::properties() {
    const auto lock = wait_for_cycle(max_read_wait);
    if (!lock) return std::nullopt;
    return component_->getPropertyMap();
}

std::string ComponentHost::last_error() const {
    const std::lock_guard lock(last_error_mutex_);
    return last_error_;
}

bool ComponentHost::is_known_error(const std::string& text) const {
    const std::lock_guard lock(last_error_mutex_);
    return known_error_ == text;
}

void ComponentHost::set_last_error(const std::string& text) {
    const std::lock_guard lock(last_error_mutex_);
    last_error_ = text;
    if (published_state_) published_state_->set_reason(text);
}

/// A start or stop that fails leads to ERROR, because it is unknown what has been switched on or off by then.
std::string ComponentHost::make_transition(ComponentTransition transition) {
    const LifecycleState state = component_->getStatus();
    const auto run_or_fail = [this](const char* callback, ReturnType (LifecycleInterface::*function)()) {
        std::string error = run_transition(callback, function);
        error_logged_ = !error.empty();
        if (!error.empty()) run_transition("onError", &LifecycleInterface::fail);
        return error;
    };
    if (state == OPROS_CS_DESTROYED)
        return transition == TRANSITION_DESTROY ? "" : fmt::format("component {} is DESTROYED", name_);
    if (transition == TRANSITION_DESTROY) {
        if (state == OPROS_CS_ACTIVE) run_or_fail("onStop", &LifecycleInterface::stop);
        return run_transition("onDestroy", &LifecycleInterface::destroy);
    }
    if (transition == TRANSITION_RECOVER) {
        if (state == OPROS_CS_ERROR) {
            std::string error = run_transition("onRecover", &LifecycleInterface::recover);
            if (error.empty()) set_last_error("");
            return error;
        }
        return state == OPROS_CS_ACTIVE ? fmt::format("component {} is ACTIVE, not in ERROR", name_) : "";
    }
    if (transition == TRANSITION_STOP)
        return state == OPROS_CS_ACTIVE ? run_or_fail("onStop", &LifecycleInterface::stop)
                                        : stop_inactive(state);
    if (state == OPROS_CS_ERROR) return fmt::format("component {} is in ERROR; reset it first", name_);
    apply_properties();
    std::string error = run_or_fail("onStart", &LifecycleInterface::start);
    input_signal_.arrived(); // an aperiodic component runs one cycle after its start
    return error;
}

/// Calls stop() nevertheless, because AdaptorComp starts by itself after some errors, and a stop withdraws that.
std::string ComponentHost::stop_inactive(LifecycleState state) {
    ReturnType result = OPROS_CALLEE_ERROR; // remains if stop() makes a call that fails
    std::string thrown = run_guarded("onStop", [&] { result = component_->stop(); });
    if (!thrown.empty() || result == OPROS_SUCCESS) return thrown;
    if (result != OPROS_PRECONDITION_NOT_MET)
        return fmt::format("component {}: stop failed, it returned code {}", name_, describe_code(result));
    return state == OPROS_CS_ERROR ? fmt::format("component {} is in ERROR; reset it first", name_) : "";
}

void ComponentHost::set_property(const std::string& name, const std::string& value) {
    const std::lock_guard lock(properties_mutex_);
    new_properties_.emplace_back(name, value);
    has_new_properties_ = true;
}

// Runs in the component's own thread, because the component's properties are not thread-safe.
void ComponentHost::apply_properties() {
    if (!has_new_properties_) return;
    const std::lock_guard lock(properties_mutex_);
    for (const auto& [name, value] : new_properties_) component_->setProperty(name, value);
    new_properties_.clear();
    has_new_properties_ = false;
}

std::string ComponentHost::execute() {
    if (!is_active()) {
        if (!rt::rehearsing()) log_if_component_stopped_itself();
        return "";
    }
    const rt::ShortLock lock(cycle_mutex_);
    if (!is_active()) return ""; // stopped by request while this thread waited
    if (!rt::rehearsing()) apply_properties();
    return guard("onExecute", [this] {
        if (rt::rehearsing()) {
            rt::prefetch(*component_);
            note_lines();
            return rehearse_ports();
        }
        log_return_code("onExecute", component_->onExecute(), last_execute_);
    });
}

/// Reports the lines that execute() and update() use, apart from those of the ports.
void ComponentHost::note_lines() const {
    const auto *const first = reinterpret_cast<const std::byte*>(&name_),
                      *const end = reinterpret_cast<const std::byte*>(&dependents_ + 1);
    rt::note_lines(first, static_cast<std::size_t>(end - first));
    const LifecycleInterface& state = *component_;
    rt::note_lines(&state, sizeof state);
    rt::note_lines(component_.get(), sizeof(void*)); // its virtual functions
}

std::string ComponentHost::update() {
    const rt::ShortLock lock(cycle_mutex_);
    if (!is_active()) return "";
    return guard("onUpdated",
                 [this] { log_return_code("onUpdated", component_->onUpdated(), last_update_); });
}

void ComponentHost::add_dependency(ComponentHost& target) {
    // The mask is always 2^n - 1. Adding one gives the next free bit and overflows to 0 after 64 bits.
    const std::uint64_t bit = dependency_mask_ + 1;
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
    std::uint64_t all_completed = dependency_mask_;
    return completed_dependencies_.compare_exchange_strong(all_completed, 0, std::memory_order_acq_rel);
}

} // namespace tandem::engine
