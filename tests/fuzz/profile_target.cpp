// SPDX-License-Identifier: Apache-2.0
// Arbitrary bytes as each kind of OPRoS profile: the result is a profile, or one line with the error.
#include "host/opros/engine/profile/start_order.hpp"
#include "host/opros/engine/profile/type_profile.hpp"
#include "host/opros/engine/profile/xml_file.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace tandem::engine;

[[noreturn]] void finding(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

template <class Read>
void check(Read read) {
    try {
        read();
    } catch (const SetupError& error) {
        const std::string_view text = error.what();
        if (text.find('\n') != text.npos) finding("a message of more than one line");
        if (text.find("fuzz.xml") == text.npos) finding("a message that does not name the file");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    check([&] {
        const XmlFile xml("fuzz.xml", {reinterpret_cast<const char*>(data), size});
        check([&] {
            const ComponentProfile profile = read_component_profile(xml);
            if (profile.name.empty() || profile.priority < 0 || profile.priority > 99)
                finding("a component profile that cannot be");
            for (const DataPortProfile& port : profile.data_ports)
                if (port.queue && (port.queue->size < 1 || port.queue->size > max_queue_size))
                    finding("a queue that cannot be");
        });
        check([&] {
            const ApplicationProfile profile = read_application_profile(xml);
            if (start_order(profile).size() != profile.subcomponents.size())
                finding("a start order that lacks a component");
        });
        check([&] { read_composite_profile(xml); });
        check([&] { read_service_type_profile(xml); });
        check([&] { read_data_type_profile(xml); });
    });
    return 0;
}
