// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// The peer's names of the methods of one service port, or of the events of one event port, where they differ from this
/// side's: AdaptorComp's property `names.PORT`.
class PeerNames {
  public:
    PeerNames() = default;
    /// `text`: `OWN=PEERS, ...`. Throws std::runtime_error, one line, naming `property`, if it has another form.
    PeerNames(const std::string& property, const std::string& text);

    /// Returns the peer's name, which is the same name by default.
    const std::string& of(const std::string& own) const {
        const auto at = names_.find(own);
        return at == names_.end() ? own : at->second;
    }
    /// Returns this side's name for a name of the peer, which is the same name by default.
    const std::string& own(const std::string& peers) const {
        for (const auto& [own, name] : names_)
            if (name == peers) return own;
        return peers;
    }
    /// Returns whether the peer's method or event of this name belongs to another name of this side.
    bool is_of_another(const std::string& own) const;

  private:
    std::map<std::string, std::string> names_; ///< the peer's names, by this side's names
};

/// Returns advice about a name that the other component lacks: `; A has its types: set property ...`, where `pair` says
/// which two names belong together, such as `print=echo`. Empty if nothing fits.
std::string suggest_names(const std::string& port, const std::vector<std::string>& fitting,
                          const std::string& pair);

} // namespace tandem::adaptor
