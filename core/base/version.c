/* version.c - see version.h. A file of its own, because it alone is compiled anew when the
 * commit changes (CMakeLists.txt). */
#include "base/version.h"

const char *version_commit(void)
{
    return BULLA_COMMIT;
}

const char *version_flags(void)
{
    return BULLA_FLAGS;
}
