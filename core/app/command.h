/* command.h - the commands of the program, and the choice of one.
 *
 * This folder, app: main() and the table of commands; nothing else belongs here. */
#ifndef COMMAND_H
#define COMMAND_H

/* Does what the command line says; returns the exit code. Failures have been printed. */
int command_main(int argc, char **argv);

#endif
