// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"

#include <archive/opros_archive.h>

namespace tandem::adaptor {

/// Lets a type's own serialization write CDR: classes leave no trace, a sequence is its count and its
/// elements, as in the CDR of the IDL structure with the same members. `long` is 8 bytes. Throws
/// archive_type_exception for long double and wide characters, which have no counterpart.
class CdrOarchive final : public opros::archive::oarchive {
  public:
    explicit CdrOarchive(wire::CdrWriter& out) : out_(out) {}
    /// For a value that begins with RTM's time, which travels in the message's header: it goes to `stamp`.
    CdrOarchive(wire::CdrWriter& out, std::uint64_t& stamp) : out_(out), time_(&stamp), time_words_left_(2) {}

#define TANDEM_SAVE(type)                                                                                    \
    oarchive& save(type value) override;                                                                     \
    oarchive& save_array(const type* p, long size) override;
    OPROS_FOR_EACH_PRIMITIVE(TANDEM_SAVE)
#undef TANDEM_SAVE
    oarchive& save(const std::string& value) override;
    oarchive& save(const std::wstring& value) override;
    oarchive& save_binary(const char* p, long size) override;
    oarchive& write_sequence_head(std::size_t count) override;

    using oarchive::save;

  private:
    template <class T>
    bool is_time_word(T value);

    wire::CdrWriter& out_;
    std::uint64_t* time_ = nullptr;
    int time_words_left_ = 0; ///< of its two words
};

/// Lets a type's own serialization read CDR. Throws archive_type_exception when the bytes do not hold what it
/// asks for.
class CdrIarchive final : public opros::archive::iarchive {
  public:
    explicit CdrIarchive(wire::CdrReader in) : in_(in) {}
    /// For a value that begins with RTM's time, which `stamp` holds and the message does not.
    CdrIarchive(wire::CdrReader in, std::uint64_t stamp) : in_(in), time_(stamp), time_words_left_(2) {}

#define TANDEM_LOAD(type)                                                                                    \
    iarchive& load(type& value) override;                                                                    \
    iarchive& load_array(type* p, long size) override;
    OPROS_FOR_EACH_PRIMITIVE(TANDEM_LOAD)
#undef TANDEM_LOAD
    iarchive& load(std::string& value) override;
    iarchive& load(std::wstring& value) override;
    iarchive& load_binary(char** p, long& size) override;
    std::size_t read_sequence_head() override;

    using iarchive::load;

  private:
    template <class T>
    bool is_time_word(T& value);
    void check() const;

    wire::CdrReader in_;
    std::uint64_t time_ = 0;
    int time_words_left_ = 0; ///< of its two words
};

} // namespace tandem::adaptor
