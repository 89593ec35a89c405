/* watch_picture.c - see watch_picture.h. */
#include "watch/watch_picture.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "io/read.h"
#include "view/plot_picture.h"

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
static int watch_picture_draw(const char *path, const char *field, int pipe_end)
{
    struct snapshot *snapshot;
    cairo_surface_t *image;
    TRY(read_snapshot(path, NULL, &snapshot));
    struct plot_option option = {.width = WATCH_PICTURE_WIDTH, .mirror = snapshot->beta == 1 && snapshot->dim == 2};
    struct plot_picture picture = {.option = &option, .n_field = 1, .fields = {field}};
    TRY(plot_picture_draw(snapshot, &picture, &image));
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
static int watch_picture_by_child(const char *path, const char *field, struct watch_picture *picture)
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
        _exit(watch_picture_draw(path, field, ends[1]));
    }
    close(ends[1]);
    if (child > 0) watch_picture_receive(ends[0], picture);
    close(ends[0]);
    if (child < 0) return status_fail(STATUS_RUN, "no process to draw with: %s", strerror(errno));
    while (waitpid(child, &state, 0) < 0 && errno == EINTR) continue;
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0 && picture->n) return STATUS_OK;
    return status_fail(STATUS_RUN, "%s cannot be drawn", path);
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

static int watch_picture_one(struct watch_pictures *pictures, const char *path, const char *field,
                             const struct watch_picture **ret_picture)
{
    struct stat file;
    if (stat(path, &file)) return status_fail(STATUS_RUN, "%s: %s", path, strerror(errno));
    char *key =
        mem_print("%s\n%s\n%lld %lld", path, field, (long long)file.st_mtim.tv_sec, (long long)file.st_mtim.tv_nsec);
    *ret_picture = watch_picture_find(pictures, key);
    if (*ret_picture) {
        mem_free(key);
        return STATUS_OK;
    }
    struct watch_picture *picture = &pictures->kept[pictures->next];
    watch_picture_forget(picture);
    int code = watch_picture_by_child(path, field, picture);
    if (code) watch_picture_forget(picture);
    if (code) mem_free(key);
    else {
        picture->key = key;
        pictures->next = (pictures->next + 1) % WATCH_PICTURE_KEPT;
        *ret_picture = picture;
    }
    return code;
}

int watch_picture_take(struct watch_pictures *pictures, const char *directory, unsigned long snapshot,
                       unsigned long field, const struct watch_picture **ret_picture)
{
    struct snapshot_series series;
    unsigned n = 0;
    char **names = NULL;
    if (read_series(directory, &series)) return STATUS_CASE;
    int code = snapshot < series.n ? read_names(series.paths[series.n - 1], &n, &names) : STATUS_CASE;
    if (!code && field >= n) code = STATUS_CASE;
    if (!code) code = watch_picture_one(pictures, series.paths[snapshot], names[field], ret_picture);
    for (unsigned i = 0; i < n; i++) mem_free(names[i]);
    mem_free(names);
    read_series_done(&series);
    return code;
}

void watch_picture_done(struct watch_pictures *pictures)
{
    for (unsigned i = 0; i < WATCH_PICTURE_KEPT; i++) watch_picture_forget(&pictures->kept[i]);
}
