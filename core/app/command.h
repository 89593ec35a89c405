/* command.h - the commands of the program, and the choice of one. */
#ifndef COMMAND_H
#define COMMAND_H

/* Does what the command line says; returns the exit code. Failures have been printed. */
int command_main(int argc, char **argv);

#endif
