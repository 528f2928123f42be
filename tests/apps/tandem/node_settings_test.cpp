// SPDX-License-Identifier: Apache-2.0
// The settings with which `tandem run` starts the rtm_host of a node.
#include "apps/tandem/run/node_settings.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

using tandem::command::node_settings;
using Settings = std::vector<std::string>;

namespace {

std::string node(const std::string& id, const std::string& address, const std::string& port = "") {
    return "<node id=\"" + id + "\"><prop name=\"ip.addr\">" + address + "</prop>" +
           (port.empty() ? "" : "<prop name=\"ip.port\">" + port + "</prop>") + "</node>";
}

/// A on `left`, B on `right`, C on `third`. A sends to B and requires a service of it; C sends to B, and has no other
/// connection.
tandem::engine::NodePart part_of(const Folder& folder, const std::string& id) {
    folder.component("X", "maker");
    const auto sub = [](const std::string& name, const std::string& on) {
        return Folder::sub(name, "X.xml", "<node_id>" + on + "</node_id>");
    };
    std::string newest = Folder::connect("data", "A", "out", "B", "in");
    newest.insert(newest.find(" port_type"), " subscription_type=\"new\"");
    const auto file =
        folder.application(sub("A", "left") + sub("B", "right") + sub("C", "third") + sub("D", "alone"),
                           newest + Folder::connect("service", "A", "need", "B", "give") +
                               Folder::connect("event", "C", "news", "B", "news"),
                           "<node_map>" + node("left", "10.0.0.1") + node("right", "fd00::2", "99") +
                               node("third", "10.0.0.3") + "</node_map>");
    return node_part(flatten_composites(tandem::engine::read_application_profile(file), {}), id);
}

} // namespace

TEST_CASE("the rtm_host of a node listens at its address, and the receiving node makes the connections") {
    const Folder folder;
    CHECK(node_settings(part_of(folder, "right"), {}) ==
          Settings{"corba.endpoints:[fd00::2]:99", "corba.permitted_hosts:10.0.0.1,10.0.0.3",
                   "naming.enable:NO", "manager.shutdown_auto:NO", "manager.shutdown_on_nortcs:NO",
                   "manager.modules.preload:InterceptorComp.so",
                   "manager.components.precreate:InterceptorComp?link=app-right",
                   "manager.components.preconnect:"
                   "rtcloc://[fd00::2]:99/B.in?port=rtcloc://10.0.0.1:2810/A.out&subscription_type=new,"
                   "rtcloc://[fd00::2]:99/B.give?port=rtcloc://10.0.0.1:2810/A.need,"
                   "rtcloc://[fd00::2]:99/B.news?port=rtcloc://10.0.0.3:2810/C.news"});
    const auto sender = node_settings(part_of(folder, "left"), {});
    CHECK(sender.at(0) == "corba.endpoints:10.0.0.1:2810");
    CHECK(sender.at(1) == "corba.permitted_hosts:fd00::2");
    CHECK(sender.back() == "manager.components.precreate:InterceptorComp?link=app-left");
}

TEST_CASE("a node without connections to other nodes needs no rtm_host") {
    const Folder folder;
    CHECK(node_settings(part_of(folder, "alone"), {}).empty());
}

TEST_CASE("settings of a node's own rtc.conf take effect, and its lists are extended") {
    const Folder folder;
    const auto conf =
        folder.write("rtc.conf", "corba.endpoints: 192.168.7.1:2811\ncorba.permitted_hosts: all\n"
                                 "naming.enable: YES\nmanager.shutdown_auto: NO\n"
                                 "manager.modules.preload: Own.so, InterceptorComp.so\n"
                                 "manager.components.precreate: Own\n");
    CHECK(node_settings(part_of(folder, "left"), conf) ==
          Settings{"manager.shutdown_on_nortcs:NO",
                   "manager.components.precreate:Own,InterceptorComp?link=app-left"});
}
