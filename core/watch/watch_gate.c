/* watch_gate.c - see watch_gate.h. */
#include "watch/watch_gate.h"

#include "base/status.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>

int watch_gate_token(char ret_token[WATCH_GATE_TOKEN + 1])
{
    unsigned char bytes[WATCH_GATE_TOKEN / 2];
    if (getentropy(bytes, sizeof bytes))
        return status_fail(STATUS_RUN, "no random numbers for a token: %s", strerror(errno));
    for (size_t i = 0; i < sizeof bytes; i++) snprintf(ret_token + 2 * i, 3, "%02x", bytes[i]);
    return STATUS_OK;
}

const char *watch_gate_open(const char *path, const char *token)
{
    size_t length = strlen(path);
    if (length < WATCH_GATE_TOKEN + 2 || path[0] != '/' || path[WATCH_GATE_TOKEN + 1] != '/') return NULL;
    unsigned different = 0;
    for (size_t i = 0; i < WATCH_GATE_TOKEN; i++) different |= (unsigned)(path[i + 1] ^ token[i]);
    return different ? NULL : path + WATCH_GATE_TOKEN + 2;
}

bool watch_gate_is_local(const char *host)
{
    static const char *const names[] = {"127.0.0.1", "localhost"};
    for (size_t i = 0; host && i < sizeof names / sizeof *names; i++) {
        size_t length = strlen(names[i]);
        if (strncmp(host, names[i], length) != 0) continue;
        const char *port = host + length;
        if (!*port || (*port == ':' && port[1] && strspn(port + 1, "0123456789") == strlen(port + 1))) return true;
    }
    return false;
}
