/* verify_file.c - see verify_file.h. */
#include "batch/verify_file.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "base/text.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *verify_file_source(void)
{
    static const char *const above[] = {"", "/..", "/../..", "/../../..", "/../share/bulla"};
    char exe[4096];
    if (access("cases/verify", R_OK) == 0) return mem_text(".");
    if (!*system_program()) return NULL;
    snprintf(exe, sizeof exe, "%s", system_program());
    *strrchr(exe, '/') = '\0';
    for (size_t i = 0; i < sizeof above / sizeof *above; i++) {
        char *folder = mem_print("%s%s", exe, above[i]), *cases = mem_print("%s/cases/verify", folder);
        bool found = access(cases, R_OK) == 0;
        mem_free(cases);
        if (found) return folder;
        mem_free(folder);
    }
    return NULL;
}

/* The text of a file, "" if there is none. */
static void verify_file_load(const char *path, struct text *out)
{
    char buffer[4096];
    FILE *file = fopen(path, "r");
    for (size_t n; file && (n = fread(buffer, 1, sizeof buffer, file)) > 0;) text_add_n(out, buffer, n);
    if (file) fclose(file);
}

int verify_file_save(const char *path, const char *id, const char *title, const char *table)
{
    char *begin = mem_print("<!-- verify %s -->\n", id), *end = mem_print("<!-- end %s -->", id);
    struct text old = {0}, now = {0};
    verify_file_load(path, &old);
    const char *text = old.at ? old.at : "", *from = strstr(text, begin), *to = from ? strstr(from, end) : NULL;
    size_t head = to ? (size_t)(from - text) : strlen(text);
    text_add_n(&now, text, head);
    if (!to) text_add(&now, "\n### %s\n\n", title);
    text_add(&now, "%s%s%s%s", begin, table, end, to ? to + strlen(end) : "\n");
    FILE *file = fopen(path, "w");
    bool written = file && fwrite(now.at, 1, now.length, file) == now.length;
    if (file && fclose(file) != 0) written = false;
    int code = written ? STATUS_OK : status_fail(STATUS_RUN, "cannot write %s: %s", path, strerror(errno));
    text_done(&old);
    text_done(&now);
    mem_free(begin);
    mem_free(end);
    return code;
}

int verify_file_folder(const char *path)
{
    char *part = mem_text(path);
    for (char *at = part + 1; *at; at++)
        if (*at == '/') {
            *at = '\0';
            mkdir(part, 0777);
            *at = '/';
        }
    int code = mkdir(part, 0777) && errno != EEXIST
                   ? status_fail(STATUS_RUN, "cannot make %s: %s", part, strerror(errno))
                   : STATUS_OK;
    mem_free(part);
    return code;
}
