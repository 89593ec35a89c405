/* elf.c - the look at a shared object before the system's loader gets it. */
#include "plug/elf.h"
#include "fuzz.h"

FUZZ(data, size)
{
    elf_flaw(data, size);
    return 0;
}
