// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/port/refusal_reason.hpp"
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>

namespace RTC {
namespace {

constexpr const char* key = "port.refusal_reason";

} // namespace

std::string refusal_reason(const ConnectorProfile& profile) {
    return NVUtil::toString(profile.properties, key);
}

void set_refusal_reason(ConnectorProfile& profile, const std::string& reason) {
    const CORBA::Long present = NVUtil::find_index(profile.properties, key);
    if (present >= 0) CORBA_SeqUtil::erase(profile.properties, static_cast<CORBA::ULong>(present));
    if (!reason.empty()) CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(key, reason.c_str()));
}

} // namespace RTC
