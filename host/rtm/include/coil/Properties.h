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

/// A tree of strings addressed by dotted keys (`a.b.c`; `\\.` is a dot within a name); each node has a value
/// and a default. Not synchronized: its owner guards it.
class Properties {
  public:
    explicit Properties(const char* key = "", const char* value = "", bool set_value = false);
    explicit Properties(std::map<std::string, std::string>& defaults);
    /// key, value, key, value, ... up to an empty key (or `num` strings): the form of a component's spec.
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

    /// Value of a key; its default when no value was set; empty when there is neither.
    const std::string& getProperty(const std::string& key) const;
    /// The same; `def` when that is empty.
    const std::string& getProperty(const std::string& key, const std::string& def) const;
    const std::string& operator[](const std::string& key) const;
    /// Creates the node when needed; the reference stays valid as long as the node.
    std::string& operator[](const std::string& key);
    const std::string& getDefault(const std::string& key) const;

    /// Sets a value and returns the former one.
    std::string setProperty(const std::string& key, const std::string& value);
    std::string setDefault(const std::string& key, const std::string& value);
    void setDefaults(const char* const defaults[], std::size_t num = std::numeric_limits<std::size_t>::max());

    void list(std::ostream& out);
    /// Reads `key: value` or `key = value` lines; `#` and `!` comment, `\` at the end continues.
    void load(std::istream& in);
    void save(std::ostream& out, const std::string& header);
    void store(std::ostream& out, const std::string& header);

    std::vector<std::string> propertyNames() const;
    std::size_t size() const;
    /// NULL when there is none. The node stays this tree's.
    Properties* findNode(const std::string& key) const;
    /// Creates the node when it does not exist.
    Properties& getNode(const std::string& key);
    bool createNode(const std::string& key);
    /// Takes a direct child out of the tree; the caller deletes it. NULL when there is none.
    Properties* removeNode(const char* leaf_name);
    Properties* hasKey(const char* key) const;
    void clear();
    /// Merges: values of `prop` win, what it does not name stays.
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
