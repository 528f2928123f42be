// SPDX-License-Identifier: Apache-2.0
// The number of this API as compiled code sees it. tests/architecture/abi_number.py sets and checks it.
#ifndef TANDEM_ABI_H_
#define TANDEM_ABI_H_

#define TANDEM_OPROS_ABI 27 // headers: d3852649c938b8a7

// Stored as an ELF note in every object file, for the loader. A note, unlike a symbol, needs no linking and cannot
// clash, and no linker drops it, even with --gc-sections, a version script, hidden visibility, LTO or strip.
#define TANDEM_ABI_LONG_OF(number) ".long " #number "\n"
#define TANDEM_ABI_LONG(number) TANDEM_ABI_LONG_OF(number)
__asm__(".pushsection .note.tandem,\"a\",%note\n"
        ".balign 4\n"
        ".long 12, 4, 1\n" // bytes of the owner, bytes of the number, type
        ".asciz \"TandemOPRoS\"\n"
        ".balign 4\n" // the number itself
        TANDEM_ABI_LONG(TANDEM_OPROS_ABI) ".popsection\n");
#undef TANDEM_ABI_LONG
#undef TANDEM_ABI_LONG_OF

#endif
