/* version.h - which bulla this is. The number is BULLA_VERSION, known everywhere. */
#ifndef VERSION_H
#define VERSION_H

/* The commit the program was built from (40 hexadecimal digits), or "unknown". */
const char *version_commit(void);

/* The flags of the compiler: "-O3 -DNDEBUG ...". */
const char *version_flags(void);

#endif
