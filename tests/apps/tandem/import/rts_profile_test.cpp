// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/rts_profile.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tandem::command;

namespace {

// In the form of rtshell: another prefix, service ports, and names of ports without the component's name.
const std::string profile_text =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<r:RtsProfile xmlns:r=\"http://www.openrtp.org/namespaces/rts\" "
    "xmlns:e=\"http://www.openrtp.org/namespaces/rts_ext\" r:id=\"RTSystem:v:s:1\" r:version=\"0.2\">\n"
    "<r:Components r:id=\"RTC:a:b:Mobile Robot:Base:1.0\" r:instanceName=\"Base0\" "
    "r:pathUri=\"localhost:2809/host.host_cxt/Base0.rtc\" r:activeConfigurationSet=\"fast\">\n"
    "<r:ConfigurationSets r:id=\"fast\"><r:ConfigurationData r:name=\"speed\" r:data=\"2, 3\"/>"
    "</r:ConfigurationSets><r:ExecutionContexts r:id=\"0\" r:kind=\"PERIODIC\" r:rate=\"50.0\"/>\n"
    "</r:Components>\n"
    "<r:ServicePortConnectors r:connectorId=\"1\" r:name=\"c\">\n"
    "<r:sourceServicePort r:instanceName=\"Base0\" r:portName=\"drive\"/>\n"
    "<r:targetServicePort r:instanceName=\"Pilot0\" r:portName=\"Pilot0.drive\">"
    "<e:Properties e:name=\"COMPONENT_PATH_ID\" e:value=\"localhost/Pilot0.rtc\"/></r:targetServicePort>\n"
    "<e:Properties e:name=\"port.port_type\" e:value=\"CorbaPort\"/>\n"
    "</r:ServicePortConnectors>\n"
    "<r:DataPortConnectors r:connectorId=\"2\" r:name=\"d\" r:interfaceType=\"CORBA_CDR\" "
    "r:dataflowType=\"Push\" "
    "r:subscriptionType=\"Periodic\" r:pushInterval=\"10.0\">\n"
    "<r:sourceDataPort r:instanceName=\"Base0\" r:portName=\"pose\"/>"
    "<r:targetDataPort r:instanceName=\"Pilot0\" r:portName=\"pose\"/>\n"
    "</r:DataPortConnectors>\n"
    "<r:Activation><r:Targets/></r:Activation>\n"
    "</r:RtsProfile>\n";

} // namespace

TEST_CASE("an RTSystem profile is read with any XML prefixes") {
    const Folder folder;
    const auto profile = read_rts_profile(folder.write("s.xml", profile_text));
    REQUIRE(profile.components.size() == 1);
    const auto& base = profile.components[0];
    CHECK(base.type == "Base");
    CHECK(base.category == "Mobile Robot");
    CHECK(base.path == "localhost:2809/host.host_cxt/Base0.rtc");
    CHECK(base.active_set == "fast");
    CHECK(base.sets.at(0).values.at(0) == std::pair<std::string, std::string>("speed", "2, 3"));
    CHECK(base.rate == 50);
    REQUIRE(profile.connections.size() == 2);
    const auto& data = profile.connections[0];
    CHECK(data.location.text() == (folder.path() / "s.xml").string() + ":11");
    CHECK(data.properties == RtsProperties{{"dataport.interface_type", "corba_cdr"},
                                           {"dataport.dataflow_type", "push"},
                                           {"dataport.subscription_type", "periodic"},
                                           {"dataport.push_rate", "10.0"}});
    const auto& service = profile.connections[1];
    CHECK(service.is_service);
    CHECK(service.source.text() == "Base0.drive");
    CHECK(service.target.text() == "Pilot0.drive");
    CHECK(service.target.path == "localhost/Pilot0.rtc");
    CHECK(profile.sequences.size() == 1);
}

TEST_CASE("a damaged RTSystem profile is read or refused with one line that names the file") {
    const Folder folder;
    std::mt19937 random(4711);
    int refused = 0;
    for (int i = 0; i < 500; ++i) {
        std::string text = profile_text;
        for (int change = 0; change < 1 + i % 5; ++change)
            text[random() % text.size()] = static_cast<char>(random());
        if (i % 3 == 0) text.resize(random() % text.size());
        const auto file = folder.write("s.xml", text);
        try {
            for (const auto& component : read_rts_profile(file).components)
                CHECK(component.name.find_first_of(",&\n") == std::string::npos);
        } catch (const tandem::engine::SetupError& error) {
            const std::string what = error.what();
            CHECK(what.find(file.string()) != std::string::npos);
            CHECK(what.find('\n') == std::string::npos);
            ++refused;
        }
    }
    CHECK(refused > 100);
}
