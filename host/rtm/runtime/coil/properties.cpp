// SPDX-License-Identifier: Apache-2.0
// Properties as a tree of nodes: keys, values, defaults, merging. As text: properties_text.cpp.
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <istream>
#include <ostream>

namespace coil {
namespace {

const std::string empty_string; // what getProperty() refers to when there is no such key

// Splits a key: `a.b\.c` -> {a, b.c}. Keys come from files and from other processes, and recursive functions copy and
// delete the tree. The depth is therefore bounded: the rest of a longer key becomes one name with dots.
std::vector<std::string> split_key(const std::string& key) {
    constexpr std::size_t max_depth = 100;
    std::vector<std::string> path;
    std::string part;
    for (std::size_t i = 0; i < key.size(); ++i) {
        if (key[i] == '\\' && i + 1 < key.size() && key[i + 1] == '.') {
            part += key[++i];
        } else if (key[i] == '.' && path.size() + 1 < max_depth) {
            path.push_back(part);
            part.clear();
        } else {
            part += key[i];
        }
    }
    path.push_back(part);
    return path;
}

// Returns the child node of that name, or NULL.
Properties* find_child(const std::vector<Properties*>& leaf, const std::string& name) {
    for (auto* node : leaf)
        if (name == node->getName()) return node;
    return nullptr;
}

} // namespace

Properties::Properties(const char* key, const char* value, bool set_value)
    : name_(key), value_(value), is_set_(set_value) {}

Properties::Properties(std::map<std::string, std::string>& defaults) {
    for (auto& entry : defaults) setDefault(entry.first, entry.second);
}

Properties::Properties(const char* const defaults[], std::size_t num) { setDefaults(defaults, num); }
Properties::Properties(const char* defaults[], std::size_t num) {
    setDefaults(const_cast<const char* const*>(defaults), num);
}

// A copy is a root: the parent of `other` is not copied.
Properties::Properties(const Properties& other)
    : name_(other.name_), value_(other.value_), default_value_(other.default_value_), is_set_(other.is_set_) {
    for (auto* node : other.leaf_) {
        leaf_.push_back(new Properties(*node));
        leaf_.back()->root_ = this;
    }
}

// Copies name, value, default and children. The place in a tree (the parent) does not change.
Properties& Properties::operator=(const Properties& other) {
    if (this == &other) return *this;
    Properties copy(other); // first: `other` may be a node of this tree, which clear() deletes
    clear();
    name_ = copy.name_;
    value_ = copy.value_;
    default_value_ = copy.default_value_;
    is_set_ = copy.is_set_;
    leaf_.swap(copy.leaf_);
    for (auto* node : leaf_) node->root_ = this;
    return *this;
}

Properties::~Properties() { clear(); }

// Removes the children only. Value and default remain.
void Properties::clear() {
    for (auto* node : leaf_) delete node;
    leaf_.clear();
}

// Returns the node of a dotted key below this node, or NULL.
const Properties* Properties::find(const std::string& key) const {
    const Properties* node = this;
    for (const auto& part : split_key(key)) {
        node = find_child(node->leaf_, part);
        if (node == nullptr) return nullptr;
    }
    return node;
}

Properties* Properties::findNode(const std::string& key) const {
    return key.empty() ? nullptr : const_cast<Properties*>(find(key));
}

// Creates the nodes of a path. No other function does, so reading does not grow the tree.
Properties& Properties::getNode(const std::string& key) {
    if (key.empty()) return *this;
    Properties* node = this;
    for (const auto& part : split_key(key)) {
        Properties* next = find_child(node->leaf_, part);
        if (next == nullptr) {
            next = new Properties(part.c_str());
            next->root_ = node;
            node->leaf_.push_back(next);
        }
        node = next;
    }
    return *node;
}

// Returns false for an empty key, and for a node that exists.
bool Properties::createNode(const std::string& key) {
    if (key.empty() || findNode(key) != nullptr) return false;
    getNode(key);
    return true;
}

// Direct children only, by name: `leaf_name` is not a dotted key.
Properties* Properties::removeNode(const char* leaf_name) {
    for (auto it = leaf_.begin(); it != leaf_.end(); ++it) {
        if ((*it)->name_ != leaf_name) continue;
        Properties* node = *it;
        leaf_.erase(it);
        node->root_ = nullptr;
        return node;
    }
    return nullptr;
}

Properties* Properties::hasKey(const char* key) const { return find_child(leaf_, key); }

// A value that was set counts even if it is empty. It then hides the default.
const std::string& Properties::getProperty(const std::string& key) const {
    const Properties* node = findNode(key);
    if (node == nullptr) return empty_string;
    return node->is_set_ || !node->value_.empty() ? node->value_ : node->default_value_;
}

// An empty value counts as missing here, as in OpenRTM-aist.
const std::string& Properties::getProperty(const std::string& key, const std::string& def) const {
    const std::string& found = getProperty(key);
    return found.empty() ? def : found;
}

const std::string& Properties::operator[](const std::string& key) const { return getProperty(key); }

std::string& Properties::operator[](const std::string& key) {
    Properties& node = getNode(key);
    if (!node.is_set_ && node.value_.empty()) node.value_ = node.default_value_;
    return node.value_;
}

const std::string& Properties::getDefault(const std::string& key) const {
    const Properties* node = findNode(key);
    return node == nullptr ? empty_string : node->default_value_;
}

// Returns the previous value, as java.util.Properties does.
std::string Properties::setProperty(const std::string& key, const std::string& value) {
    Properties& node = getNode(key);
    std::string former = node.value_;
    node.value_ = value;
    node.is_set_ = true;
    return former;
}

std::string Properties::setDefault(const std::string& key, const std::string& value) {
    getNode(key).default_value_ = value;
    return value;
}

// Ends at an empty key, as a component's module spec does, or at a NULL pointer.
void Properties::setDefaults(const char* const defaults[], std::size_t num) {
    for (std::size_t i = 0; i + 1 < num && defaults[i] != nullptr && defaults[i][0] != '\0'; i += 2)
        setDefault(eraseBothEndsBlank(defaults[i]), eraseBothEndsBlank(defaults[i + 1]));
}

// Leaves, and inner nodes with a value or a default of their own.
void Properties::names(const std::string& prefix, std::vector<std::string>& out) const {
    for (auto* node : leaf_) {
        const std::string name = prefix.empty() ? node->name_ : prefix + "." + node->name_;
        if (node->leaf_.empty())
            out.push_back(name);
        else {
            if (!node->value_.empty() || !node->default_value_.empty()) out.push_back(name);
            node->names(name, out);
        }
    }
}

std::vector<std::string> Properties::propertyNames() const {
    std::vector<std::string> out;
    names("", out);
    return out;
}

std::size_t Properties::size() const { return propertyNames().size(); }

// Takes effective values: a default of `prop` becomes a value here.
Properties& Properties::operator<<(const Properties& prop) {
    for (const auto& key : prop.propertyNames()) setProperty(key, prop.getProperty(key));
    return *this;
}

} // namespace coil
