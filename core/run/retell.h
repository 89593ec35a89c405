/* retell.h - what a run was, in a page of text, from the files that it left (`bulla info DIR`): who ran it where and
 * why it ended, what it cost and where the time went, how evenly its ranks shared the work, what the guard did, what
 * is kept, and how its expectations came out. */
#ifndef RETELL_H
#define RETELL_H

#include <stdio.h>

/* Reads DIR/provenance.json and, if it is there, expect.json. STATUS_CASE and a message: no run is there, or its
 * provenance cannot be read. */
int retell_run(FILE *out, const char *directory);

#endif
