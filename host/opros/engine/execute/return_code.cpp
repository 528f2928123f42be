// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/return_code.hpp"

#include <fmt/format.h>

namespace tandem::engine {
namespace {

const char* name_of(ReturnType code) {
#define CASE(name)                                                                                           \
    case name:                                                                                               \
        return #name
    switch (code) {
        CASE(OPROS_SUCCESS);
        CASE(OPROS_SUCCESS_SYNC);
        CASE(OPROS_VALID_DATA);
        CASE(OPROS_INVALID_DATA);
        CASE(OPROS_ERROR);
        CASE(OPROS_CALLER_ERROR);
        CASE(OPROS_BAD_INPUT_PARAMETER);
        CASE(OPROS_INPUT_OUT_OF_RANGE);
        CASE(OPROS_INPUT_NULL);
        CASE(OPROS_UNAUTHORIZED);
        CASE(OPROS_PRECONDITION_NOT_MET);
        CASE(OPROS_OUT_OF_RESOURCES);
        CASE(OPROS_CALLEE_ERROR);
        CASE(OPROS_UNSUPPORTED_METHOD);
        CASE(OPROS_INTERNAL_FAULT);
        CASE(OPROS_VERSION_MISMATCH);
        CASE(OPROS_DESTORY_ERROR);
        CASE(OPROS_FIND_DLL_ERROR);
        CASE(OPROS_LOAD_DLL_ERROR);
        CASE(OPROS_FIND_PROPERTY_ERROR);
        CASE(OPROS_SET_PROPERTY_ERROR);
        CASE(OPROS_INITIALIZE_API_ERROR);
        CASE(OPROS_FINALIZE_API_ERROR);
        CASE(OPROS_RESET_API_ERROR);
        CASE(OPROS_RECOVER_API_ERROR);
        CASE(OPROS_RECOVER_ERROR);
        CASE(OPROS_ENABLE_API_ERROR);
        CASE(OPROS_DISABLE_API_ERROR);
        CASE(OPROS_CALL_API_ERROR);
        CASE(OPROS_API_NOT_SUPPORTED_ERROR);
        CASE(OPROS_API_EXECUTING);
    default:
        return nullptr;
    }
#undef CASE
}

} // namespace

std::string describe_code(ReturnType code) {
    const auto number = code < 1000 ? fmt::format("{}", code) : fmt::format("{:#x}", code);
    const char* name = name_of(code);
    return name == nullptr ? number : fmt::format("{} ({})", number, name);
}

} // namespace tandem::engine
