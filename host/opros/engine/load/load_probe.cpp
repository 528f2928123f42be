// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/load/load_probe.hpp"

#include "host/opros/engine/load/load_component.hpp"

namespace tandem::engine {

void run_load_probe(const plugin::ProbeTask& task, plugin::ProbeReport& report) {
    report.begin_stage("its static constructors");
    auto library = plugin::Library::load(task.library);
    report.begin_stage("getComponent()");
    auto loaded = instantiate_component(task.library);
    report.begin_stage("releaseComponent()");
    loaded.component.reset();
    // Each step ends one reference; the last one unloads, so that its crash has a name of its own.
    report.begin_stage("its static destructors");
    loaded.library.reset();
    library.reset();
}

} // namespace tandem::engine
