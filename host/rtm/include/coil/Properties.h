// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_PROPERTIES_H
#define COIL_PROPERTIES_H
#include <cstddef>
#include <iosfwd>
#include <limits>
#include <map>
#include <rtm/TandemAbi.h>
#include <string>
#include <vector>

namespace coil {

/// A tree of strings addressed by dotted keys (`a.b.c`; `\\.` is a dot within a name). Each node has a value and a
/// default. Not synchronized: its owner guards it.
class Properties {
  public:
    explicit Properties(const char* key = "", const char* value = "", bool set_value = false);
    explicit Properties(std::map<std::string, std::string>& defaults);
    /// Takes key, value, key, value, ... up to an empty key or `num` strings, like a component's spec.
    explicit Properties(const char* const defaults[],
                        std::size_t num = std::numeric_limits<std::size_t>::max());
    explicit Properties(const char* defaults[], std::size_t num = std::numeric_limits<std::size_t>::max());
    Properties(const Properties& other);
    Properties& operator=(const Properties& other);
    virtual ~Properties();

    const char* getName() const { return name_.c_str(); }
    const char* getValue() const { return value_.c_str(); }
    const char* getDefaultValue() const { return default_value_.c_str(); }
    const std::vector<Properties*>& getLeaf() const { return leaf_; }
    const Properties* getRoot() const { return root_; }

    /// Returns the value of a key, its default if no value was set, or an empty string.
    const std::string& getProperty(const std::string& key) const;
    /// Returns the value of a key like getProperty(key), or `def` if that is empty.
    const std::string& getProperty(const std::string& key, const std::string& def) const;
    const std::string& operator[](const std::string& key) const;
    /// Creates the node if needed. The reference is valid as long as the node.
    std::string& operator[](const std::string& key);
    const std::string& getDefault(const std::string& key) const;

    /// Sets a value and returns the previous one.
    std::string setProperty(const std::string& key, const std::string& value);
    std::string setDefault(const std::string& key, const std::string& value);
    void setDefaults(const char* const defaults[], std::size_t num = std::numeric_limits<std::size_t>::max());

    void list(std::ostream& out);
    /// Reads `key: value` or `key = value` lines. `#` and `!` begin a comment; `\` at the end of a line continues it.
    void load(std::istream& in);
    void save(std::ostream& out, const std::string& header);
    void store(std::ostream& out, const std::string& header);

    std::vector<std::string> propertyNames() const;
    std::size_t size() const;
    /// Returns NULL if there is no such node. The node still belongs to this tree.
    Properties* findNode(const std::string& key) const;
    /// Creates the node if it does not exist.
    Properties& getNode(const std::string& key);
    bool createNode(const std::string& key);
    /// Removes a direct child from the tree and returns it; the caller deletes it. Returns NULL if there is none.
    Properties* removeNode(const char* leaf_name);
    Properties* hasKey(const char* key) const;
    void clear();
    /// Merges: values of `prop` take precedence, other values stay.
    Properties& operator<<(const Properties& prop);
    operator std::vector<std::string>() const;

  private:
    const Properties* find(const std::string& key) const;
    void names(const std::string& prefix, std::vector<std::string>& out) const;
    void dump(std::ostream& out, std::size_t depth) const;

    std::string name_;
    std::string value_;
    std::string default_value_;
    bool is_set_ = false;
    Properties* root_ = nullptr;
    std::vector<Properties*> leaf_;

    friend std::ostream& operator<<(std::ostream& out, const Properties& prop);
};

std::ostream& operator<<(std::ostream& out, const Properties& prop);

} // namespace coil
#endif
