// SPDX-License-Identifier: Apache-2.0
// A test compares this table with DIFFERENCES.md.
#include "host/rtm/runtime/configuration/openrtm_modules.hpp"
#include <algorithm>
#include <filesystem>

namespace RTC {

const std::vector<OpenRtmModule>& openrtm_modules() {
    static const char* const built_in = "rtm_host contains it";
    static const char* const corba = "data ports offer corba_cdr, data_service, direct and shared_memory";
    static const std::vector<OpenRtmModule> modules{
        {"ComponentObserverConsumer", true, built_in},
        {"FSMComponentObserverConsumer", true, built_in},
        {"ExtendedFsmServiceProvider", true, "tools do not get the structure of a state machine"},
        {"LoggerConsumer", true, built_in},
        {"RTPreemptEC", true,
         "PeriodicExecutionContext has its features, and RTPreemptEC is another name for "
         "PeriodicExecutionContext"},
        {"ArtExecutionContext", false, "choose another exec_cxt.periodic.type"},
        {"LogicalTimeTriggeredEC", false, "choose another exec_cxt.periodic.type"},
        {"FileNameservice", false, "use corba.nameservers, or rtcloc:// names"},
        {"FluentBit", false, "use logger.file_name"},
        {"SSLTransport", false, "set corba.ssl.certificate_authority_file and corba.ssl.key_file"},
        {"HTTPTransport", false, "omniORB has options for that: corba.args"},
        {"OpenSpliceTransport", false, corba},
        {"FastRTPSTransport", false, corba},
        {"ROSTransport", false, corba},
        {"ROS2Transport", false, corba},
        {"SSMTransport", false, corba},
    };
    return modules;
}

const OpenRtmModule* find_openrtm_module(const std::string& file) {
    const std::string name = std::filesystem::path(file).stem().string();
    const auto& all = openrtm_modules();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& module) { return module.name == name; });
    return found == all.end() ? nullptr : &*found;
}

} // namespace RTC
