// SPDX-License-Identifier: Apache-2.0
// What the headers of another Tandem leave in a library: the note of TandemAbi.h, with a number that ours
// will not have.
#pragma once

__asm__(".pushsection .note.tandem,\"a\",%note\n"
        ".balign 4\n"
        ".long 12, 4, 1\n"
        ".asciz \"TandemOPRoS\"\n"
        ".long 999999\n"
        ".long 10, 4, 1\n"
        ".asciz \"TandemRTM\"\n"
        ".balign 4\n"
        ".long 999999\n"
        ".popsection\n");
