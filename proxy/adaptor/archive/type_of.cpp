// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/signature_archive.hpp"
#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/adaptor/archive/union_cases.hpp"
#include "proxy/wire/signature_match.hpp"

namespace tandem::adaptor {
namespace {

using wire::Type;

std::string load_signature(const opros_any& sample, std::vector<long long> values) {
    SignatureArchive recorder(std::move(values));
    opros_any scratch(sample); // decode() overwrites it, and the sample belongs to the port
    scratch.decode(recorder);
    return recorder.signature();
}

bool reads_every_case(const opros_any& sample, const Type& expected, std::size_t cases) {
    for (std::size_t run = 0; run < cases; ++run) {
        std::vector<long long> values;
        const Type chosen = choose_union_cases(expected, run, values);
        try {
            if (!is_chosen_type(load_signature(sample, std::move(values)), chosen)) return false;
        } catch (const std::exception&) { // the type's own load() refuses that case
            return false;
        }
    }
    return true;
}

} // namespace

std::string why_not_archived(const opros_any& sample) {
    return sample.serializable() ? "" : "give it save() and load(), or save_this() and load_this()";
}

Type type_of(const opros_any& sample, const Type& peer) {
    if (const std::size_t cases = count_union_cases(peer); cases != 0) {
        if (reads_every_case(sample, peer, cases)) return peer;
        if (wire::is_timed(peer))
            if (Type rest = wire::without_time(peer); reads_every_case(sample, rest, cases)) return rest;
    }
    return wire::parse_signature(load_signature(sample, {}));
}

} // namespace tandem::adaptor
