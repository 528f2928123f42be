// SPDX-License-Identifier: Apache-2.0
// Properties as text: read, write, print. The format is that of java.util.Properties, as in OpenRTM-aist:
// lines `key: value` or `key = value`, comments with # or !, \ at the end of a line continues it.
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <istream>
#include <ostream>
#include <sstream>

namespace coil {

void Properties::load(std::istream& in) {
    std::string pending;
    while (in) {
        std::string line = eraseHeadBlank(getlinePortable(in));
        if (pending.empty() && (line.empty() || line[0] == '#' || line[0] == '!')) continue;
        pending += line; // `pending`: the lines so far that end with a backslash
        if (!pending.empty() && pending.back() == '\\' && !isEscaped(pending, pending.size() - 1)) {
            pending.pop_back();
            continue;
        }
        // The first separator that is not escaped ends the key.
        std::size_t at = 0;
        while (at < pending.size() &&
               !((pending[at] == ':' || pending[at] == '=') && !isEscaped(pending, at)))
            ++at;
        std::string key = eraseBothEndsBlank(unescape(pending.substr(0, at)));
        std::string value = at < pending.size() ? eraseBothEndsBlank(unescape(pending.substr(at + 1))) : "";
        if (!key.empty()) setProperty(key, value);
        pending.clear();
    }
}

void Properties::list(std::ostream& out) { dump(out, 0); }

void Properties::save(std::ostream& out, const std::string& header) { store(out, header); }

void Properties::store(std::ostream& out, const std::string& header) {
    out << "# " << header << '\n';
    for (const auto& key : propertyNames()) out << key << ": " << escape(getProperty(key)) << '\n';
}

// An indented tree, for people: it cannot be read back.
void Properties::dump(std::ostream& out, std::size_t depth) const {
    for (auto* node : leaf_) {
        out << std::string(2 * depth, ' ') << "- " << node->name_;
        if (node->leaf_.empty()) out << ": " << (node->value_.empty() ? node->default_value_ : node->value_);
        out << '\n';
        node->dump(out, depth + 1);
    }
}

Properties::operator std::vector<std::string>() const {
    std::ostringstream text;
    dump(text, 0);
    return coil::split(text.str(), "\n", true);
}

std::ostream& operator<<(std::ostream& out, const Properties& prop) {
    prop.dump(out, 0);
    return out;
}

} // namespace coil
