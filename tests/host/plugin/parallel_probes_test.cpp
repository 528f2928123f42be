// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/error.hpp"
#include "host/plugin/parallel_probes.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

using tandem::plugin::Error;
using tandem::plugin::ParallelProbes;

namespace {

const tandem::plugin::ProbeOptions options{OPROS_HOST, std::chrono::seconds(60)};
const char* const crashing = ZOO "/opros/entry_crashes.so";

} // namespace

TEST_CASE("libraries that are tried in parallel each have their own result") {
    ParallelProbes probes(options, "load-opros");
    for (const char* library : {OPROS_PLUGIN, crashing, ZOO "/opros/entry_throws.so"}) probes.begin(library);
    CHECK_THROWS_WITH(probes.finish(ZOO "/opros/entry_throws.so"), Catch::Contains("no camera at port 3"));
    CHECK_THROWS_WITH(probes.finish(crashing), Catch::Contains(" in getComponent()"));
    CHECK_NOTHROW(probes.finish(OPROS_PLUGIN));
}

TEST_CASE("a library whose try was not begun is tried when its result is asked for") {
    ParallelProbes probes(options, "load-opros");
    CHECK_NOTHROW(probes.finish(OPROS_PLUGIN));
    CHECK_THROWS_AS(probes.finish(crashing), Error);
}

TEST_CASE("a library that was rebuilt after its last result is tried again") {
    const Folder folder;
    const auto library = folder.path() / "Component.so";
    std::filesystem::copy_file(OPROS_PLUGIN, library);
    ParallelProbes probes(options, "load-opros");
    probes.begin(library);
    CHECK_NOTHROW(probes.finish(library));
    std::filesystem::copy_file(crashing, library, std::filesystem::copy_options::overwrite_existing);
    CHECK_THROWS_AS(probes.finish(library), Error);
}

TEST_CASE("more tries may be begun than there are processors, and the end waits for those not asked for") {
    ParallelProbes probes(options, "load-opros");
    for (int i = 0; i < 8; ++i) probes.begin(OPROS_PLUGIN, {std::to_string(i)});
    for (int i = 0; i < 4; ++i) CHECK_NOTHROW(probes.finish(OPROS_PLUGIN, {std::to_string(i)}));
}
