// SPDX-License-Identifier: Apache-2.0
// Compiled into Tandem's plugins. An ELF note, in the format of TandemAbi.h's ABI number, marks such a library. Hosts
// load it without probing it in a child process first.
__asm__(".pushsection .note.tandem,\"a\",%note\n"
        ".balign 4\n"
        ".long 14, 4, 1\n" // bytes of the owner, bytes of the number, type
        ".asciz \"TandemTrusted\"\n"
        ".balign 4\n"
        ".long 1\n" // the number: the only one
        ".popsection\n");
