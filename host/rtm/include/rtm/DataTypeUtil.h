// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DATATYPEUTIL_H
#define RTC_DATATYPEUTIL_H

namespace CORBA_Util {

template <class T>
void copyData(T& to, const T& from) {
    to = from;
}

} // namespace CORBA_Util
#endif
