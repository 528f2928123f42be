// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <cstddef>
#include <string>
#include <vector>

// A union of IDL is a class whose load() reads other members for each discriminator. Whether a class is that union shows
// when its load() is given each discriminator in turn.
namespace tandem::adaptor {

/// The cases of the union in `type` that has most of them; 0 if it has none.
std::size_t count_union_cases(const wire::Type& type);

/// The type with each union replaced by a structure of its discriminator and its case number `run`. `values` gets what a
/// SignatureArchive has to give out so that load() takes that case.
wire::Type choose_union_cases(const wire::Type& type, std::size_t run, std::vector<long long>& values);

/// Whether what load() asked for, as a SignatureArchive's signature, is the chosen type.
bool is_chosen_type(const std::string& loaded, const wire::Type& chosen);

} // namespace tandem::adaptor
