// SPDX-License-Identifier: Apache-2.0
// tandem rtm import: turns an installation of OpenRTM-aist into DIR/rtm for tandem run.
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/import/commands.hpp"
#include "apps/tandem/import/import_folder.hpp"
#include "apps/tandem/import/rts_system.hpp"
#include "apps/tandem/output/write_file.hpp"

#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Reports managers for other languages. wasanbon writes their configurations beside the one for C++.
void tell_other_languages(const RtmSetup& setup, ImportReport& report) {
    for (const auto& [file, language] : {std::pair("rtc_py.conf", "Python"), {"rtc_java.conf", "Java"}}) {
        const fs::path conf = setup.conf.parent_path() / file;
        if (!is_there(conf)) continue;
        RtmSetup other;
        other.installation = setup.installation;
        other.conf = conf;
        ImportReport ignored; // that manager does not change, so its differences are irrelevant
        try {
            read_rtc_conf(other, ignored);
        } catch (const std::runtime_error& error) {
            report.add_difference(conf.string(), std::string("manager for ") + language,
                                  std::string("unchanged; its components are unknown: ") + error.what());
        }
        for (const auto& component : other.components)
            report.add_difference(component.origin, component.name + " in " + language,
                                  std::string("stays in OpenRTM-aist's manager for ") + language +
                                      "; start that manager as before; the ports are connected by CORBA");
    }
}

// Shares all RTCs on one link, in their order of creation.
void add_interceptor(RtmSetup& setup, const std::string& link) {
    std::string names;
    for (const auto& component : setup.components) names += (names.empty() ? "" : ";") + component.name;
    setup.modules.emplace_back("InterceptorComp.so");
    setup.components.push_back({"InterceptorComp?link=" + link + (names.empty() ? "" : "&rtc=" + names),
                                "InterceptorComp", "InterceptorComp0", ""});
}

void write_setup(const RtmSetup& setup, ImportReport& report) {
    write_file(setup.output / "rtc.conf", setup.text());
    report.add_file(setup.output / "rtc.conf");
    for (const auto& [from, name] : setup.files) {
        if (fs::exists(setup.output / name)) continue; // two keys can name the same file
        fs::copy_file(from, setup.output / name);
        report.add_file(setup.output / name);
    }
}

} // namespace

int rtm_import(const RtmImportOptions& options) {
    if (!fs::is_directory(options.folder))
        throw std::runtime_error(options.folder.string() +
                                 " is not a folder: expected an installation of OpenRTM-aist");
    require_link_name(options.link);
    RtmSetup setup;
    setup.installation = fs::canonical(options.folder);
    setup.conf = options.conf.empty() ? find_rtc_conf(setup.installation) : fs::canonical(options.conf);
    const fs::path system =
        options.system.empty() ? find_rts_profile(setup.installation) : fs::canonical(options.system);
    if (setup.conf.empty() && system.empty())
        throw std::runtime_error(
            options.folder.string() +
            " has neither an rtc.conf (also looked for: rtcd.conf, conf/rtc_cpp.conf, conf/rtc.conf) nor an "
            "RTSystem profile; name one with --rtc-conf FILE or --system FILE");
    ImportFolder folder(options.output, options.folder, "rtm");
    setup.output = folder.path();
    ImportReport report;
    if (!setup.conf.empty()) {
        read_rtc_conf(setup, report);
        check_modules(setup, report);
        tell_other_languages(setup, report);
    } else {
        setup.settings.push_back({"manager.shutdown_auto", "NO", ""});
        report.add_difference(
            system.string(), "no rtc.conf",
            "RTCs are in no name server and can be reached only from this machine; for OpenRTM-aist's "
            "behaviour, set corba.nameservers: localhost and corba.endpoints: all");
    }
    if (!system.empty()) add_system(setup, read_rts_profile(system), options.activate, report);
    if (setup.components.empty())
        report.add_task((setup.conf.empty() ? system : setup.conf).string(), "no RTC is created here",
                        "add RTCs to manager.components.precreate in " +
                            (setup.output / "rtc.conf").string());
    if (!options.link.empty()) add_interceptor(setup, options.link);
    write_setup(setup, report);
    folder.keep();
    report.print(folder.output(),
                 "host/rtm/DIFFERENCES.md lists the differences common to all rtc.conf files", options.json);
    return 0;
}

} // namespace tandem::command
