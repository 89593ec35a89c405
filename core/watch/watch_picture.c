/* watch_picture.c - see watch_picture.h. */
#include "watch/watch_picture.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "base/text.h"
#include "io/read.h"
#include "view/plot_beside.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PICTURE_CHUNK = 1 << 16 };

static cairo_status_t watch_picture_send(void *data, const unsigned char *bytes, unsigned length)
{
    const int *pipe_end = data;
    while (length) {
        ssize_t n = write(*pipe_end, bytes, length);
        if (n <= 0) return CAIRO_STATUS_WRITE_ERROR;
        bytes += n;
        length -= (unsigned)n;
    }
    return CAIRO_STATUS_SUCCESS;
}

/* In the child: all it does. */
static int watch_picture_draw(char *const *paths, unsigned n, const char *field, int pipe_end)
{
    struct snapshot *snapshot;
    cairo_surface_t *image;
    TRY(read_snapshot(paths[0], NULL, &snapshot));
    struct plot_option option = {.width = WATCH_PICTURE_WIDTH, .mirror = snapshot->beta == 1 && snapshot->dim == 2};
    struct plot_picture picture = {.option = &option, .n_field = 1, .fields = {field}};
    if (n > 1) TRY(plot_beside_gather(paths, n, &picture));
    TRY(plot_draw(snapshot, &picture, &image));
    cairo_status_t status = cairo_surface_write_to_png_stream(image, watch_picture_send, &pipe_end);
    return status == CAIRO_STATUS_SUCCESS ? STATUS_OK : STATUS_RUN;
}

/* Everything that comes until the end of the pipe. */
static void watch_picture_receive(int pipe_end, struct watch_picture *picture)
{
    size_t room = 0;
    ssize_t n = 1;
    while (n > 0 || (n < 0 && errno == EINTR)) {
        if (room - picture->n < PICTURE_CHUNK) {
            picture->bytes = mem_grow(picture->bytes, picture->n, room + 4 * PICTURE_CHUNK, 1);
            room += 4 * PICTURE_CHUNK;
        }
        n = read(pipe_end, picture->bytes + picture->n, PICTURE_CHUNK);
        if (n > 0) picture->n += (size_t)n;
    }
}

/* What the page does with signals is not for its children. */
static void watch_picture_plain_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGALRM, SIGPIPE};
    sigset_t none;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) signal(numbers[i], SIG_DFL);
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
}

/* A child that draws forever is ended by its own alarm. */
static int watch_picture_by_child(char *const *paths, unsigned n, const char *field, struct watch_picture *picture)
{
    int ends[2], state = 0;
    if (pipe(ends)) return status_fail(STATUS_RUN, "no pipe: %s", strerror(errno));
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        watch_picture_plain_signals();
        alarm(WATCH_PICTURE_SECONDS);
        system_no_core();
        system_end_with_parent();
        _exit(watch_picture_draw(paths, n, field, ends[1]));
    }
    close(ends[1]);
    if (child > 0) watch_picture_receive(ends[0], picture);
    close(ends[0]);
    if (child < 0) return status_fail(STATUS_RUN, "no process to draw with: %s", strerror(errno));
    while (waitpid(child, &state, 0) < 0 && errno == EINTR) continue;
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0 && picture->n) return STATUS_OK;
    return status_fail(STATUS_RUN, "%s cannot be drawn", paths[0]);
}

static const struct watch_picture *watch_picture_find(const struct watch_pictures *pictures, const char *key)
{
    for (unsigned i = 0; i < WATCH_PICTURE_KEPT; i++)
        if (pictures->kept[i].key && strcmp(pictures->kept[i].key, key) == 0) return &pictures->kept[i];
    return NULL;
}

static void watch_picture_forget(struct watch_picture *picture)
{
    mem_free(picture->key);
    mem_free(picture->bytes);
    *picture = (struct watch_picture){0};
}

/* What tells a picture from others: its files as they are now. New memory; NULL: one is not there. */
static char *watch_picture_key(char *const *paths, unsigned n, const char *field)
{
    struct text key = {0};
    struct stat file;
    text_add(&key, "%s", field);
    for (unsigned i = 0; i < n; i++) {
        if (stat(paths[i], &file)) {
            text_done(&key);
            return NULL;
        }
        text_add(&key, "\n%s\n%lld %lld", paths[i], (long long)file.st_mtim.tv_sec, (long long)file.st_mtim.tv_nsec);
    }
    return key.at;
}

static int watch_picture_one(struct watch_pictures *pictures, char *const *paths, unsigned n, const char *field,
                             const struct watch_picture **ret_picture)
{
    char *key = watch_picture_key(paths, n, field);
    if (!key) return status_fail(STATUS_RUN, "%s: %s", paths[0], strerror(errno));
    *ret_picture = watch_picture_find(pictures, key);
    if (*ret_picture) {
        mem_free(key);
        return STATUS_OK;
    }
    struct watch_picture *picture = &pictures->kept[pictures->next];
    watch_picture_forget(picture);
    int code = watch_picture_by_child(paths, n, field, picture);
    if (code) watch_picture_forget(picture);
    if (code) mem_free(key);
    else {
        picture->key = key;
        pictures->next = (pictures->next + 1) % WATCH_PICTURE_KEPT;
        *ret_picture = picture;
    }
    return code;
}

/* The file of a snapshot in new memory; of the first place also the name of its field. */
static int watch_picture_find_file(const struct watch_picture_place *place, unsigned long field, char **ret_path,
                                   char **ret_field)
{
    struct snapshot_series series;
    unsigned n = 0;
    char **names = NULL;
    if (read_series(place->directory, &series)) return STATUS_CASE;
    int code = place->snapshot < series.n ? STATUS_OK : STATUS_CASE;
    if (!code && ret_field) code = read_names(series.paths[series.n - 1], &n, &names);
    if (!code && ret_field && field >= n) code = STATUS_CASE;
    if (!code) *ret_path = mem_text(series.paths[place->snapshot]);
    if (!code && ret_field) *ret_field = mem_text(names[field]);
    for (unsigned i = 0; i < n; i++) mem_free(names[i]);
    mem_free(names);
    read_series_done(&series);
    return code;
}

int watch_picture_take(struct watch_pictures *pictures, const struct watch_picture_place *places, unsigned n,
                       unsigned long field, const struct watch_picture **ret_picture)
{
    char *paths[WATCH_PICTURE_LIKE] = {NULL}, *name = NULL;
    int code = STATUS_OK;
    for (unsigned i = 0; i < n && !code; i++)
        code = watch_picture_find_file(&places[i], field, &paths[i], i ? NULL : &name);
    if (!code && name) code = watch_picture_one(pictures, paths, n, name, ret_picture);
    for (unsigned i = 0; i < n; i++) mem_free(paths[i]);
    mem_free(name);
    return code;
}

void watch_picture_done(struct watch_pictures *pictures)
{
    for (unsigned i = 0; i < WATCH_PICTURE_KEPT; i++) watch_picture_forget(&pictures->kept[i]);
}
