// SPDX-License-Identifier: Apache-2.0
// Makes broken messages from valid calls: most with a valid header, so that they reach the servant, some without.
#pragma once
#include "giop_message.hpp"
#include <algorithm>

namespace testing {

/// Deterministic for a seed, so that a failure can be repeated.
class Mutator {
  public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    /// The messages of one broken call, to be sent in order. Takes a random one of `calls`; arguments and
    /// operations of others are mixed in.
    std::vector<Bytes> mutate(const std::vector<Call>& calls) {
        const Call& valid = calls[random_below(calls.size())];
        const bool little = random_below(4) != 0;
        const unsigned minor = random_below(4) == 0 ? static_cast<unsigned>(random_below(2)) : 2;
        Bytes arguments = valid.arguments[little];
        std::string operation = valid.operation;
        switch (random_below(8)) {
        case 0: // the arguments of another operation
            arguments = calls[random_below(calls.size())].arguments[little];
            break;
        case 1: // another or an unknown operation
            operation = random_below(2) == 0 ? calls[random_below(calls.size())].operation
                                             : std::string(random_below(300), 'x');
            break;
        case 2: // arguments in the wrong byte order
            arguments = valid.arguments[!little];
            break;
        default:
            for (std::size_t n = 1 + random_below(4); n > 0; --n) corrupt(arguments, little);
        }
        const Bytes whole = request(valid.key, operation, arguments, minor, little);
        if (random_below(10) == 0) return {corrupt_header(whole)};
        if (minor == 2 && random_below(8) == 0)
            return corrupt_fragments(in_fragments(whole, random_below(200), random_below(200)));
        if (random_below(50) == 0) return {change_message_type(whole)};
        return {whole};
    }
    std::size_t random_below(std::size_t below) { return random_() % below; }

  private:
    // One random change of the arguments: a byte, a number, their length, a part repeated or removed.
    void corrupt(Bytes& m, bool little) {
        const std::size_t at = m.empty() ? 0 : random_below(m.size());
        switch (m.empty() ? 5 : random_below(6)) {
        case 0:
            m[at] = random_byte();
            break;
        case 1:
            write_number(m, at / 4 * 4, boundary_value(m.size()), little);
            break;
        case 2:
            m.resize(at);
            break;
        case 3: { // repeats the end
            const Bytes part(m.begin() + static_cast<std::ptrdiff_t>(at), m.end());
            m.insert(m.end(), part.begin(), part.end());
            break;
        }
        case 4: // removes a part
            m.erase(m.begin() + static_cast<std::ptrdiff_t>(at),
                    m.begin() + static_cast<std::ptrdiff_t>(at + random_below(m.size() - at)));
            break;
        default:
            for (std::size_t n = random_below(64); n > 0; --n) m.push_back(random_byte());
        }
    }
    // Numbers that faulty length checks miss: 0, the ends of the signed and unsigned range, the true length.
    std::uint32_t boundary_value(std::size_t size) {
        const std::uint32_t edges[] = {0,
                                       1,
                                       0x7fffffff,
                                       0x80000000,
                                       0xffffffff,
                                       0xfffffffc,
                                       static_cast<std::uint32_t>(size),
                                       static_cast<std::uint32_t>(random_below(64)),
                                       static_cast<std::uint32_t>(random_())};
        return edges[random_below(std::size(edges))];
    }
    Bytes corrupt_header(Bytes m) {
        switch (random_below(4)) {
        case 0: // bytes of the GIOP header only: a changed object key could name another object
            for (std::size_t at : {std::size_t{4}, std::size_t{5}, std::size_t{6}, std::size_t{7}})
                if (random_below(2) == 0) m[at] = random_byte();
            break;
        case 1:
            m.resize(random_below(m.size()));
            break;
        case 2:
            write_number(m, 8, boundary_value(m.size()), m[6] & 1);
            break;
        default:
            for (std::size_t i = 12; i < m.size(); ++i) m[i] = random_byte();
        }
        return m;
    }
    std::vector<Bytes> corrupt_fragments(std::vector<Bytes> fragments) {
        switch (random_below(4)) {
        case 0: // the last ones missing
            fragments.resize(random_below(fragments.size()));
            break;
        case 1: // in reverse order
            std::reverse(fragments.begin(), fragments.end());
            break;
        case 2:
            fragments.push_back(fragments.back());
            break;
        default:
            break;
        }
        return fragments;
    }
    // Another message type: reply, cancel request, locate request, close connection ...
    Bytes change_message_type(Bytes m) {
        m[7] = static_cast<unsigned char>(1 + random_below(8));
        return m;
    }
    unsigned char random_byte() { return static_cast<unsigned char>(random_()); }
    static void write_number(Bytes& m, std::size_t at, std::uint32_t value, bool little) {
        for (std::size_t i = 0; i < 4 && at + i < m.size(); ++i)
            m[at + i] = static_cast<unsigned char>(value >> 8 * (little ? i : 3 - i));
    }
    std::mt19937 random_;
};

} // namespace testing
