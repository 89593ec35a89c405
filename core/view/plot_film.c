/* plot_film.c - see plot_film.h. ffmpeg works in the folder of the frames, on names that are always the same: the film
 * is moved to its place, whatever that is called. */
#include "view/plot_film.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/picture_canvas.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FILM_WORDS = 16, FILM_LACKS = 127 };

/* What ffmpeg is told for an ending: players of any age take the first, browsers the first two. */
static const struct plot_film_kind {
    const char *ending;
    const char *words[8];
} plot_film_kinds[] = {
    {".mp4", {"-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"}},
    {".webm", {"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-pix_fmt", "yuv420p"}},
    {".gif", {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"}},
};

static const struct plot_film_kind *plot_film_find(const char *file)
{
    const char *dot = strrchr(file, '.');
    for (size_t i = 0; dot && i < sizeof plot_film_kinds / sizeof *plot_film_kinds; i++)
        if (strcmp(dot, plot_film_kinds[i].ending) == 0) return &plot_film_kinds[i];
    return NULL;
}

static char *plot_film_frame(const struct plot_film *film, unsigned index)
{
    return mem_print("%s/frame_%06u.png", film->folder, index);
}

int plot_film_begin(const char *file, size_t total, struct plot_film *ret_film)
{
    if (!plot_film_find(file)) return status_fail(STATUS_CASE, "--movie %s: a film ends in .mp4, .webm or .gif", file);
    struct plot_film film = {.file = file, .total = total};
    film.folder = mem_print("%.*s_frames_XXXXXX", (int)(strrchr(file, '.') - file), file);
    if (!mkdtemp(film.folder)) {
        int code = status_fail(STATUS_RUN, "cannot make a folder for the frames of %s: %s", file, strerror(errno));
        mem_free(film.folder);
        return code;
    }
    *ret_film = film;
    return STATUS_OK;
}

int plot_film_add(struct plot_film *film, cairo_surface_t *image)
{
    int size[2] = {cairo_image_surface_get_width(image), cairo_image_surface_get_height(image)};
    for (int k = 0; k < 2; k++) {
        film->uneven = film->uneven || (film->n && size[k] != film->size[k]);
        if (size[k] > film->size[k]) film->size[k] = size[k];
    }
    char *path = plot_film_frame(film, film->n);
    int code = picture_canvas_write(image, path);
    if (!code) film->n++;
    mem_free(path);
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[Kframe %u of %zu%s", film->n, film->total, code ? "\n" : "");
    return code;
}

/* A frame on white ground of the largest size. */
static int plot_film_pad(const struct plot_film *film, const char *path)
{
    cairo_surface_t *frame = cairo_image_surface_create_from_png(path);
    cairo_surface_t *padded = cairo_image_surface_create(CAIRO_FORMAT_RGB24, film->size[0], film->size[1]);
    cairo_t *cr = cairo_create(padded);
    cairo_set_source_rgb(cr, 1.0, 1.0, 1.0);
    cairo_paint(cr);
    cairo_set_source_surface(cr, frame, 0.0, 0.0);
    cairo_paint(cr);
    int code = cairo_status(cr) ? status_fail(STATUS_RUN, "%s: %s", path, cairo_status_to_string(cairo_status(cr)))
                                : picture_canvas_write(padded, path);
    cairo_destroy(cr);
    cairo_surface_destroy(padded);
    cairo_surface_destroy(frame);
    return code;
}

static int plot_film_pad_all(const struct plot_film *film)
{
    int code = STATUS_OK;
    for (unsigned i = 0; i < film->n && !code && film->uneven; i++) {
        char *path = plot_film_frame(film, i);
        code = plot_film_pad(film, path);
        mem_free(path);
    }
    return code;
}

/* The words of ffmpeg, NULL after the last. */
static void plot_film_words(const struct plot_film_kind *kind, const char *pace, const char *film,
                            const char *words[FILM_WORDS + 8])
{
    static const char *const first[] = {"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-framerate"};
    unsigned n = 0;
    for (size_t i = 0; i < sizeof first / sizeof *first; i++) words[n++] = first[i];
    words[n++] = pace;
    words[n++] = "-i";
    words[n++] = "frame_%06d.png";
    for (size_t i = 0; i < sizeof kind->words / sizeof *kind->words && kind->words[i]; i++) words[n++] = kind->words[i];
    words[n++] = film;
    words[n] = NULL;
}

/* The exit code of ffmpeg; FILM_LACKS: there is none. */
static int plot_film_encode(const struct plot_film *film, const char *const *words)
{
    int state = 0;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        if (!chdir(film->folder)) execvp(words[0], (char *const *)words);
        _exit(errno == ENOENT ? FILM_LACKS : 1);
    }
    if (child < 0) return 1;
    while (waitpid(child, &state, 0) < 0 && errno == EINTR) continue;
    return WIFEXITED(state) ? WEXITSTATUS(state) : 1;
}

static void plot_film_remove(const struct plot_film *film)
{
    for (unsigned i = 0; i < film->n; i++) {
        char *path = plot_film_frame(film, i);
        unlink(path);
        mem_free(path);
    }
    rmdir(film->folder);
}

/* What could be typed instead. */
static void plot_film_advise(const struct plot_film *film, const char *const *words)
{
    fprintf(stderr,
            "note: there is no ffmpeg here (Debian: ffmpeg); the %u frames are in %s. Where there is one: cd %s &&",
            film->n, film->folder, film->folder);
    for (; *words; words++) fprintf(stderr, strpbrk(*words, ";[%") ? " '%s'" : " %s", *words);
    fputc('\n', stderr);
    printf("%s\n", film->folder);
}

static int plot_film_make(const struct plot_film *film, int pace)
{
    const char *words[FILM_WORDS + 8];
    const struct plot_film_kind *kind = plot_film_find(film->file);
    char name[16], rate[16];
    snprintf(name, sizeof name, "film%s", kind->ending);
    snprintf(rate, sizeof rate, "%d", pace);
    plot_film_words(kind, rate, name, words);
    if (isatty(STDERR_FILENO)) fputs("\r\033[K", stderr);
    TRY(plot_film_pad_all(film));
    int exit_code = plot_film_encode(film, words);
    if (exit_code == FILM_LACKS) {
        plot_film_advise(film, words);
        return STATUS_OK;
    }
    if (exit_code) return status_fail(STATUS_RUN, "ffmpeg fails; the %u frames are in %s", film->n, film->folder);
    char *made = mem_print("%s/%s", film->folder, name);
    int code = rename(made, film->file) ? status_fail(STATUS_RUN, "cannot write %s: %s", film->file, strerror(errno))
                                        : STATUS_OK;
    mem_free(made);
    if (code) return code;
    plot_film_remove(film);
    printf("%s\n", film->file);
    return STATUS_OK;
}

int plot_film_end(struct plot_film *film, int pace, int code)
{
    if (code) plot_film_remove(film);
    else code = plot_film_make(film, pace);
    mem_free(film->folder);
    *film = (struct plot_film){0};
    return code;
}
