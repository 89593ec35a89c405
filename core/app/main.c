/* main.c - where the program starts: ranks, one command, the exit code. */
#include "app/command.h"
#include "app/viewer.h"
#include "base/comm.h"
#include "base/system.h"
#include "io/h5.h"
#include "run/launch.h"

int main(int argc, char **argv)
{
    system_begin(argv[0]);
    if (viewer_wanted(argc, argv)) return viewer_become(argv);
    h5_begin();
    comm_init(&argc, &argv);
    int code = launch_report(command_main(argc, argv));
    comm_done();
    return code;
}
