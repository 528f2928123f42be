// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/cmake_condition.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <cstdlib>
#include <optional>
#include <set>

namespace tandem::command {
namespace {

const std::set<std::string> other_platforms{"WIN32", "APPLE",  "MSVC",    "MSVC_IDE", "MINGW",
                                            "MSYS",  "CYGWIN", "BORLAND", "XCODE",    "ANDROID",
                                            "IOS",   "QNX",    "WINCE",   "VXWORKS"};
const std::set<std::string> this_platform{"UNIX", "LINUX", "CMAKE_COMPILER_IS_GNUCC",
                                          "CMAKE_COMPILER_IS_GNUCXX"};

Truth negate(Truth truth) {
    return truth == Truth::unknown ? truth : truth == Truth::yes ? Truth::no : Truth::yes;
}

// A chain of AND ends with `no`, a chain of OR with `yes`.
Truth combine(Truth left, Truth right, Truth decisive) {
    if (left == decisive || right == decisive) return decisive;
    return left == Truth::unknown ? left : right;
}

struct Operand {
    std::string word;
    bool quoted = false;
};

// Splits at white space and parentheses, and keeps quoted text together.
std::vector<Operand> operands_of(const std::string& text) {
    std::vector<Operand> found;
    bool quoted = false, within = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            quoted = !quoted;
            if (quoted) found.push_back({"", true});
            within = quoted;
        } else if (!quoted && (c == '(' || c == ')') && (i == 0 || text[i - 1] != '$')) {
            found.push_back({std::string(1, c)});
            within = false;
        } else if (!quoted && (c == ' ' || c == '\t' || c == '\n')) {
            within = false;
        } else {
            if (!within) found.push_back({});
            within = true;
            found.back().word += c;
        }
    }
    return found;
}

class Evaluator {
  public:
    Evaluator(const std::string& text, const Variables& variables)
        : operands_(operands_of(text)), variables_(variables) {}

    Truth any() {
        auto truth = all();
        while (take("OR")) truth = combine(truth, all(), Truth::yes);
        return truth;
    }

    bool at_end() const { return at_ == operands_.size(); }

  private:
    bool take(const char* keyword) {
        if (at_end() || operands_[at_].quoted || operands_[at_].word != keyword) return false;
        ++at_;
        return true;
    }

    Truth all() {
        auto truth = one();
        while (take("AND")) truth = combine(truth, one(), Truth::no);
        return truth;
    }

    Truth one() {
        if (++terms_ > max_terms) return Truth::unknown;
        if (take("NOT")) return negate(one());
        if (take("(")) {
            const auto truth = any();
            return take(")") ? truth : Truth::unknown;
        }
        if (at_end()) return Truth::unknown;
        if (take("DEFINED"))
            return at_end()                                  ? Truth::unknown
                   : variables_.count(operands_[at_++].word) ? Truth::yes
                                                             : Truth::unknown;
        const Operand left = operands_[at_++];
        for (const char* operation :
             {"STREQUAL", "MATCHES", "EQUAL", "LESS", "GREATER", "LESS_EQUAL", "GREATER_EQUAL"})
            if (take(operation))
                return at_end() ? Truth::unknown : compare(left, operation, operands_[at_++]);
        return truth_of(left);
    }

    // Returns the value of text with references, or of a variable that is named without ${}.
    std::optional<std::string> value_of(const Operand& operand) const {
        Words words{operand.word};
        if (operand.word.find('$') != std::string::npos)
            words = expand(words, variables_);
        else if (const auto known = variables_.find(operand.word);
                 !operand.quoted && known != variables_.end())
            words = known->second;
        return words.size() == 1 ? std::optional(words[0]) : std::nullopt;
    }

    Truth compare(const Operand& left, const std::string& operation, const Operand& right) const {
        const auto a = value_of(left), b = value_of(right);
        if (!a || !b) return Truth::unknown;
        const auto to_truth = [](bool value) { return value ? Truth::yes : Truth::no; };
        if (operation == "STREQUAL") return to_truth(*a == *b);
        if (operation == "MATCHES") // only patterns without operators
            return b->find_first_of("[]().*+?^$|\\") == std::string::npos
                       ? to_truth(a->find(*b) != std::string::npos)
                       : Truth::unknown;
        const double x = std::atof(a->c_str()), y = std::atof(b->c_str());
        if (operation == "EQUAL") return to_truth(x == y);
        if (operation.rfind("LESS", 0) == 0) return to_truth(x < y || (operation == "LESS_EQUAL" && x == y));
        return to_truth(x > y || (operation == "GREATER_EQUAL" && x == y));
    }

    Truth truth_of(const Operand& operand) const {
        if (other_platforms.count(operand.word)) return Truth::no;
        if (this_platform.count(operand.word)) return Truth::yes;
        if (const auto constant = constant_truth(operand.word); constant != Truth::unknown) return constant;
        const auto known = variables_.find(operand.word);
        if (known == variables_.end() || known->second.size() > 1) return Truth::unknown;
        if (known->second.empty()) return Truth::no;
        const auto value = constant_truth(known->second[0]);
        return value == Truth::unknown ? Truth::yes : value; // other text is true
    }

    static Truth constant_truth(const std::string& word) {
        static const std::set<std::string> yes{"1", "on", "yes", "true", "y"},
            no{"0", "off", "no", "false", "n", "ignore", "notfound"};
        const auto lower = to_lower(word);
        if (yes.count(lower)) return Truth::yes;
        return no.count(lower) || lower.ends_with("-notfound") ? Truth::no : Truth::unknown;
    }

    std::vector<Operand> operands_;
    const Variables& variables_;
    std::size_t at_ = 0;
    static constexpr int max_terms = 1000; // each may be nested in the one before
    int terms_ = 0;
};

} // namespace

Truth evaluate_condition(const std::string& text, const Variables& variables) {
    Evaluator evaluator(text, variables);
    const auto truth = evaluator.any();
    return evaluator.at_end() ? truth : Truth::unknown;
}

} // namespace tandem::command
