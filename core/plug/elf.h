/* elf.h - is a shared object whole and made for this machine? Asked before dlopen, because the
 * system's loader maps what the headers promise and dies of SIGBUS when the file is shorter. */
#ifndef ELF_CHECK_H
#define ELF_CHECK_H

#include <stddef.h>

/* Looks at `size` bytes of a file. NULL when they are a complete shared object of this machine,
 * else why not, as the end of a sentence ("... is not a shared object"). */
const char *elf_flaw(const void *bytes, size_t size);

#endif
