/* main.c - where the drawing program starts: one command, the exit code. */
#include "base/comm.h"
#include "base/status.h"
#include "base/system.h"
#include "io/h5.h"
#include "view/plot.h"
#include "view/plot_option.h"
#include "view/report.h"
#include "view/view.h"

#include <string.h>

static int main_command(int argc, char **argv)
{
    const struct cli_command table[] = {
        {VIEW_PLOT, plot_option_table, 1, -1, plot_command},
        {VIEW_REPORT, report_option_table, 1, 1, report_command},
    };
    for (size_t i = 0; argc > 1 && i < sizeof table / sizeof *table; i++)
        if (!strcmp(argv[1], table[i].name)) return cli_run(&table[i], argc, argv);
    return cli_failed(status_fail(STATUS_CASE, VIEW_PROGRAM " draws for `bulla plot` and `bulla report`; call those"));
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
