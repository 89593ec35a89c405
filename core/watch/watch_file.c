/* watch_file.c - see watch_file.h. */
#include "watch/watch_file.h"

#include "base/file.h"
#include "base/mem.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { FILE_TAIL = 1 << 16, FILE_WHOLE = 1 << 20 };

static FILE *watch_file_open(const char *directory, const char *name)
{
    const char *why;
    char *path = mem_print("%s/%s", directory, name);
    FILE *file = file_open(path, &why);
    mem_free(path);
    return file;
}

/* At most `most` bytes from where the file stands, in new memory; a NUL in them ends the text. */
static char *watch_file_text(FILE *file, size_t most)
{
    char *text = mem_new(most + 1, 1);
    text[fread(text, 1, most, file)] = '\0';
    return text;
}

char *watch_file_tail(const char *directory, const char *name, unsigned most)
{
    FILE *file = watch_file_open(directory, name);
    if (!file) return mem_text("");
    bool cut = !fseek(file, -(long)FILE_TAIL, SEEK_END); /* a shorter file stands at its start */
    char *text = watch_file_text(file, FILE_TAIL), *end = strrchr(text, '\n'), *start = text;
    fclose(file);
    if (cut) start = strchr(text, '\n') ? strchr(text, '\n') + 1 : text;
    if (!end || end < start) *(end = start) = '\0';
    else *end = '\0';
    for (char *at = end; at > start && most; at--)
        if (at[-1] == '\n' && --most == 0) start = at;
    char *lines = mem_text(start);
    mem_free(text);
    return lines;
}

char *watch_file_whole(const char *directory, const char *name)
{
    FILE *file = watch_file_open(directory, name);
    if (!file) return mem_text("");
    char *room = watch_file_text(file, FILE_WHOLE), *text = mem_text(room);
    fclose(file);
    mem_free(room);
    return text;
}

char *watch_file_head(const char *directory, const char *name)
{
    FILE *file = watch_file_open(directory, name);
    if (!file) return mem_text("");
    char *text = watch_file_text(file, FILE_TAIL);
    fclose(file);
    text[strcspn(text, "\r\n")] = '\0';
    return text;
}

json_t *watch_file_json(const char *directory, const char *name)
{
    char *text = watch_file_whole(directory, name);
    json_t *root = json_loads(text, 0, NULL);
    mem_free(text);
    return root;
}

time_t watch_file_time(const char *directory, const char *name)
{
    struct stat file;
    char *path = mem_print("%s/%s", directory, name);
    time_t when = stat(path, &file) ? 0 : file.st_mtime;
    mem_free(path);
    return when;
}

json_t *watch_file_word(const char *text, size_t most)
{
    if (!text) return json_null();
    char *line = mem_text(text);
    text_line(line, most);
    json_t *word = json_string(line);
    mem_free(line);
    return word ? word : json_string("?");
}
