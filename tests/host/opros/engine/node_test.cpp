// SPDX-License-Identifier: Apache-2.0
// Applications whose components name the node (machine) that runs them.
#include "host/opros/engine/node/node_adaptor.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "tests/host/opros/engine/running.hpp"

using namespace tandem::engine;
using Catch::Contains;

namespace {

std::string on(const std::string& node) { return "<node_id>" + node + "</node_id>"; }

/// A maker on node `left`, a printer on node `right` whose profile is elsewhere, and a printer on every node.
std::filesystem::path two_nodes(const Folder& folder, const std::string& rest = "") {
    folder.component("Maker", "maker", "<type>periodic</type><period>10</period>");
    folder.component("Printer", "printer");
    return folder.application(
        Folder::sub("Maker", "Maker.xml", on("left")) + Folder::sub("Far", "Elsewhere.xml", on(" right ")) +
            Folder::sub("Both", "Printer.xml"),
        Folder::connect("data", "Maker", "numbers", "Both", "numbers") +
            Folder::connect("data", "Maker", "numbers", "Far", "numbers") +
            Folder::connect("data", "Far", "out", "Both", "numbers"),
        "<coordination><depends source=\"Both\" target=\"Maker\"/><depends source=\"Maker\" "
        "target=\"Far\"/></coordination>" +
            rest);
}

NodePart part_of(const std::filesystem::path& file, const std::string& node = "") {
    return node_part(flatten_composites(read_application_profile(file), {}), node);
}

std::string error_of(const std::filesystem::path& file, const std::string& node = "") {
    try {
        part_of(file, node);
    } catch (const SetupError& error) {
        return error.what();
    }
    return "no error";
}

std::vector<std::string> names(const NodePart& part) {
    std::vector<std::string> names;
    for (const auto& component : part.application.subcomponents) names.push_back(component.name);
    return names;
}

} // namespace

TEST_CASE("a host runs the components of its node and those without a node") {
    const Folder folder;
    auto options = test_options(folder);
    options.node = "left";
    options.strict = true;
    Application application(two_nodes(folder), options);
    CHECK(application.find_component("Maker") != nullptr);
    CHECK(application.find_component("Both") != nullptr);
    CHECK(application.find_component("Far") == nullptr);
    application.start();
    application.step("Maker");
    application.step("Both");
    CHECK(recorder(application, "Both").last_number == 1);
}

TEST_CASE("an application of several nodes is refused until one of them is chosen") {
    const Folder folder;
    const auto file = two_nodes(folder);
    CHECK_THAT(setup_error(file, test_options(folder)),
               Contains("app.xml:2: the components run on several nodes (left, right), expected a choice of "
                        "one: start this machine's part with --node ID, or add "
                        "<local_node_id>ID</local_node_id>"));
    CHECK_THAT(error_of(file, "middle"),
               Contains("app.xml:2: --node is 'middle', expected one of left, right"));
    const auto misspelt = two_nodes(folder, "<local_node_id>lefd</local_node_id>");
    CHECK_THAT(error_of(misspelt), Contains("<local_node_id> is 'lefd', expected one of left, right"));
    CHECK(names(part_of(misspelt, "left")) == std::vector<std::string>{"Maker", "Both"});
    CHECK(part_of(two_nodes(folder, "<local_node_id>left</local_node_id>")).node == "left");
    CHECK_THAT(error_of(file, "right"), Contains("'Elsewhere.xml' of component 'Far' not found"));
}

TEST_CASE("an application with one node or none needs no choice") {
    const Folder folder;
    folder.component("Maker", "maker");
    const auto plain = folder.application(Folder::sub("A", "Maker.xml") + Folder::sub("B", "Maker.xml"));
    CHECK(part_of(plain).node.empty());
    CHECK(part_of(plain).application.subcomponents.size() == 2);
    CHECK_THAT(error_of(plain, "left"),
               Contains("--node is 'left', expected none, because no component has a <node_id>"));
    const auto one =
        folder.application(Folder::sub("A", "Maker.xml", on("left")) + Folder::sub("B", "Maker.xml"));
    CHECK(part_of(one).node == "left");
    CHECK(part_of(one).application.subcomponents.size() == 2);
}

TEST_CASE("a check looks at the part of the chosen node or <local_node_id>, or else at all components") {
    const Folder folder;
    const auto all = local_application(read_application_profile(two_nodes(folder)), {});
    CHECK(all.subcomponents.size() == 3);
    const auto left = two_nodes(folder, "<local_node_id>left</local_node_id>");
    CHECK(local_application(read_application_profile(left), {}).subcomponents.size() == 2);
    const auto right = local_application(read_application_profile(left), {}, "right");
    REQUIRE(right.subcomponents.size() == 2);
    CHECK(right.subcomponents[0].name == "Far");
    CHECK(right.subcomponents[1].name == "Both");
}

TEST_CASE("connections and dependencies of a node's part end at the node") {
    const Folder folder;
    const NodePart part = part_of(two_nodes(folder), "left");
    REQUIRE(part.application.connections.size() == 1);
    CHECK(part.application.connections[0].target.text() == "Both.numbers");
    REQUIRE(part.crossing.size() == 1);
    CHECK(part.crossing[0].target.text() == "Far.numbers");
    CHECK(part.nodes == std::map<std::string, std::string>{{"Maker", "left"}, {"Far", "right"}});
    CHECK(part.application.dependencies.size() == 1);
    REQUIRE(part.notices.size() == 1);
    CHECK_THAT(part.notices[0], Contains("component 'Maker' does not wait for 'Far' of node 'right'"));
}

TEST_CASE("components of a composite are on the composite's node unless they name another one") {
    const Folder folder;
    folder.component("Maker", "maker");
    folder.write("Pair.xml", "<composite_component_profile><name>Pair</name><subcomponents>" +
                                 Folder::sub("A", "Maker.xml") + Folder::sub("B", "Maker.xml", on("right")) +
                                 "</subcomponents></composite_component_profile>");
    const auto file = folder.application(Folder::sub("P", "Pair.xml", on("left")));
    CHECK(names(part_of(file, "left")) == std::vector<std::string>{"P.A"});
    CHECK(names(part_of(file, "right")) == std::vector<std::string>{"P.B"});
}

TEST_CASE("<node_map> gives the addresses of nodes, and a mistake there gets one line") {
    const Folder folder;
    folder.component("Maker", "maker");
    const auto with = [&](const std::string& nodes) {
        return folder.application(Folder::sub("A", "Maker.xml"), "", "<node_map>" + nodes + "</node_map>");
    };
    const auto node = [](const std::string& props) {
        return "<node id=\"left\" protocol=\"tcp\">" + props + "</node>";
    };
    const std::string address = "<prop name=\"ip.addr\"> 10.0.0.1 </prop>";
    const auto nodes =
        read_application_profile(with(node(address) + node(address + "<prop name=\"ip.port\">99</prop>")))
            .nodes;
    REQUIRE(nodes.size() == 2);
    CHECK(nodes[0].id == "left");
    CHECK(nodes[0].host == "10.0.0.1");
    CHECK(nodes[0].port == 2810);
    CHECK(nodes[1].port == 99);
    CHECK_THAT(error_of(with(node(""))),
               Contains("node 'left' has no address: expected <prop name=\"ip.addr\">"));
    CHECK_THAT(error_of(with(node(address + "<prop name=\"ip.port\">70000</prop>"))),
               Contains("ip.port of node 'left' is not a port, expected 1 to 65535"));
    CHECK_THAT(error_of(with("<node/>")), Contains("<node> lacks its attribute id"));
    for (const char* host : {"10.0.0.1,0.0.0.0", "10.0.0.1/24", "[::1]", "a b"})
        CHECK_THAT(error_of(with(node(std::string("<prop name=\"ip.addr\">") + host + "</prop>"))),
                   Contains(std::string("ip.addr of node 'left' is '") + host + "', expected an IP address"));
}

namespace {

const std::string addresses = "<node_map><node id=\"left\"><prop name=\"ip.addr\">10.0.0.1</prop></node>"
                              "<node id=\"right\"><prop name=\"ip.addr\">10.0.0.2</prop></node></node_map>";

/// A maker on node `left` and a printer on node `right`, with connections of all kinds. A printer stands for AdaptorComp.
std::filesystem::path connected_nodes(const Folder& folder, const std::string& rest = addresses) {
    folder.component("Maker", "maker", "<type>periodic</type><period>10</period>",
                     "<property name=\"trouble\">start calls</property>");
    folder.component("Printer", "printer");
    folder.component("AdaptorComp", "printer");
    return folder.application(Folder::sub("M", "Maker.xml", on("left")) +
                                  Folder::sub("P", "Printer.xml", on("right")) +
                                  Folder::sub("Local", "Printer.xml", on("left")),
                              Folder::connect("data", "M", "numbers", "P", "numbers") +
                                  Folder::connect("event", "M", "news", "P", "news") +
                                  Folder::connect("service", "M", "math", "P", "sums"),
                              rest);
}

/// The properties of the AdaptorComp that the part gets.
std::map<std::string, std::string> adaptor_of(NodePart part, const Folder& folder) {
    add_node_adaptor(part, {folder.path()});
    const auto& last = part.application.subcomponents.back();
    if (last.name != "NodeAdaptor") return {};
    return {last.properties.begin(), last.properties.end()};
}

} // namespace

TEST_CASE("a node's part gets an AdaptorComp that shares the components with connections to other nodes") {
    const Folder folder;
    const auto file = connected_nodes(folder);
    CHECK(adaptor_of(part_of(file, "left"), folder) ==
          std::map<std::string, std::string>{
              {"link", "app-left"},
              {"share", "M"},
              {"interfaces", "M.math=sums.sums, M.news=OPRoS::message, M.numbers=OPRoS::message"}});
    CHECK(adaptor_of(part_of(file, "right"), folder) ==
          std::map<std::string, std::string>{
              {"link", "app-right"},
              {"share", "P"},
              {"interfaces", "P.news=OPRoS::message, P.numbers=OPRoS::message"}});
    NodePart shared = part_of(file, "left");
    shared.application.subcomponents.push_back({{}, "Own", "AdaptorComp.xml", {{"share", "Other,M"}}, {}});
    CHECK(adaptor_of(shared, folder).empty());
}

TEST_CASE("a connection with a node without an address is left out, and nothing is shared for it") {
    const Folder folder;
    const NodePart part = part_of(
        connected_nodes(folder,
                        "<node_map><node id=\"left\"><prop name=\"ip.addr\">::1</prop></node></node_map>"),
        "left");
    for (const auto& connection : part.crossing)
        CHECK(connection.error == "node 'right' has no address, expected it in <node_map>");
    CHECK(part.crossing.size() == 3);
    CHECK(adaptor_of(part, folder).empty());
}

TEST_CASE("a name that rtm_host would read as several settings is connected with no other node") {
    const Folder folder;
    folder.component("Maker", "maker");
    const auto file = folder.application(
        Folder::sub("M", "Maker.xml", on("left")) + Folder::sub("P,Q", "Maker.xml", on("right")),
        Folder::connect("data", "M", "numbers", "P,Q", "numbers"), addresses);
    const NodePart part = part_of(file, "left");
    REQUIRE(part.crossing.size() == 1);
    CHECK_THAT(part.crossing[0].error, Contains("'P,Q' is connected with another node"));
}

TEST_CASE("the link of a node has the node's name, however long that of the application is") {
    NodePart part;
    part.application.name = std::string(300, 'a');
    part.node = "left";
    CHECK(node_link(part) == std::string(59, 'a') + "-left");
    part.node = std::string(100, 'n');
    CHECK(node_link(part) == std::string(31, 'a') + "-" + std::string(32, 'n'));
    part.application.name = "-a";
    part.node = "left";
    CHECK(node_link(part) == "_a-left");
}

TEST_CASE("a connection may send the newest value only, and only `new`, in any case, selects that") {
    const Folder folder;
    const auto connection = [&](const std::string& subscription) {
        std::string text = Folder::connect("data", "M", "numbers", "P", "numbers");
        text.insert(text.find(" port_type"), " subscription_type=\"" + subscription + "\"");
        return read_application_profile(
                   folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"), text))
            .connections.at(0);
    };
    CHECK(connection("new").newest_only);
    CHECK(connection("new").error.empty());
    CHECK(connection("New").newest_only);
    CHECK(connection("NEW ").error.empty());
    CHECK_FALSE(connection("").newest_only);
    CHECK(connection("").error.empty());
    CHECK(connection("newest").error ==
          "subscription_type is 'newest', expected new, or no such attribute to send each message");
}

TEST_CASE("a component whose start needs a service of another node starts when the service is there") {
    const Folder folder;
    auto options = test_options(folder, false);
    options.plugin_dirs.push_back(folder.path());
    options.node = "left";
    options.strict = true; // it does not end the host because of M
    Application application(connected_nodes(folder), options);
    application.start();
    CHECK(state(application, "M") == OPROS_CS_ERROR);
    CHECK(application.components_not_running() == std::vector<std::string>{"M"});
    auto* provided = application.find_component("NodeAdaptor")->component().getPort("math");
    REQUIRE(provided != nullptr);
    CHECK(application.directory().connect("NodeAdaptor", *provided, "M", "math") == "");
    CHECK(eventually([&] { return state(application, "M") == OPROS_CS_ACTIVE; }));
    application.stop();
    application.directory().disconnect(*provided);
}
