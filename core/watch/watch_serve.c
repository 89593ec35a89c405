/* watch_serve.c - see watch_serve.h. One thread, which waits for requests and answers them in turn: nothing else goes
 * on in this program. libmicrohttpd reads requests and writes answers; what is answered is watch_answer's. */
#include "watch/watch_serve.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "view/plot_case.h"
#include "watch/watch_answer.h"

#include <arpa/inet.h>
#include <errno.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/select.h>

enum { SERVE_CONNECTIONS = 32, SERVE_PATIENCE = 30, SERVE_MEMORY = 1 << 15 };

static const struct cli_option watch_serve_port = {"--port", "-p", "N", "Port on 127.0.0.1 (a free one)."};
const struct cli_option *const watch_serve_option_table[] = {&watch_serve_port, NULL};

static volatile sig_atomic_t watch_serve_over;

static void watch_serve_end(int number)
{
    (void)number;
    watch_serve_over = 1;
}

static bool watch_serve_number(void *connection, const char *name, unsigned long *ret_number)
{
    const char *text = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, name);
    if (!text || !*text || strlen(text) > 9 || strspn(text, "0123456789") != strlen(text)) return false;
    *ret_number = strtoul(text, NULL, 10);
    return true;
}

static enum MHD_Result watch_serve_send(struct MHD_Connection *connection, const struct watch_answer *answer)
{
    struct MHD_Response *response =
        MHD_create_response_from_buffer_with_free_callback(answer->n, answer->bytes, mem_free);
    char *policy = watch_answer_policy(answer);
    const char *const headers[][2] = {{"Content-Type", answer->type},
                                      {"Content-Security-Policy", policy},
                                      {"X-Content-Type-Options", "nosniff"},
                                      {"Referrer-Policy", "no-referrer"},
                                      {"Cross-Origin-Resource-Policy", "same-origin"},
                                      {"Cross-Origin-Opener-Policy", "same-origin"},
                                      {"Cache-Control", "no-store"},
                                      {answer->status == MHD_HTTP_METHOD_NOT_ALLOWED ? "Allow" : NULL, "GET"}};
    enum MHD_Result sent = MHD_NO;
    for (size_t i = 0; response && i < sizeof headers / sizeof *headers; i++)
        if (headers[i][0]) MHD_add_response_header(response, headers[i][0], headers[i][1]);
    if (response) sent = MHD_queue_response(connection, answer->status, response);
    if (response) MHD_destroy_response(response);
    mem_free(policy);
    return sent;
}

static enum MHD_Result watch_serve_handle(void *data, struct MHD_Connection *connection, const char *path,
                                          const char *method, const char *version, const char *upload,
                                          size_t *upload_size, void **mine)
{
    const char *host = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, MHD_HTTP_HEADER_HOST);
    struct watch_answer_request request = {method, path, host, watch_serve_number, connection};
    struct watch_answer answer;
    (void)version;
    (void)upload;
    (void)upload_size;
    (void)mine;
    watch_answer_make(data, &request, &answer);
    return watch_serve_send(connection, &answer);
}

/* Waits for one of the connections or a signal, which come in only while this waits. */
static int watch_serve_wait(struct MHD_Daemon *daemon, const sigset_t *open)
{
    fd_set reads, writes, errors;
    int most = 0;
    MHD_UNSIGNED_LONG_LONG milliseconds;
    FD_ZERO(&reads);
    FD_ZERO(&writes);
    FD_ZERO(&errors);
    if (MHD_get_fdset(daemon, &reads, &writes, &errors, &most) != MHD_YES)
        return status_fail(STATUS_RUN, "too many connections");
    struct timespec limit = {0}, *until = NULL;
    if (MHD_get_timeout(daemon, &milliseconds) == MHD_YES) {
        limit = (struct timespec){(time_t)(milliseconds / 1000), (long)(milliseconds % 1000) * 1000000};
        until = &limit;
    }
    int n = pselect(most + 1, &reads, &writes, &errors, until, open);
    if (n < 0 && errno != EINTR) return status_fail(STATUS_RUN, "cannot wait: %s", strerror(errno));
    if (n >= 0) MHD_run_from_select(daemon, &reads, &writes, &errors);
    return STATUS_OK;
}

static int watch_serve_loop(struct MHD_Daemon *daemon, const char *token)
{
    sigset_t closed, open;
    struct sigaction end = {.sa_handler = watch_serve_end};
    const union MHD_DaemonInfo *info = MHD_get_daemon_info(daemon, MHD_DAEMON_INFO_BIND_PORT);
    char *address = mem_print("http://127.0.0.1:%u/%s/", info ? (unsigned)info->port : 0u, token);
    sigemptyset(&closed);
    sigaddset(&closed, SIGINT);
    sigaddset(&closed, SIGTERM);
    sigprocmask(SIG_BLOCK, &closed, &open);
    sigaction(SIGINT, &end, NULL);
    sigaction(SIGTERM, &end, NULL);
    signal(SIGPIPE, SIG_IGN);
    printf("%s\n", address);
    fflush(stdout);
    log_note("only this machine sees it, and only who has this address; Ctrl-C ends it");
    mem_free(address);
    int code = STATUS_OK;
    while (!code && !watch_serve_over) code = watch_serve_wait(daemon, &open);
    return code;
}

static int watch_serve_start(struct watch_answer_world *world, long port)
{
    struct sockaddr_in loopback = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    loopback.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    struct MHD_Daemon *daemon =
        MHD_start_daemon(MHD_NO_FLAG, (uint16_t)port, NULL, NULL, watch_serve_handle, world, MHD_OPTION_SOCK_ADDR,
                         &loopback, MHD_OPTION_CONNECTION_LIMIT, (unsigned)SERVE_CONNECTIONS,
                         MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)SERVE_PATIENCE, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
                         (size_t)SERVE_MEMORY, MHD_OPTION_END);
    if (!daemon)
        return status_fail(STATUS_RUN, "cannot listen on 127.0.0.1%s%ld: %s", port ? ":" : ", port ", port,
                           strerror(errno));
    int code = watch_serve_loop(daemon, world->token);
    MHD_stop_daemon(daemon);
    return code;
}

static int watch_serve_run(const struct cli_given *given, const char *const *directories)
{
    struct watch_answer_world *world = mem_new(1, sizeof *world);
    long port = 0;
    int code = cli_count(given, "--port", 1, &port);
    if (!code && port > 65535) code = status_fail(STATUS_CASE, "--port %ld: at most 65535", port);
    if (!code) code = watch_gate_token(world->token);
    if (!code) code = watch_runs_begin(directories, (unsigned)given->n_word, &world->runs);
    if (!code) code = watch_serve_start(world, port);
    watch_runs_done(&world->runs);
    watch_picture_done(&world->pictures);
    watch_curve_done(&world->curves);
    mem_free(world);
    return code;
}

int watch_serve_command(const struct cli_given *given)
{
    if (comm_rank() != 0) return STATUS_OK;
    char **directories = mem_new((size_t)given->n_word, sizeof *directories);
    for (int i = 0; i < given->n_word; i++) directories[i] = plot_case_directory(given->words[i]);
    int code = cli_failed(watch_serve_run(given, (const char *const *)directories));
    for (int i = 0; i < given->n_word; i++) mem_free(directories[i]);
    mem_free(directories);
    return code;
}
