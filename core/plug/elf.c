/* elf.c - see elf.h. Format: System V ABI, chapters 4 and 5 (elf.h of the C library).
 *
 * Every offset and size in the headers is compared with the size of the file; nothing outside
 * the given bytes is read, whatever they contain. */
#include "plug/elf.h"

#ifndef __ELF__ /* a system whose objects have another form: its loader is the judge */
const char *elf_flaw(const void *bytes, size_t size)
{
    (void)bytes;
    (void)size;
    return NULL;
}
#else

#include <elf.h>
#include <link.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__x86_64__)
#define ELF_MACHINE EM_X86_64
#elif defined(__aarch64__)
#define ELF_MACHINE EM_AARCH64
#else
#error "elf.c: name this machine"
#endif

static bool elf_inside(size_t size, uint64_t offset, uint64_t length)
{
    return offset <= size && length <= size - offset;
}

static bool elf_segments_inside(const char *bytes, size_t size, const ElfW(Ehdr) * head)
{
    if (head->e_phentsize != sizeof(ElfW(Phdr)) || head->e_phnum == 0) return false;
    if (!elf_inside(size, head->e_phoff, (uint64_t)head->e_phnum * head->e_phentsize)) return false;
    for (unsigned i = 0; i < head->e_phnum; i++) {
        ElfW(Phdr) segment;
        memcpy(&segment, bytes + head->e_phoff + i * sizeof segment, sizeof segment);
        if (segment.p_type == PT_LOAD && !elf_inside(size, segment.p_offset, segment.p_filesz)) return false;
    }
    return true;
}

static bool elf_sections_inside(const char *bytes, size_t size, const ElfW(Ehdr) * head)
{
    if (head->e_shoff == 0) return true; /* stripped of its section table */
    if (head->e_shentsize != sizeof(ElfW(Shdr))) return false;
    if (!elf_inside(size, head->e_shoff, (uint64_t)head->e_shnum * head->e_shentsize)) return false;
    for (unsigned i = 0; i < head->e_shnum; i++) {
        ElfW(Shdr) section;
        memcpy(&section, bytes + head->e_shoff + i * sizeof section, sizeof section);
        if (section.sh_type == SHT_NOBITS || section.sh_type == SHT_NULL) continue;
        if (!elf_inside(size, section.sh_offset, section.sh_size)) return false;
    }
    return true;
}

const char *elf_flaw(const void *bytes, size_t size)
{
    ElfW(Ehdr) head;
    if (size < sizeof head || memcmp(bytes, ELFMAG, SELFMAG) != 0) return "is not a shared object";
    memcpy(&head, bytes, sizeof head);
    int width = sizeof(void *) == 8 ? ELFCLASS64 : ELFCLASS32;
    if (head.e_ident[EI_CLASS] != width || head.e_ident[EI_DATA] != ELFDATA2LSB || head.e_machine != ELF_MACHINE)
        return "is built for another kind of machine";
    if (head.e_type != ET_DYN) return "is not a shared object";
    if (!elf_segments_inside(bytes, size, &head) || !elf_sections_inside(bytes, size, &head))
        return "is truncated or damaged";
    return NULL;
}
#endif
