// SPDX-License-Identifier: Apache-2.0
// From sound calls to broken messages: with a sound header, so that they come as far as the servant, or with
// none.
#pragma once
#include "giop_message.hpp"
#include <algorithm>

namespace testing {

class Mutator {
  public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    /// What is sent one after the other for one broken call. `all` lends arguments and operations.
    std::vector<Bytes> next(const std::vector<Call>& all) {
        const Call& sound = all[pick(all.size())];
        const bool little = pick(4) != 0;
        const unsigned minor = pick(4) == 0 ? static_cast<unsigned>(pick(2)) : 2;
        Bytes arguments = sound.arguments[little];
        std::string operation = sound.operation;
        switch (pick(8)) {
        case 0: // of another operation
            arguments = all[pick(all.size())].arguments[little];
            break;
        case 1: // an operation that there is not
            operation = pick(2) == 0 ? all[pick(all.size())].operation : std::string(pick(300), 'x');
            break;
        case 2: // the byte order that it is not
            arguments = sound.arguments[!little];
            break;
        default:
            for (std::size_t n = 1 + pick(4); n > 0; --n) spoil(arguments, little);
        }
        const Bytes whole = request(sound.key, operation, arguments, minor, little);
        if (pick(10) == 0) return {without_sound_header(whole)};
        if (minor == 2 && pick(8) == 0) return broken_row(in_fragments(whole, pick(200), pick(200)));
        if (pick(50) == 0) return {other_message(whole)};
        return {whole};
    }
    std::size_t pick(std::size_t below) { return random_() % below; }

  private:
    // One change of the arguments: a number, some bytes, their length.
    void spoil(Bytes& m, bool little) {
        const std::size_t at = m.empty() ? 0 : pick(m.size());
        switch (m.empty() ? 5 : pick(6)) {
        case 0:
            m[at] = byte();
            break;
        case 1:
            write(m, at / 4 * 4, number(m.size()), little);
            break;
        case 2:
            m.resize(at);
            break;
        case 3: { // a part of it again
            const Bytes part(m.begin() + static_cast<std::ptrdiff_t>(at), m.end());
            m.insert(m.end(), part.begin(), part.end());
            break;
        }
        case 4: // a part of it missing
            m.erase(m.begin() + static_cast<std::ptrdiff_t>(at),
                    m.begin() + static_cast<std::ptrdiff_t>(at + pick(m.size() - at)));
            break;
        default:
            for (std::size_t n = pick(64); n > 0; --n) m.push_back(byte());
        }
    }
    // Those at which lengths go wrong.
    std::uint32_t number(std::size_t size) {
        const std::uint32_t edges[] = {0,
                                       1,
                                       0x7fffffff,
                                       0x80000000,
                                       0xffffffff,
                                       0xfffffffc,
                                       static_cast<std::uint32_t>(size),
                                       static_cast<std::uint32_t>(pick(64)),
                                       static_cast<std::uint32_t>(random_())};
        return edges[pick(std::size(edges))];
    }
    Bytes without_sound_header(Bytes m) {
        switch (pick(4)) {
        case 0: // some bytes of it, not of the object's key: that may be of another object then
            for (std::size_t at : {std::size_t{4}, std::size_t{5}, std::size_t{6}, std::size_t{7}})
                if (pick(2) == 0) m[at] = byte();
            break;
        case 1:
            m.resize(pick(m.size()));
            break;
        case 2:
            write(m, 8, number(m.size()), m[6] & 1);
            break;
        default:
            for (std::size_t i = 12; i < m.size(); ++i) m[i] = byte();
        }
        return m;
    }
    std::vector<Bytes> broken_row(std::vector<Bytes> row) {
        switch (pick(4)) {
        case 0: // no end
            row.resize(pick(row.size()));
            break;
        case 1: // an end before its beginning
            std::reverse(row.begin(), row.end());
            break;
        case 2:
            row.push_back(row.back());
            break;
        default:
            break;
        }
        return row;
    }
    // Replies to nobody, cancellations, questions where an object is, the end of the connection.
    Bytes other_message(Bytes m) {
        m[7] = static_cast<unsigned char>(1 + pick(8));
        return m;
    }
    unsigned char byte() { return static_cast<unsigned char>(random_()); }
    static void write(Bytes& m, std::size_t at, std::uint32_t value, bool little) {
        for (std::size_t i = 0; i < 4 && at + i < m.size(); ++i)
            m[at + i] = static_cast<unsigned char>(value >> 8 * (little ? i : 3 - i));
    }
    std::mt19937 random_;
};

} // namespace testing
