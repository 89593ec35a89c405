/* watch_gate.h - who may see the page: whoever knows its token, on this machine, and asks for it by its own name.
 *
 * The address is that of the loopback device, so no other machine reaches it. Other users and programs of this one, and
 * pages of other sites in the same browser, do not know the token, 128 random bits in the path. A site that lets its
 * name point to this machine (DNS rebinding) is told by the name in `Host:`. */
#ifndef WATCH_GATE_H
#define WATCH_GATE_H

#include <stdbool.h>

enum { WATCH_GATE_TOKEN = 32 };

/* 128 random bits in hexadecimal digits, for tokens and nonces. STATUS_RUN: the system has none. */
int watch_gate_token(char ret_token[WATCH_GATE_TOKEN + 1]);

/* What `path`, "/TOKEN/state", asks for behind its token: "state"; NULL if the token is another one. The time that this
 * takes does not tell how much of a wrong token is right. */
const char *watch_gate_open(const char *path, const char *token);

/* Is `host`, the header of a request or NULL, a name of this machine for itself: 127.0.0.1 or localhost, at any port (a
 * tunnel may have another one at its other end)? */
bool watch_gate_is_local(const char *host);

#endif
