/* viewer.c - see viewer.h. */
#include "app/viewer.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "cli/cli.h"
#include "view/view.h"

#include <errno.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

bool viewer_wanted(int argc, char **argv)
{
    static const char *const names[][3] = {{VIEW_PLOT}, {VIEW_REPORT}};
    for (size_t i = 0; argc > 1 && i < sizeof names / sizeof *names; i++)
        if (!strcmp(argv[1], names[i][0])) return true;
    return false;
}

int viewer_become(char **argv)
{
    char own[PATH_MAX] = "";
    snprintf(own, sizeof own, "%s", system_program());
    char *slash = strrchr(own, '/');
    if (slash) slash[1] = '\0';
    char *program = mem_print("%s" VIEW_PROGRAM, own);
    execv(program, argv);
    int code =
        cli_failed(status_fail(STATUS_RUN, "cannot start %s: %s; it draws for `bulla %s` and belongs beside bulla",
                               program, strerror(errno), argv[1]));
    mem_free(program);
    return code;
}
