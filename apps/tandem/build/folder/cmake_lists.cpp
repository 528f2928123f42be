// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/cmake_lists.hpp"

#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/cmake_condition.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Commands = std::vector<CMakeCommand>;

// Returns NAME or NAME=VALUE from an argument of add_definitions(). Removes the escapes of a string literal's
// quotes for CMake and the shell. Returns "" for another option.
std::string to_definition(const std::string& word) {
    const auto unescaped = [](std::string text) {
        text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == '"' || c == '\\'; }),
                   text.end());
        return text;
    };
    const auto equals = word.find('=');
    const std::string name = unescaped(word.substr(0, equals));
    if (name.rfind("-D", 0) != 0 || name.size() == 2) return "";
    if (equals == std::string::npos) return name.substr(2);
    const std::string value = word.substr(equals + 1);
    const bool literal = value.rfind('"', 0) == 0 || value.rfind("\\\"", 0) == 0;
    return name.substr(2) + "=" + (literal ? '"' + unescaped(value) + '"' : unescaped(value));
}

// A macro or function of a project.
struct Macro {
    Words parameters;
    Commands body;
};

class Interpreter {
  public:
    void read(const fs::path& folder) {
        result.targets.clear(); // those of the folders above
        variables_["CMAKE_CURRENT_SOURCE_DIR"] = variables_["PROJECT_SOURCE_DIR"] = {folder.string()};
        read_file(folder / "CMakeLists.txt");
    }

    CMakeLists result;

  private:
    void read_file(const fs::path& file) {
        if (depth_ > max_depth) return;
        ++depth_;
        const auto commands = read_commands(file);
        variables_["CMAKE_CURRENT_LIST_DIR"] = {file.parent_path().string()};
        run(commands, 0, commands.size());
        --depth_;
    }

    // Returns the index of the command that closes the block.
    static std::size_t find_end(const Commands& all, std::size_t begin, std::size_t end) {
        int depth = 0;
        for (auto at = begin; at < end; ++at) {
            depth += all[at].name == all[begin].name ? 1 : all[at].name == "end" + all[begin].name ? -1 : 0;
            if (depth == 0) return at;
        }
        return end;
    }

    void run(const Commands& all, std::size_t begin, std::size_t end) {
        if (nesting_ > max_nesting) return;
        ++nesting_;
        for (auto at = begin; at < end && work_ <= max_work; ++at) {
            work_ += 1 + all[at].text.size();
            const auto& name = all[at].name;
            const bool is_block =
                name == "foreach" || name == "while" || name == "function" || name == "macro";
            const auto last = is_block ? find_end(all, at, end) : at;
            if (name == "if")
                at = run_branches(all, at, end);
            else if (name == "foreach")
                run_loop(all, at, last);
            else if (name == "function" || name == "macro")
                define(all, at, last);
            else if (!is_block)
                run_command(all[at]);
            if (is_block) at = last;
        }
        --nesting_;
    }

    // Runs the branches that are taken or may be taken. Returns the index of endif().
    std::size_t run_branches(const Commands& all, std::size_t begin, std::size_t end) {
        bool done = false;
        const bool was_certain = certain_;
        auto at = begin;
        while (at < end && all[at].name != "endif") {
            work_ += all[at].text.size(); // of elseif()
            const auto truth =
                all[at].name == "else" ? Truth::yes : evaluate_condition(all[at].text, variables_);
            const auto next = find_branch_end(all, at, end);
            if (!done && truth != Truth::no) {
                certain_ = certain_ && truth == Truth::yes;
                run(all, at + 1, next);
            }
            done = done || truth == Truth::yes;
            at = next;
        }
        certain_ = was_certain;
        return at;
    }

    static std::size_t find_branch_end(const Commands& all, std::size_t begin, std::size_t end) {
        int depth = 0;
        for (auto at = begin + 1; at < end; ++at) {
            if (depth == 0 && (all[at].name == "elseif" || all[at].name == "else" || all[at].name == "endif"))
                return at;
            depth += all[at].name == "if" ? 1 : all[at].name == "endif" ? -1 : 0;
        }
        return end;
    }

    void run_loop(const Commands& all, std::size_t begin, std::size_t end) {
        Words words = expand(split(all[begin].text), variables_);
        if (words.empty()) return;
        const auto name = words[0];
        Words items;
        bool lists = false;
        for (auto word = words.begin() + 1; word != words.end(); ++word) {
            if (*word == "IN" || *word == "LISTS" || *word == "ITEMS")
                lists = *word == "LISTS";
            else if (!lists)
                items.push_back(*word);
            else if (const auto known = variables_.find(*word); known != variables_.end())
                items.insert(items.end(), known->second.begin(), known->second.end());
        }
        for (const auto& item : items) {
            if (++work_ > max_work) return;
            variables_[name] = {item};
            run(all, begin + 1, end);
        }
    }

    void define(const Commands& all, std::size_t begin, std::size_t end) {
        const Words words = split(all[begin].text);
        if (words.empty()) return;
        const auto at = [&](std::size_t index) { return all.begin() + static_cast<std::ptrdiff_t>(index); };
        macros_[to_lower(words[0])] = {{words.begin() + 1, words.end()},
                                       {at(std::min(begin + 1, end)), at(end)}};
    }

    void call(const Macro& macro, const Words& arguments) {
        if (depth_ > max_depth) return;
        ++depth_;
        const auto named = std::min(macro.parameters.size(), arguments.size());
        for (std::size_t i = 0; i < named; ++i) variables_[macro.parameters[i]] = {arguments[i]};
        for (std::size_t i = 0; i < arguments.size(); ++i)
            variables_["ARGV" + std::to_string(i)] = {arguments[i]};
        variables_["ARGV"] = arguments;
        variables_["ARGN"] = Words(arguments.begin() + static_cast<std::ptrdiff_t>(named), arguments.end());
        run(macro.body, 0, macro.body.size());
        --depth_;
    }

    void run_command(const CMakeCommand& command) {
        const Words words = expand(split(command.text), variables_);
        for (const auto& word : words) work_ += word.size();
        if (work_ > max_work) return; // macros, loops and lists can multiply
        if (command.name == "add_definitions" || command.name == "add_compile_definitions")
            add_definitions(command);
        else if (const auto macro = macros_.find(command.name); macro != macros_.end())
            call(Macro(macro->second), words); // a copy, because the body may redefine it
        else if (!words.empty())
            run_command(command.name, words);
    }

    void run_command(const std::string& name, const Words& words) {
        if (name == "project")
            variables_["PROJECT_NAME"] = {words[0]};
        else if (name == "set" || name == "option")
            set(name, words);
        else if (name == "list" && words.size() > 1 && words[0] == "APPEND")
            variables_[words[1]].insert(variables_[words[1]].end(), words.begin() + 2, words.end());
        else if (name == "list" && words.size() > 1 && words[0] == "REMOVE_ITEM")
            for (auto word = words.begin() + 2; word != words.end(); ++word)
                std::erase(variables_[words[1]], *word);
        else if (name == "include")
            include(words[0]);
        else if (words.size() > 1 &&
                 (name == "aux_source_directory" || (name == "file" && words[0].rfind("GLOB", 0) == 0)))
            variables_[words[1]] = {unknown_files};
        else if (name.ends_with("add_library") || name.ends_with("add_executable") ||
                 is_list_of_own_macro(name))
            result.targets.push_back({words, !name.ends_with("library")});
    }

    // A macro from a file that is not here, such as add_rtc_library().
    static bool is_list_of_own_macro(const std::string& name) {
        return name.starts_with("add_") && (name.ends_with("_library") || name.ends_with("_executable"));
    }

    void set(const std::string& command, const Words& words) {
        auto end = std::find(words.begin() + 1, words.end(), "CACHE");
        if (end == words.end()) end = std::find(words.begin() + 1, words.end(), "PARENT_SCOPE");
        const bool keeps = !certain_ || command == "option" || (end != words.end() && *end == "CACHE");
        if (keeps && variables_.count(words[0]) != 0) return;
        if (command == "option") // the last word may belong to the help text
            variables_[words[0]] = {to_lower(words.back()) == "on" || words.back() == "TRUE" ? "ON" : "OFF"};
        else
            variables_[words[0]] = Words(words.begin() + 1, end);
    }

    void include(const std::string& name) {
        Words folders{variables_["CMAKE_CURRENT_LIST_DIR"]};
        const auto& modules = variables_["CMAKE_MODULE_PATH"];
        folders.insert(folders.end(), modules.begin(), modules.end());
        const auto here = variables_["CMAKE_CURRENT_LIST_DIR"];
        for (const auto& folder : folders)
            for (const char* ending : {"", ".cmake"})
                if (const fs::path file = fs::path(folder) / (name + ending); fs::is_regular_file(file)) {
                    read_file(file);
                    variables_["CMAKE_CURRENT_LIST_DIR"] = here;
                    return;
                }
    }

    void add_definitions(const CMakeCommand& command) {
        if (!certain_) return;
        std::istringstream arguments(command.text);
        for (std::string word; arguments >> word;)
            for (auto each : expand({word}, variables_)) {
                if (command.name == "add_compile_definitions" && each.rfind("-D", 0) != 0) each = "-D" + each;
                if (const auto definition = to_definition(each); !definition.empty())
                    result.definitions.push_back(definition);
            }
    }

    static constexpr int max_depth = 20;
    static constexpr int max_nesting = 200;
    static constexpr std::size_t max_work = 16 << 20;
    Variables variables_{{"CMAKE_SYSTEM_NAME", {"Linux"}}, {"CMAKE_CXX_COMPILER_ID", {"GNU"}}};
    std::map<std::string, Macro> macros_;
    bool certain_ = true;  // not within a branch with an unknown condition
    int depth_ = 0;        // of macros and included files
    int nesting_ = 0;      // of blocks, including through macros and included files
    std::size_t work_ = 0; // commands, their text, and bytes of their words
};

} // namespace

CMakeLists read_cmake_lists(const fs::path& folder) {
    Interpreter interpreter;
    for (const auto& each : ancestors_in_checkout(folder)) interpreter.read(each);
    return interpreter.result;
}

} // namespace tandem::command
