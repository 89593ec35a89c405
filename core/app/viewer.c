/* viewer.c - see viewer.h. */
#include "app/viewer.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "cli/cli.h"
#include "view/view.h"
#include "watch/watch.h"

#include <errno.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

static const struct viewer_row {
    const char *words[3];          /* of the table of commands: its name first */
    const char *program, *lacking; /* why it may not be there */
} viewer_rows[] = {
    {{VIEW_PLOT}, VIEW_PROGRAM, "it belongs beside bulla"},
    {{VIEW_REPORT}, VIEW_PROGRAM, "it belongs beside bulla"},
    {{WATCH_COMMAND},
     WATCH_PROGRAM,
     "it is built where libmicrohttpd is found: install that (Debian: libmicrohttpd-dev) and build again"},
};

static const struct viewer_row *viewer_find(const char *word)
{
    for (size_t i = 0; i < sizeof viewer_rows / sizeof *viewer_rows; i++)
        if (!strcmp(word, viewer_rows[i].words[0])) return &viewer_rows[i];
    return NULL;
}

bool viewer_wanted(int argc, char **argv)
{
    return argc > 1 && viewer_find(argv[1]);
}

int viewer_become(char **argv)
{
    const struct viewer_row *row = viewer_find(argv[1]);
    char own[PATH_MAX] = "";
    snprintf(own, sizeof own, "%s", system_program());
    char *slash = strrchr(own, '/');
    if (slash) slash[1] = '\0';
    char *program = mem_print("%s%s", own, row->program);
    execv(program, argv);
    int code = cli_failed(status_fail(STATUS_RUN, "cannot start %s for `bulla %s`: %s; %s", program, argv[1],
                                      strerror(errno), row->lacking));
    mem_free(program);
    return code;
}
