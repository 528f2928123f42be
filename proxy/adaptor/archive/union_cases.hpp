// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <cstddef>
#include <string>
#include <vector>

// An IDL union is a class whose load() reads different members for each discriminator. To find out whether a class is this
// union, its load() is called with each discriminator.
namespace tandem::adaptor {

/// Returns the largest number of cases of a union in `type`; 0 if it has none.
std::size_t count_union_cases(const wire::Type& type);

/// Returns the type with each union replaced by a structure of its discriminator and its case number `run`. `values` gets
/// the values that a SignatureArchive must return so that load() takes this case.
wire::Type choose_union_cases(const wire::Type& type, std::size_t run, std::vector<long long>& values);

/// Returns whether the reads of load(), as a SignatureArchive's signature, match the chosen type.
bool is_chosen_type(const std::string& loaded, const wire::Type& chosen);

} // namespace tandem::adaptor
