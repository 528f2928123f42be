// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <archive/opros_archive.h>

#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tandem::adaptor {

/// Thrown for a type that contains itself.
class RecursiveType : public std::exception {
  public:
    const char* what() const noexcept override {
        return "it contains itself, and only each value knows how deep";
    }
};

/// Derives a type's signature from the reads of the type's own load(): provides one element in every sequence, and appends
/// the type code of each value that is read, with the name of the member (OPROS_SERIALIZATION_NVP). If a load() reads
/// different members depending on values, the signature shows the branch of the given values. Throws RecursiveType.
class SignatureArchive final : public opros::archive::iarchive {
  public:
    SignatureArchive() : iarchive(true) {}
    /// `values` are returned in order for the numbers and strings that are read; after them, zeros.
    explicit SignatureArchive(std::vector<long long> values) : iarchive(true), values_(std::move(values)) {}

    /// Returns the signature of all reads so far. Not in canonical form, because classes leave parentheses.
    const std::string& signature() const { return signature_; }

#define TANDEM_LOAD(type) iarchive& load(type& value) override;
    OPROS_FOR_EACH_PRIMITIVE(TANDEM_LOAD)
#undef TANDEM_LOAD
    iarchive& load(std::string& value) override;
    iarchive& load(std::wstring& value) override;
    iarchive& load_binary(char** p, long& size) override;
    std::size_t read_sequence_head() override;
    iarchive& read_class_head(const std::string&) override;
    iarchive& read_class_end(const std::string&) override;
    long read_array_head(long size, char, char) override;

    iarchive& read_start_tag(const std::string& name) override;

    using iarchive::load;

  private:
    long long next_value();
    void append(std::string_view text);

    std::string signature_, name_; ///< name_: of the member that is loaded next
    std::vector<long long> values_;
    std::size_t leaf_ = 0, depth_ = 0;
};

} // namespace tandem::adaptor
