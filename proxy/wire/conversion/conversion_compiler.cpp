// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/conversion/conversion_compiler.hpp"

#include "proxy/wire/number.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace tandem::wire {
namespace {

using Op = ConversionStep::Op;
using Rule = ConversionRequest::Rule;

// Of an array with all its dimensions: signatures come from other processes.
constexpr std::uint64_t max_elements = 1 << 24;

std::string joined(const std::string& outer, const std::string& name) {
    return outer.empty() ? name : outer + "." + name;
}

/// Returns whether `path` is the field `name` or a part of it.
bool is_within(const std::string& path, const std::string& name) {
    return path == name || (path.starts_with(name) && path[name.size()] == '.');
}

ConversionStep step_of(Op op, const Type& from, const Type& to, const std::string& path) {
    ConversionStep step;
    step.op = op;
    step.from = from;
    step.to = to;
    step.path = path;
    return step;
}

bool is_whole_number(Kind kind) {
    return is_number(kind) && kind != Kind::float32 && kind != Kind::float64 && kind != Kind::long_double;
}

/// Returns a structure with this one member, so that it can be compiled as a message.
Type wrapped(const Type& type) {
    if (type.kind == Kind::structure) return type;
    Type message;
    message.children.push_back(type);
    return message;
}

/// Returns the bound that must be checked; 0 if the sender observes it.
std::uint32_t bound_to_check(const Type& from, const Type& to) {
    return from.count != 0 && from.count <= to.count ? 0 : to.count;
}

} // namespace

/// Collects the fields of a structure and of its nested structures. An any is two fields, as it crosses.
void ConversionCompiler::collect(const Type& structure, const Field& outer, std::vector<Field>& fields) {
    for (std::size_t i = 0; i < structure.children.size(); ++i) {
        const Type& member = structure.children[i];
        const std::string number = std::to_string(i + 1);
        Field field{joined(outer.path, member.name.empty() ? number : member.name),
                    joined(outer.position, number), member};
        if (member.kind == Kind::structure)
            collect(member, field, fields);
        else if (member.kind == Kind::any)
            collect(parse_signature("{signature}s{value}ay"), field, fields);
        else
            fields.push_back(std::move(field));
    }
}

const Rule* ConversionCompiler::rule_for(const Field& target) const {
    for (const Rule& rule : request_.rules)
        if (is_within(target.path, rule.target) || is_within(target.position, rule.target)) return &rule;
    return nullptr;
}

/// Returns whether fields are found by their names: if the request adds, moves or drops one, the others have other places.
bool ConversionCompiler::is_by_name() const {
    if (request_.positions) return false;
    return request_.reorder || !request_.dropped.empty() ||
           std::any_of(request_.rules.begin(), request_.rules.end(),
                       [](const Rule& rule) { return rule.constant || !rule.source.empty(); });
}

void ConversionCompiler::compile(const Type& from, const Type& to) {
    frames.emplace_back();
    compile_frame(0, from, to, "");
    std::vector<Field> targets;
    collect(to, {}, targets);
    for (const Rule& rule : request_.rules) {
        const bool top_level = std::any_of(targets.begin(), targets.end(), [&](const Field& target) {
            return rule_for(target) == &rule || is_within(rule.target, target.path);
        });
        if (!top_level) throw ConversionError(fmt::format("the receiver has no field '{}'", rule.target));
    }
}

void ConversionCompiler::compile_frame(std::size_t index, const Type& from, const Type& to,
                                       const std::string& path) {
    std::vector<Field> sources, targets;
    collect(from, {path, path, {}}, sources);
    collect(to, {path, path, {}}, targets);
    if (!is_by_name() && sources.size() != targets.size()) throw_difference(from, to);
    ConversionFrame frame;
    std::vector<int> order;
    if (index == 0)
        for (const auto& refusal : request_.refusals) {
            Field& source = find_named(refusal.source, sources);
            source.used = true;
            frame.steps.push_back(make_refusal(refusal, source));
            order.push_back(static_cast<int>(&source - sources.data()));
        }
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const Rule* rule = rule_for(targets[i]);
        if (rule && rule->constant) {
            frame.steps.push_back(make_constant(targets[i], *rule));
            order.push_back(-1);
            continue;
        }
        const std::size_t source = find_source(targets[i], rule, i, targets.size(), sources);
        sources[source].used = true;
        const double factor = rule ? rule->factor : 1;
        if (rule && rule->count) {
            if (sources[source].type.kind != Kind::sequence || !is_number(targets[i].type.kind))
                throw ConversionError(
                    fmt::format("'{}: count {}' needs a number and a sequence", rule->target, rule->source));
            frame.steps.push_back(
                step_of(Op::length, sources[source].type, targets[i].type, targets[i].path));
            frame.steps.back().factor = factor;
            frame.steps.back().value = sources[source].path;
            changes = true;
        } else {
            frame.steps.push_back(make_step(sources[source].type, targets[i].type, targets[i].path, factor));
        }
        if (rule && !rule->extent.empty()) {
            ConversionStep& step = frame.steps.back();
            if (step.op != Op::sequence && step.op != Op::length)
                throw ConversionError(fmt::format("'{}: from {} first {}' needs a sequence", rule->target,
                                                  rule->source, fmt::join(rule->extent, " ")));
            step.extent = make_extent(*rule, sources);
            changes = true;
        }
        order.push_back(static_cast<int>(source));
    }
    check_unused(sources);
    // If the order of the fields is the same, no place has to be found first.
    const auto looks_elsewhere = [](const ConversionStep& step) {
        return step.op == Op::length || step.op == Op::refused || !step.extent.slots.empty();
    };
    bool in_order = true;
    int expected = 0;
    for (std::size_t i = 0; i < order.size(); ++i)
        if (order[i] >= 0 && (order[i] != expected++ || looks_elsewhere(frame.steps[i]))) in_order = false;
    if (!in_order || expected != static_cast<int>(sources.size())) {
        changes = true;
        frame.first_slot = slots;
        slots += sources.size();
        for (const Field& source : sources) frame.scan.push_back(source.type);
        for (std::size_t i = 0; i < order.size(); ++i)
            if (order[i] >= 0) frame.steps[i].slot = static_cast<int>(frame.first_slot) + order[i];
        for (ConversionStep& step : frame.steps)
            for (std::size_t& slot : step.extent.slots) slot += frame.first_slot;
    }
    for (ConversionStep& step : frame.steps) append(frames[index].steps, std::move(step));
    frames[index].scan = std::move(frame.scan);
    frames[index].first_slot = frame.first_slot;
}

/// Throws ConversionError if there is none.
ConversionCompiler::Field& ConversionCompiler::find_named(const std::string& name,
                                                          std::vector<Field>& sources) {
    const auto at = std::find_if(sources.begin(), sources.end(), [&](const Field& source) {
        return source.path == name || source.position == name;
    });
    if (at == sources.end()) throw ConversionError(fmt::format("the sender has no field '{}'", name));
    return *at;
}

ConversionStep ConversionCompiler::make_refusal(const ConversionRequest::Refusal& refusal,
                                                const Field& source) {
    const Kind kind = source.type.kind;
    if (kind != Kind::string && !is_whole_number(kind))
        throw ConversionError(fmt::format("'refuse {}' needs a string, a whole number or an enumeration, "
                                          "the field is {}",
                                          refusal.source, type_name(source.type)));
    auto step = step_of(Op::refused, source.type, {}, source.path);
    step.words = refusal.words;
    step.unless = refusal.unless;
    return step;
}

ConversionStep::Extent ConversionCompiler::make_extent(const Rule& rule, std::vector<Field>& sources) {
    ConversionStep::Extent extent;
    for (const std::string& name : rule.extent) {
        Field& source = find_named(name, sources);
        if (!is_whole_number(source.type.kind))
            throw ConversionError(fmt::format("'{}: ... {}': {} is {}: expected a whole number", rule.target,
                                              fmt::join(rule.extent, " "), name, type_name(source.type)));
        source.used = true;
        extent.slots.push_back(static_cast<std::size_t>(&source - sources.data()));
        extent.kinds.push_back(source.type.kind);
        extent.text += (extent.text.empty() ? "" : " x ") + name;
    }
    return extent;
}

/// Throws ConversionError if there is none.
std::size_t ConversionCompiler::find_source(const Field& target, const Rule* rule, std::size_t position,
                                            std::size_t count_of_targets,
                                            const std::vector<Field>& sources) const {
    if (!is_by_name()) return position;
    // A rule for a whole structure: uses the source's field at the same place within it.
    std::string wanted = target.path;
    if (rule && !rule->source.empty())
        wanted = rule->source +
                 (is_within(target.path, rule->target) ? target.path.substr(rule->target.size()) : "");
    for (std::size_t i = 0; i < sources.size(); ++i)
        if (sources[i].path == wanted || sources[i].position == wanted) return i;
    if (rule && !rule->source.empty())
        throw ConversionError(fmt::format("the sender has no field '{}'", wanted));
    // If one side has no names, and equally many fields, their order assigns them.
    const auto unnamed = [](const Field& field) { return field.path == field.position; };
    if (count_of_targets == sources.size() &&
        (unnamed(target) || std::all_of(sources.begin(), sources.end(), unnamed)))
        return position;
    throw ConversionError(fmt::format("the receiver's field '{}' ({}) is missing at the sender: ask for "
                                      "'{}: default VALUE' or '{}: from FIELD'",
                                      target.path, type_name(target.type), target.path, target.path));
}

void ConversionCompiler::check_unused(const std::vector<Field>& sources) const {
    for (const Field& source : sources) {
        const bool dropped =
            std::any_of(request_.dropped.begin(), request_.dropped.end(), [&](const auto& name) {
                return is_within(source.path, name) || is_within(source.position, name);
            });
        if (!source.used && !dropped)
            throw ConversionError(fmt::format("the sender's field '{}' ({}) is not used: ask for 'drop {}'",
                                              source.path, type_name(source.type), source.path));
    }
}

ConversionStep ConversionCompiler::make_step(const Type& from, const Type& to, const std::string& path,
                                             double factor) {
    if (is_number(from.kind) && is_number(to.kind)) return make_number(from, to, path, factor);
    if (from.kind == to.kind || is_assignable(from, to)) switch (to.kind) {
        case Kind::string:
        case Kind::wide_string: {
            auto step = step_of(Op::text, from, to, path);
            step.count = bound_to_check(from, to);
            return step;
        }
        case Kind::fixed:
        case Kind::wide_character:
            return step_of(Op::checked, from, to, path);
        case Kind::sequence: {
            auto step = step_of(Op::sequence, from, to, path);
            step.count = bound_to_check(from, to);
            step.frame = add_element(from.children.front(), to.children.front(), path, factor);
            return step;
        }
        case Kind::array: {
            if (from.count != to.count) break;
            auto step = step_of(Op::array, from, to, path);
            step.count = to.count;
            step.frame = add_element(from.children.front(), to.children.front(), path, factor);
            return step;
        }
        case Kind::union_type: {
            if (!is_assignable(from, to)) break;
            auto step = step_of(Op::choice, from, to, path);
            step.frame = frames.size();
            frames.resize(frames.size() + to.children.size() - 1);
            for (std::size_t i = 1; i < to.children.size(); ++i)
                compile_frame(step.frame + i - 1, wrapped(from.children[i]), wrapped(to.children[i]), path);
            return step;
        }
        default:
            break;
        }
    Type sent = from, received = to;
    sent.name = received.name = path;
    throw_difference(wrapped(sent), wrapped(received));
}

ConversionStep ConversionCompiler::make_number(const Type& from, const Type& to, const std::string& path,
                                               double factor) {
    auto step = step_of(Op::number, from, to, path);
    step.factor = factor;
    const bool same = from.kind == to.kind || is_assignable(from, to);
    const bool asked = (request_.widen && can_widen(from.kind, to.kind)) || request_.narrow;
    // A factor changes the values in any case; into a type without fractions it rounds.
    const bool scaled_integer = factor != 1 && is_whole_number(to.kind);
    if ((!same && !asked) || (scaled_integer && !request_.narrow))
        throw ConversionError(
            scaled_integer && same
                ? fmt::format("field '{}' is {}: a factor rounds it; ask for narrow", path, type_name(to))
                : fmt::format("field '{}' is {} at the sender, {} at the receiver: ask for {}", path,
                              type_name(from), type_name(to),
                              can_widen(from.kind, to.kind) ? "widen" : "narrow"));
    if (!same || factor != 1) {
        changes = true;
        return step;
    }
    step.op = to.kind == Kind::enumeration && bound_to_check(from.kind == to.kind ? from : Type{}, to) != 0
                  ? Op::checked
                  : Op::copy;
    return step;
}

ConversionStep ConversionCompiler::make_constant(const Field& target, const Rule& rule) {
    changes = true;
    auto step = step_of(Op::constant, {}, target.type, target.path);
    const std::string& text = *rule.constant;
    const auto refuse = [&] {
        throw ConversionError(fmt::format("'{}: default {}': {} is {}, which has no such value", rule.target,
                                          text, target.path, type_name(target.type)));
    };
    Type element = target.type;
    std::uint64_t elements = 1;
    for (; element.kind == Kind::array && elements <= max_elements; element = Type(element.children.front()))
        elements *= element.count;
    if (primitive_size(element.kind) != 0 && elements <= max_elements) {
        step.to = element;
        step.count = static_cast<std::uint32_t>(elements);
    }
    // A default for a whole structure: its strings and sequences are empty.
    const bool whole = rule.target != target.path && rule.target != target.position;
    if (primitive_size(step.to.kind) != 0) {
        const std::string number = text == "true" ? "1" : text == "false" ? "0" : text;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), step.factor);
        CdrWriter nowhere({});
        if (error != std::errc() || end != number.data() + number.size() ||
            !put_number(step.to.kind, step.factor, nowhere))
            refuse();
    } else if (step.to.kind == Kind::string || step.to.kind == Kind::fixed) {
        if (!whole) step.value = text;
    } else if (whole && (step.to.kind == Kind::sequence || step.to.kind == Kind::wide_string)) {
        step.value.clear();
    } else if ((step.to.kind != Kind::sequence && step.to.kind != Kind::wide_string) ||
               (text != "empty" && !text.empty())) {
        refuse();
    }
    return step;
}

void ConversionCompiler::throw_difference(const Type& from, const Type& to) const {
    throw ConversionError(sends_ ? first_difference(from, to, true) : first_difference(to, from, false));
}

std::size_t ConversionCompiler::add_element(const Type& from, const Type& to, const std::string& path,
                                            double factor) {
    const std::size_t frame = frames.size();
    frames.emplace_back();
    if (to.kind == Kind::structure || from.kind == Kind::structure || to.kind == Kind::any)
        compile_frame(frame, wrapped(from), wrapped(to), path);
    else
        frames[frame].steps = {make_step(from, to, path, factor)};
    return frame;
}

/// Joins consecutive unchanged numbers of one kind into one block.
void ConversionCompiler::append(std::vector<ConversionStep>& steps, ConversionStep step) {
    const bool joins = !steps.empty() && step.op == Op::copy && steps.back().op == Op::copy &&
                       step.slot < 0 && steps.back().slot < 0 && steps.back().from.kind == step.from.kind;
    if (joins)
        steps.back().count += step.count;
    else
        steps.push_back(std::move(step));
}

Conversion::Conversion(const Type& from, const Type& to, const ConversionRequest& request, bool sends) {
    ConversionCompiler compiler(request, sends);
    compiler.compile(from, to);
    identity_ = !compiler.changes && is_assignable(from, to) && !needs_check(from, to);
    frames_ = std::move(compiler.frames);
    slots_.resize(compiler.slots);
}

} // namespace tandem::wire
