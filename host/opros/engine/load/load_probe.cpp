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
    // Each step releases one reference. The last one unloads the library, so that a crash there is reported under its
    // own name.
    report.begin_stage("its static destructors");
    loaded.library.reset();
    library.reset();
}

} // namespace tandem::engine
