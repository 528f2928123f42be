// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/port_pairs.hpp"

#include "host/text/join.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

namespace tandem::command {
namespace {

using nlohmann::json;

/// Prefix of the ports that some kinds of OPRoS components have for the engine's tools, such as `opros.symbol`.
constexpr std::string_view engine_prefix = "opros.";

std::string required_text(const json& port, const char* key) { return port[key].get<std::string>(); }

/// Returns the direction of a port's peer.
const char* opposite(const std::string& direction) {
    if (direction == "input") return "output";
    if (direction == "output") return "input";
    return direction == "provided" ? "required" : "provided";
}

std::string normalized_name(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == '_' || c == '-'; }),
               name.end());
    return name;
}

bool same_name(const PortPair& pair) {
    return normalized_name(pair.opros["name"]) == normalized_name(pair.rtc["name"]);
}

/// Chooses the pairs.
class Matcher {
  public:
    explicit Matcher(const std::vector<PortPair>& possible) : possible_(possible) {}

    void match_names() {
        for (const auto& pair : possible_)
            if (pair.error.empty() && same_name(pair) && is_free(pair)) take(pair, "name");
    }
    void match_types() {
        std::vector<const PortPair*> unique;
        for (const auto& pair : possible_)
            if (fits(pair) && count(pair, "opros") == 1 && count(pair, "rtc") == 1) unique.push_back(&pair);
        for (const auto* pair : unique) take(*pair, "type");
    }

    /// Returns the reason why a port has no peer; empty if it has one. `side`: "opros" or "rtc"; `peer`: the other
    /// component.
    std::string why_left_out(const char* side, const std::string& component, const json& port,
                             const std::string& peer) const {
        if (taken(side).count(port["name"]) != 0) return "";
        const std::string what = component + "." + required_text(port, "name") + " (" +
                                 required_text(port, "kind") + " " + required_text(port, "direction") + "): ";
        const std::string other = std::string(side) == "opros" ? "rtc" : "opros";
        std::vector<std::string> fitting;
        std::vector<const PortPair*> peers;
        for (const auto& pair : possible_) {
            if (side_of(pair, side)["name"] != port["name"]) continue;
            if (pair.rtc["name"] != "linkState") peers.push_back(&pair);
            // Reports the reason once, for the OPRoS port of the pair.
            if (same_name(pair) && !pair.error.empty())
                return what + (other == "rtc" ? pair.error
                                              : peer + "." + required_text(pair.opros, "name") +
                                                    " has the same name, but its type does not fit");
            if (fits(pair)) fitting.push_back(side_of(pair, other)["name"]);
        }
        if (fitting.size() > 1)
            return what + "several ports of " + peer + " fit: " + text::join(fitting, ", ") +
                   "; connect the intended one by hand";
        if (fitting.size() == 1)
            return what + peer + "." + fitting.front() +
                   " fits several ports; connect the intended one by hand";
        // The reason of the first candidate says how to make it fit. If it is the only candidate, the
        // reason suffices.
        const bool has_reason = other == "rtc" && !peers.empty() && !peers.front()->error.empty();
        if (has_reason && peers.size() == 1) return what + peers.front()->error;
        return what + "no " + opposite(port["direction"]) + " " + required_text(port, "kind") + " port of " +
               peer + " is left whose type fits" +
               (has_reason ? "; " + required_text(peers.front()->rtc, "name") + ": " + peers.front()->error
                           : "");
    }

    std::vector<PortPair> chosen;

  private:
    static const json& side_of(const PortPair& pair, const std::string& side) {
        return side == "opros" ? pair.opros : pair.rtc;
    }
    const std::set<std::string>& taken(const std::string& side) const {
        return side == "opros" ? opros_ : rtc_;
    }
    bool is_free(const PortPair& pair) const {
        return opros_.count(pair.opros["name"]) == 0 && rtc_.count(pair.rtc["name"]) == 0;
    }
    // linkState belongs to AdaptorComp itself and matches only by name.
    bool fits(const PortPair& pair) const {
        return pair.error.empty() && is_free(pair) && pair.rtc["name"] != "linkState";
    }
    std::ptrdiff_t count(const PortPair& of, const char* side) const {
        return std::count_if(possible_.begin(), possible_.end(), [&](const PortPair& pair) {
            return fits(pair) && side_of(pair, side)["name"] == side_of(of, side)["name"];
        });
    }
    void take(PortPair pair, const char* how) {
        opros_.insert(required_text(pair.opros, "name"));
        rtc_.insert(required_text(pair.rtc, "name"));
        pair.matched = how;
        chosen.push_back(std::move(pair));
    }

    const std::vector<PortPair>& possible_;
    std::set<std::string> opros_, rtc_; ///< names of the ports with a peer
};

} // namespace

PortType port_type(const json& port) {
    if (port["kind"] == "data") return OPROS_DATA;
    return port["kind"] == "event" ? OPROS_EVENT : OPROS_SERVICE;
}

std::vector<PortPair> possible_pairs(const json& opros_ports, const json& rtc_ports) {
    std::vector<PortPair> pairs;
    for (const auto& opros : opros_ports) {
        if (required_text(opros, "name").starts_with(engine_prefix)) continue;
        for (const auto& rtc : rtc_ports)
            if (opros["kind"] == rtc["kind"] && rtc["direction"] == opposite(opros["direction"]))
                pairs.push_back({opros, rtc, "", ""});
    }
    return pairs;
}

PortMatch match_ports(const std::string& opros, const json& opros_ports, const std::string& rtc,
                      const json& rtc_ports, const std::vector<PortPair>& possible) {
    Matcher matcher(possible);
    matcher.match_names();
    matcher.match_types();
    PortMatch match{matcher.chosen, {}};
    const auto add = [&](const std::string& line) {
        if (!line.empty()) match.left_out.push_back(line);
    };
    for (const auto& port : opros_ports)
        if (!required_text(port, "name").starts_with(engine_prefix))
            add(matcher.why_left_out("opros", opros, port, rtc));
    for (const auto& port : rtc_ports)
        if (port["name"] != "linkState") add(matcher.why_left_out("rtc", rtc, port, opros));
    return match;
}

} // namespace tandem::command
