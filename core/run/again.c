/* again.c - see again.h. */
#include "run/again.h"

#include "base/mem.h"
#include "base/text.h"

#include <string.h>

/* A word as a shell takes it. */
static void again_add(struct text *line, const char *word)
{
    static const char *const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:,+-@%";
    text_add(line, " ");
    if (*word && !word[strspn(word, plain)]) {
        text_add(line, "%s", word);
        return;
    }
    text_add(line, "'");
    for (; *word; word++) text_add(line, *word == '\'' ? "'\\''" : "%c", *word);
    text_add(line, "'");
}

char *again_command(const struct cli_given *given)
{
    struct text line = {0};
    text_add(&line, "bulla %s", given->command->name);
    for (int i = 0; i < given->n_word; i++) again_add(&line, given->words[i]);
    for (int i = 0; i < given->n_option; i++) {
        const struct cli_option *option = given->options[i];
        if (!strcmp(option->name, "--overwrite") || !strcmp(option->name, "--restart")) continue;
        again_add(&line, option->letter ? option->letter : option->name);
        if (option->value) again_add(&line, given->values[i]);
    }
    text_add(&line, " --restart");
    char *command = mem_text(line.at);
    text_done(&line);
    return command;
}
