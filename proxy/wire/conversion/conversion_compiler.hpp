// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/conversion/conversion.hpp"

#include <string>
#include <vector>

namespace tandem::wire {

/// Compiles the steps of a Conversion. Takes each structure that is not nested in a sequence apart into its fields, so that
/// a field may come from anywhere in the message.
class ConversionCompiler {
  public:
    ConversionCompiler(const ConversionRequest& request, bool sends) : request_(request), sends_(sends) {}

    /// Throws ConversionError.
    void compile(const Type& from, const Type& to);

    std::vector<ConversionFrame> frames;
    std::size_t slots = 0;
    bool changes = false; ///< some value differs from the sent one

  private:
    struct Field {
        std::string path, position; ///< `pose.x`, `1.1`; without names the path has positions
        Type type;
        bool used = false;
    };
    struct Source {
        std::size_t index;
        const ConversionRequest::Rule* rule;
    };
    static void collect(const Type& structure, const Field& outer, std::vector<Field>& fields);
    const ConversionRequest::Rule* rule_for(const Field& target) const;
    bool is_by_name() const;

    void compile_frame(std::size_t frame, const Type& from, const Type& to, const std::string& path);
    std::size_t find_source(const Field& target, const ConversionRequest::Rule* rule, std::size_t position,
                            std::size_t count_of_targets, const std::vector<Field>& sources) const;
    static Field& find_named(const std::string& name, std::vector<Field>& sources);
    static ConversionStep make_refusal(const ConversionRequest::Refusal& refusal, const Field& source);
    static ConversionStep::Extent make_extent(const ConversionRequest::Rule& rule,
                                              std::vector<Field>& sources);
    void check_unused(const std::vector<Field>& sources) const;
    ConversionStep make_step(const Type& from, const Type& to, const std::string& path, double factor);
    ConversionStep make_number(const Type& from, const Type& to, const std::string& path, double factor);
    ConversionStep make_constant(const Field& target, const ConversionRequest::Rule& rule);
    std::size_t add_element(const Type& from, const Type& to, const std::string& path, double factor);
    [[noreturn]] void throw_difference(const Type& from, const Type& to) const;
    static void append(std::vector<ConversionStep>& steps, ConversionStep step);

    const ConversionRequest& request_;
    const bool sends_;
};

} // namespace tandem::wire
