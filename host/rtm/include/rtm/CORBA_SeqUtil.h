// SPDX-License-Identifier: Apache-2.0
// Algorithms on CORBA sequences.
#ifndef CORBA_SEQUTIL_H
#define CORBA_SEQUTIL_H
#include <coil/stringutil.h>
#include <rtm/RTC.h>

namespace CORBA_SeqUtil {

template <class CorbaSequence, class Functor>
Functor for_each(CorbaSequence& seq, Functor f) {
    for (CORBA::ULong i = 0; i < seq.length(); ++i) f(seq[i]);
    return f;
}

/// Returns the index of the first element for which f is true, or -1.
template <class CorbaSequence, class Functor>
CORBA::Long find(const CorbaSequence& seq, Functor f) {
    for (CORBA::ULong i = 0; i < seq.length(); ++i)
        if (f(seq[i])) return static_cast<CORBA::Long>(i);
    return -1;
}

/// Appends a copy of `elem`.
template <class CorbaSequence, class SequenceElement>
void push_back(CorbaSequence& seq, SequenceElement elem) {
    const CORBA::ULong at = seq.length();
    seq.length(at + 1);
    seq[at] = elem;
}

template <class CorbaSequence>
void push_back_list(CorbaSequence& seq1, const CorbaSequence& seq2) {
    const CORBA::ULong at = seq1.length();
    seq1.length(at + seq2.length());
    for (CORBA::ULong i = 0; i < seq2.length(); ++i) seq1[at + i] = seq2[i];
}

/// Inserts before position `index`, or at the end if `index` is beyond it.
template <class CorbaSequence, class SequenceElement>
void insert(CorbaSequence& seq, SequenceElement& elem, CORBA::ULong index) {
    const CORBA::ULong length = seq.length();
    if (index > length) index = length;
    seq.length(length + 1);
    for (CORBA::ULong i = length; i > index; --i) seq[i] = seq[i - 1];
    seq[index] = elem;
}

template <class CorbaSequence, class SequenceElement>
SequenceElement& front(CorbaSequence& seq) {
    return seq[0];
}
template <class CorbaSequence, class SequenceElement>
SequenceElement& back(CorbaSequence& seq) {
    return seq[seq.length() - 1];
}

/// Does nothing if `index` is beyond the end.
template <class CorbaSequence>
void erase(CorbaSequence& seq, CORBA::ULong index) {
    const CORBA::ULong length = seq.length();
    if (index >= length) return;
    for (CORBA::ULong i = index; i + 1 < length; ++i) seq[i] = seq[i + 1];
    seq.length(length - 1);
}

/// Erases the first element for which f is true.
template <class CorbaSequence, class Functor>
void erase_if(CorbaSequence& seq, Functor f) {
    const CORBA::Long index = find(seq, f);
    if (index >= 0) erase(seq, static_cast<CORBA::ULong>(index));
}

template <class CorbaSequence>
void clear(CorbaSequence& seq) {
    seq.length(0);
}

/// Returns the IORs of a list of references.
template <class CorbaRefSequence>
coil::vstring refToVstring(const CorbaRefSequence& objlist) {
    int argc = 0;
    CORBA::ORB_var orb = CORBA::ORB_init(argc, nullptr); // omniORB has one ORB per process: this one
    coil::vstring iors;
    for (CORBA::ULong i = 0; i < objlist.length(); ++i) {
        CORBA::String_var ior = orb->object_to_string(objlist[i]);
        iors.emplace_back(ior.in());
    }
    return iors;
}

} // namespace CORBA_SeqUtil
#endif
