// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/project/codemodel.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// https://cmake.org/cmake/help/v3.25/manual/cmake-file-api.7.html
fs::path api_folder(const fs::path& build) { return build / ".cmake" / "api" / "v1"; }

const Json& member(const Json& object, const char* name) {
    static const Json nothing = Json::array();
    const auto found = object.find(name);
    return found == object.end() ? nothing : *found;
}

template <class T>
void add_new(std::vector<T>& all, T value) {
    if (std::find(all.begin(), all.end(), value) == all.end()) all.push_back(std::move(value));
}

// Returns the words of a fragment. CMake quotes those with blanks for the shell.
std::vector<std::string> words_of(const Json& fragment) {
    std::vector<std::string> words;
    bool in_word = false, escaped = false;
    char quote = 0;
    for (const char c : fragment.value("fragment", "")) {
        if (!escaped && quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
            in_word = false;
            continue;
        }
        if (!in_word) words.emplace_back();
        in_word = true;
        if (!escaped && c == '\\')
            escaped = true;
        else if (!escaped && (quote == 0 ? c == '"' || c == '\'' : c == quote))
            quote = quote == 0 ? c : 0;
        else {
            words.back() += c;
            escaped = false;
        }
    }
    return words;
}

// Returns the number of the standard in an option such as -std=gnu++17; 0 for C, C++98 and C++03.
int standard_of(const std::string& option) {
    static const std::map<std::string, int> drafts{{"0x", 11}, {"1y", 14}, {"1z", 17},
                                                   {"2a", 20}, {"2b", 23}, {"2c", 26}};
    const auto at = option.find("++");
    const auto number = at == std::string::npos ? "" : option.substr(at + 2);
    if (const auto draft = drafts.find(number); draft != drafts.end()) return draft->second;
    const int year = std::atoi(number.c_str());
    return year < 90 && year != 3 ? year : 0;
}

// Options that change what the code means or which instructions it uses. The plugin has its own optimization.
bool changes_code(const std::string& option) {
    return (option.rfind("-f", 0) == 0 && to_lower(option) != "-fpic") || option.rfind("-m", 0) == 0 ||
           option == "-pthread";
}

class Reader {
  public:
    explicit Reader(const fs::path& reply) : reply_(reply) {
        for (const auto& file : list_files(reply))
            if (file.filename().string().rfind("index-", 0) == 0) index_ = file; // the last is the newest
    }

    std::vector<ProjectTarget> read() {
        std::vector<ProjectTarget> targets;
        const Json index = load(index_);
        for (const auto& object : member(index, "objects"))
            if (object.value("kind", "") == "codemodel")
                load_targets(load(reply_ / object.value("jsonFile", "")));
        for (const auto& id : order_) {
            const auto& json = targets_[id];
            ProjectTarget target{json.value("name", ""), kind_of(json), {}, {}, {}, {}, {}, {}, 0};
            std::set<std::string> seen{id};
            add(json, json, seen, target);
            add_libraries(json, target);
            if (!target.sources.empty()) targets.push_back(std::move(target));
        }
        return targets;
    }

  private:
    static Json load(const fs::path& file) { return Json::parse(read_text(file)); }

    void load_targets(const Json& codemodel) {
        top_ = member(codemodel, "paths").value("source", "");
        // A generator with one configuration; others would have several.
        for (const auto& configuration : member(codemodel, "configurations"))
            for (const auto& target : member(configuration, "targets")) {
                const std::string id = target.value("id", "");
                if (targets_.emplace(id, load(reply_ / target.value("jsonFile", ""))).second)
                    order_.push_back(id);
            }
    }

    static ProjectTarget::Kind kind_of(const Json& target) {
        const std::string type = target.value("type", "");
        if (type == "SHARED_LIBRARY" || type == "MODULE_LIBRARY") return ProjectTarget::Kind::plugin;
        return type == "EXECUTABLE" ? ProjectTarget::Kind::program : ProjectTarget::Kind::part;
    }

    // Adds what `part` compiles: `whole` itself, or a library of the project that is linked to it.
    void add(const Json& part, const Json& whole, std::set<std::string>& seen, ProjectTarget& target) {
        add_sources(part, target);
        for (const auto& group : member(part, "compileGroups")) add_group(group, target);
        for (const auto& dependency : member(part, "dependencies")) {
            const std::string id = dependency.value("id", "");
            const auto other = targets_.find(id);
            if (other == targets_.end() || !seen.insert(id).second || !is_linked(other->second, whole))
                continue;
            add(other->second, whole, seen, target);
        }
    }

    // CMake also lists targets that only have to be built before.
    static bool is_linked(const Json& library, const Json& whole) {
        const std::string type = library.value("type", ""), file = library.value("nameOnDisk", "");
        if (type == "OBJECT_LIBRARY") return true;
        if (type != "STATIC_LIBRARY" && type != "SHARED_LIBRARY") return false;
        for (const auto& fragment : member(member(whole, "link"), "commandFragments"))
            for (const auto& word : words_of(fragment))
                if (fs::path(word).filename() == file) return true;
        return false;
    }

    // Sources that the project generates while it is built do not exist yet: IDL files are compiled separately.
    void add_sources(const Json& part, ProjectTarget& target) const {
        for (const auto& source : member(part, "sources")) {
            std::error_code ignored;
            const auto file = fs::weakly_canonical(fs::path(top_) / source.value("path", ""), ignored);
            if (is_source(file) && source.contains("compileGroupIndex") && is_file(file))
                add_new(target.sources, file);
        }
    }

    static void add_group(const Json& group, ProjectTarget& target) {
        for (const auto& define : member(group, "defines")) {
            const std::string text = define.value("define", "");
            if (text.find_first_of(";#") == std::string::npos) add_new(target.definitions, text);
        }
        for (const auto& include : member(group, "includes")) {
            std::error_code ignored;
            const fs::path dir = include.value("path", "");
            // Copies of the interface that Tandem provides would hide it.
            if (fs::is_directory(dir, ignored) && !has_upstream_api(dir)) add_new(target.include_dirs, dir);
        }
        if (group.value("language", "") != "CXX") return;
        for (const auto& fragment : member(group, "compileCommandFragments")) add_options(fragment, target);
    }

    static void add_options(const Json& fragment, ProjectTarget& target) {
        const auto words = words_of(fragment);
        for (auto word = words.begin(); word != words.end(); ++word) {
            if (word->find_first_of("\"'\\;$") != std::string::npos) continue;
            if (*word == "-include" && std::next(word) != words.end())
                add_new(target.options, "SHELL:-include " + *++word);
            else if (word->rfind("-std=", 0) == 0)
                target.standard = standard_of(*word);
            else if (changes_code(*word))
                add_new(target.options, *word);
        }
    }

    static void add_libraries(const Json& json, ProjectTarget& target) {
        for (const auto& fragment : member(member(json, "link"), "commandFragments"))
            for (const auto& word : words_of(fragment)) {
                std::error_code ignored;
                if (word.rfind("-L", 0) == 0 && fs::is_directory(word.substr(2), ignored))
                    add_new(target.library_dirs, fs::path(word.substr(2)));
                else if (word.rfind("-l", 0) == 0)
                    add_new(target.libraries, word.substr(2));
                else if (word.rfind('/', 0) == 0 && is_file(word))
                    add_new(target.libraries, word);
            }
    }

    fs::path reply_, index_;
    std::string top_;
    std::map<std::string, Json> targets_;
    std::vector<std::string> order_;
};

} // namespace

void request_codemodel(const fs::path& build) {
    fs::remove_all(api_folder(build));
    fs::create_directories(api_folder(build) / "query" / "codemodel-v2"); // CMake accepts a folder, too
}

std::vector<ProjectTarget> read_codemodel(const fs::path& build) {
    try {
        return Reader(api_folder(build) / "reply").read();
    } catch (const Json::exception&) {
        return {};
    }
}

} // namespace tandem::command
