// SPDX-License-Identifier: Apache-2.0
// Compiled into the plugins that come with Tandem. An ELF note that says so, as TandemAbi.h writes the ABI number: hosts load
// such a library without trying it in a child process first.
__asm__(".pushsection .note.tandem,\"a\",%note\n"
        ".balign 4\n"
        ".long 14, 4, 1\n" // bytes of the owner, bytes of the number, type
        ".asciz \"TandemTrusted\"\n"
        ".balign 4\n"
        ".long 1\n" // the number: there is but one
        ".popsection\n");
