// SPDX-License-Identifier: Apache-2.0
// The classes of SurveyComp, except one, for an AdaptorComp of the public OPRoS API: the file of
// TANDEM_OPROS_TYPES.
#pragma once

#include "proxy/adaptor/typed/added_types.hpp"
#include "tests/integration/opros/SurveyTypes.h"

namespace tandem::adaptor {

template <>
struct Codec<Mark> : StructureCodec<Mark, &Mark::x, &Mark::y, &Mark::label> {};
template <>
struct Codec<Scan> : StructureCodec<Scan, &Scan::id, &Scan::marks, &Scan::valid> {};

using AddedValues = Values<Mark, Scan>;
using AddedMethods = Methods<std::vector<Mark>(std::vector<Mark>, double)>;

} // namespace tandem::adaptor
