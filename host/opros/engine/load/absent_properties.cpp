// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/load/absent_properties.hpp"

#include "host/log/log.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/runtime/component/absent_property.hpp"
#include "host/process/published/notices.hpp"
#include "host/text/nearest_name.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

namespace tandem::engine {
namespace {

std::atomic<bool> logs{false};

/// Never destroyed: a thread of a component may outlive static objects.
struct Notes {
    std::mutex mutex;
    std::set<std::pair<std::string, std::string>> seen; // component, property
    std::vector<AbsentProperty> all;
};
Notes& notes() {
    static auto* all = new Notes;
    return *all;
}

AbsentProperty describe(Component& component, const std::string& name) {
    std::vector<std::string> known;
    for (const auto& property : component.getPropertyMap())
        if (std::find(std::begin(folder_property_names), std::end(folder_property_names), property.first) ==
            std::end(folder_property_names))
            known.push_back(property.first);
    const std::string meant = text::did_you_mean(name, known);
    return {name, !meant.empty(),
            "component " + component.getId() + " asks for property " + name +
                ", which its profile does not have; it gets an empty text" + meant};
}

void note(PropertyInterface& asking, const std::string& name) {
    auto* component = dynamic_cast<Component*>(&asking);
    // In its constructor, a component has neither a name nor properties.
    if (component == nullptr || component->getId().empty()) return;
    const std::lock_guard<std::mutex> lock(notes().mutex);
    if (!notes().seen.insert({component->getId(), name}).second) return;
    notes().all.push_back(describe(*component, name));
    if (!logs) return;
    const AbsentProperty& absent = notes().all.back();
    log::info("{}", absent.line);
    if (absent.misspelt) process::publish_notice(process::NoticeKind::setting, absent.line);
}

} // namespace

void watch_absent_properties(bool log) {
    logs = log;
    set_absent_property_handler(note);
}

std::vector<AbsentProperty> absent_properties() {
    const std::lock_guard<std::mutex> lock(notes().mutex);
    return notes().all;
}

} // namespace tandem::engine
