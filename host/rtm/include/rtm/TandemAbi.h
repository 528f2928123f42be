// SPDX-License-Identifier: Apache-2.0
// The ABI number of this API. It increases with every change of these headers that a compiler sees.
// tests/architecture/abi_number.py sets and checks it.
#ifndef RTM_TANDEMABI_H
#define RTM_TANDEMABI_H

#define TANDEM_RTM_ABI 36 // headers: 4b38f72939c17474

// Stored as an ELF note in every object file. The loader reads it before it loads a module. A note, unlike a symbol,
// needs no linking and cannot clash, and no linker option or strip removes it (--gc-sections, version scripts, hidden
// visibility, LTO).
#define TANDEM_ABI_LONG_OF(number) ".long " #number "\n"
#define TANDEM_ABI_LONG(number) TANDEM_ABI_LONG_OF(number)
__asm__(".pushsection .note.tandem,\"a\",%note\n"
        ".balign 4\n"
        ".long 10, 4, 1\n" // bytes of the owner, bytes of the number, type
        ".asciz \"TandemRTM\"\n"
        ".balign 4\n" // the number itself
        TANDEM_ABI_LONG(TANDEM_RTM_ABI) ".popsection\n");
#undef TANDEM_ABI_LONG
#undef TANDEM_ABI_LONG_OF

#endif
