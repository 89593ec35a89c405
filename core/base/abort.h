/* abort.h - the end of all ranks at once: for what cannot be told to them any more, such as memory that is not
 * there. */
#ifndef ABORT_H
#define ABORT_H

/* Ends this process, and where MPI has started others, all of them, with this exit code. */
void abort_all(int code) __attribute__((noreturn));

#endif
