// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/event/mirror_fsm_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace tandem::adaptor {

MirrorFsmPort::MirrorFsmPort(link::Port peer, link::ChannelWriter& channel, PeerNames names)
    : MirrorEventPortBase(std::move(peer), channel), names_(std::move(names)) {
    for (const auto& [name, signature] : peer_.operations) {
        auto& event = events_[name];
        try {
            wire::Type type = wire::parse_signature(signature);
            event.problem = wire::first_unsupported(type);
            event.argument = wire::is_timed(type) ? wire::without_time(type) : type;
            event.signature = wire::to_signature(event.argument);
        } catch (const wire::SignatureError& error) { // it came from another process
            event.problem = error.what();
        }
    }
}

/// `minutes 'i', open, close`.
std::string MirrorFsmPort::describe_events() const {
    std::vector<std::string> texts;
    for (const auto& [name, event] : events_)
        texts.push_back(!event.problem.empty()    ? fmt::format("{} ({})", name, event.problem)
                        : event.signature.empty() ? name
                                                  : fmt::format("{} '{}'", name, event.signature));
    return fmt::format("{}", fmt::join(texts, ", "));
}

bool MirrorFsmPort::accept(const opros_any& sample) {
    const std::string content_type = opros_any(sample).type();
    const bool is_known = why_not_archived(sample).empty();
    Content content{sample, "?", {}};
    std::vector<std::string> others;
    for (const auto& [name, event] : events_) {
        bool fits = event.problem.empty() && event.signature.empty();
        if (event.problem.empty() && !fits && is_known) try {
                const auto type = type_of(content.sample, event.argument);
                content.signature = wire::to_signature(type);
                fits = wire::is_assignable(type, event.argument);
            } catch (const std::exception&) { // the content does not fit, and its signature stays '?'
            }
        if (fits)
            content.events.insert(name);
        else
            others.push_back(name);
    }
    const std::string text = fmt::format("port '{}': events with content {} are '{}'", peer_.name,
                                         content_type, content.signature);
    std::string error;
    if (content.events.empty())
        error = fmt::format("{}, the peer's EventInPort takes {}; use a content with one of these "
                            "signatures, of a type with save() and load()",
                            text, describe_events());
    else if (!others.empty())
        log::info("{}: they can be {}; not {}, since the peer's EventInPort takes {}", text,
                  fmt::join(content.events, ", "), fmt::join(others, ", "), describe_events());
    set_type_error(std::move(error));
    const std::lock_guard lock(mutex_);
    if (type_error().empty()) contents_[content_type] = std::move(content);
    return type_error().empty();
}

/// Returns the value to encode for the event; nullptr if the event lacks the argument that the peer expects. `id` is the
/// peer's.
const opros_any* MirrorFsmPort::argument_of(Event& event, const std::string& id) const {
    for (const auto& [type, content] : contents_) {
        if (!content.events.contains(id)) continue;
        if (event.getContent().empty()) return &content.sample;
        if (type == event.getContent().type()) return &event.getContent();
    }
    return nullptr;
}

ReturnType MirrorFsmPort::refuse(Event& event) {
    opros_any& content = event.getContent();
    const std::string& id = names_.of(event.getId());
    const std::string remedy =
        events_.contains(id)
            ? ""
            : fmt::format("; AdaptorComp's property 'names.{}' can say which of these it is: {}=EVENT",
                          peer_.name, event.getId());
    channel_.refuse(fmt::format("event '{}' {}; the peer's EventInPort takes {}{}", id,
                                content.empty() ? "without content" : "with content " + content.type(),
                                describe_events(), remedy));
    return OPROS_BAD_INPUT_PARAMETER;
}

ReturnType MirrorFsmPort::push(Event* event) {
    if (!event) return OPROS_BAD_INPUT_PARAMETER;
    const std::lock_guard lock(mutex_);
    const std::string& id = names_.of(event->getId());
    const auto at = events_.find(id);
    const opros_any* content = at == events_.end() ? nullptr : argument_of(*event, id);
    if (!content) return refuse(*event);
    const std::string& signature = at->second.signature;
    const std::uint64_t stamp = wire::wall_clock_stamp();
    try {
        wire::CdrWriter argument(argument_);
        if (!signature.empty()) encode_content(*content, argument);
    } catch (const std::exception&) { // a string with a NUL in it, for instance
        return refuse(*event);
    }
    const bool sent = channel_.write(stamp, [&](wire::CdrWriter& out) {
        out.put_string(id);
        out.put_string(signature);
        out.put(static_cast<std::uint32_t>(argument_.size()));
        out.put_block(argument_.data(), argument_.size(), 1);
    });
    return channel_.is_success(sent) ? OPROS_SUCCESS : OPROS_OUT_OF_RESOURCES;
}

} // namespace tandem::adaptor
