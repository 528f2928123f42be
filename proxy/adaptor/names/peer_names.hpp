// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// What the peer calls the methods of one service port, or the events of one event port, where its names are others:
/// AdaptorComp's property `names.PORT`.
class PeerNames {
  public:
    PeerNames() = default;
    /// `text`: `OWN=PEERS, ...`. Throws std::runtime_error, one line, with `property`, when it has another form.
    PeerNames(const std::string& property, const std::string& text);

    /// The same name where no other one is given.
    const std::string& of(const std::string& own) const {
        const auto at = names_.find(own);
        return at == names_.end() ? own : at->second;
    }
    /// Our name of what the peer calls so: the same where no other one is given.
    const std::string& own(const std::string& peers) const {
        for (const auto& [own, name] : names_)
            if (name == peers) return own;
        return peers;
    }
    /// Whether the peer's name of that text is meant for another one of ours.
    bool is_of_another(const std::string& own) const;

  private:
    std::map<std::string, std::string> names_; ///< the peer's, by ours
};

/// What to do about a name that the other component has not: `; A has its types: set property ...`, where `pair` says
/// which two names belong together, `print=echo`. Empty if nothing fits.
std::string suggest_names(const std::string& port, const std::vector<std::string>& fitting,
                          const std::string& pair);

} // namespace tandem::adaptor
