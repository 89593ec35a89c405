/* main.c - where the program starts that shows runs at work: one command, the exit code. */
#include "base/comm.h"
#include "base/status.h"
#include "base/system.h"
#include "io/h5.h"
#include "watch/watch.h"
#include "watch/watch_serve.h"

#include <string.h>

static int main_command(int argc, char **argv)
{
    const struct cli_command command = {WATCH_COMMAND, watch_serve_option_table, 1, -1, watch_serve_command};
    if (argc > 1 && !strcmp(argv[1], command.name)) return cli_run(&command, argc, argv);
    return cli_failed(status_fail(STATUS_CASE, WATCH_PROGRAM " serves `bulla watch`; call that"));
}

int main(int argc, char **argv)
{
    system_begin(argv[0]);
    h5_begin();
    comm_init(&argc, &argv);
    int code = main_command(argc, argv);
    comm_done();
    return code;
}
