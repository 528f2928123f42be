// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/load/probe_component.hpp"

#include "host/opros/engine/load/load_component.hpp"

namespace tandem::engine {

void try_component(const plugin::ProbeTask& task, plugin::ProbeReport& report) {
    report.stage("its static constructors");
    auto library = plugin::Library::load(task.library);
    report.stage("getComponent()");
    auto loaded = open_component(task.library);
    report.stage("releaseComponent()");
    loaded.component.reset();
    report.stage("its static destructors");
    loaded.library.reset();
    library.reset();
}

} // namespace tandem::engine
