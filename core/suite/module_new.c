/* module_new.c - see module_new.h.
 *
 * The files come from the SDK, bulla/skeleton/KIND and bulla/skeleton/any, where they are real sources
 * that the tests build as they stand. In them and in their names `the_name` becomes the module's name
 * as an identifier and `the-name` the name in cases; @KIND@, @SDK@ and @BULLA@ are the kind and the
 * places of headers and program. */
#include "suite/module_new.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "base/text.h"
#include "plug/registry.h"
#include "suite/contract_suite.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MODULE_NAME = 48, MODULE_WORDS = 5 };

/* What is put in for what. */
struct module_word {
    const char *word, *value;
};

struct module_plan {
    const char *kind, *folder;    /* the folder is the name as given */
    char name[MODULE_NAME];       /* in cases: with hyphens */
    char identifier[MODULE_NAME]; /* in C: with underscores */
    char *sdk, *program;          /* absolute; owned */
    struct module_word words[MODULE_WORDS];
};

static int module_new_kind(const char *kind)
{
    const char *const *kinds = contract_suite_kinds();
    struct text list = {0};
    for (int i = 0; kinds[i]; i++) {
        if (!strcmp(kinds[i], kind)) {
            text_done(&list);
            return STATUS_OK;
        }
        text_add(&list, "%s%s", i ? ", " : "", kinds[i]);
    }
    const char *near = text_nearest(kind, kinds);
    if (near) status_fail(STATUS_CASE, "there is no kind '%s'; did you mean '%s'? kinds are %s", kind, near, list.at);
    else status_fail(STATUS_CASE, "there is no kind '%s'; kinds are %s", kind, list.at);
    text_done(&list);
    return STATUS_CASE;
}

/* [a-z][a-z0-9]*([-_][a-z0-9]+)*: an identifier once hyphens are underscores, and a name in cases. */
static int module_new_name(const char *word, struct module_plan *plan)
{
    size_t length = strlen(word);
    bool good = islower((unsigned char)word[0]) && length < MODULE_NAME;
    for (size_t i = 0; good && i < length; i++) {
        bool joint = word[i] == '-' || word[i] == '_';
        good = islower((unsigned char)word[i]) || isdigit((unsigned char)word[i]) ||
               (joint && isalnum((unsigned char)word[i + 1]));
        plan->name[i] = word[i] == '_' ? '-' : word[i];
        plan->identifier[i] = word[i] == '-' ? '_' : word[i];
    }
    if (!good)
        return status_fail(STATUS_CASE,
                           "'%s' is no name for a module: lower case letters, digits and single hyphens, beginning "
                           "with a letter, at most %d; e.g. my-water",
                           word, MODULE_NAME - 1);
    TRY(registry_init());
    const struct registry_entry *taken = registry_find(plan->kind, plan->name);
    if (!taken) return STATUS_OK;
    return status_fail(STATUS_CASE, "kind %s has a module '%s' already, %s; choose another name", plan->kind,
                       plan->name, taken->path);
}

/* The program's own path and ../include beside its folder, in build and install tree alike. */
static int module_new_places(struct module_plan *plan)
{
    char program[4096];
    if (!*system_program()) return status_fail(STATUS_RUN, "cannot find the program's own path");
    snprintf(program, sizeof program, "%s", system_program());
    plan->program = mem_text(program);
    *strrchr(program, '/') = '\0';
    char *beside = mem_print("%s/../include", program), *header = mem_print("%s/bulla/module.h", beside);
    char *sdk = access(header, R_OK) == 0 ? realpath(beside, NULL) : NULL;
    if (sdk) plan->sdk = mem_text(sdk);
    else status_fail(STATUS_RUN, "the headers for modules are not beside the program: no %s", header);
    free(sdk);
    mem_free(beside);
    mem_free(header);
    return plan->sdk ? STATUS_OK : STATUS_RUN;
}

static void module_new_replace(const struct module_plan *plan, const char *from, struct text *to)
{
    while (*from) {
        const struct module_word *found = NULL;
        for (int i = 0; i < MODULE_WORDS && !found; i++)
            if (!strncmp(from, plan->words[i].word, strlen(plan->words[i].word))) found = &plan->words[i];
        if (found) text_add(to, "%s", found->value);
        else text_add_n(to, from, 1);
        from += found ? strlen(found->word) : 1;
    }
}

static int module_new_read(const char *path, struct text *text)
{
    FILE *file = fopen(path, "r");
    char part[4096];
    if (!file) return status_fail(STATUS_RUN, "%s cannot be read: %s", path, strerror(errno));
    for (size_t got; (got = fread(part, 1, sizeof part, file)) > 0;) text_add_n(text, part, got);
    bool bad = ferror(file) != 0;
    fclose(file);
    return bad ? status_fail(STATUS_RUN, "%s cannot be read: %s", path, strerror(errno)) : STATUS_OK;
}

static int module_new_write(const char *path, const struct text *text)
{
    FILE *file = fopen(path, "w");
    bool good = file && fwrite(text->at, 1, text->length, file) == text->length;
    if (file) good &= fclose(file) == 0;
    return good ? STATUS_OK : status_fail(STATUS_RUN, "%s cannot be written: %s", path, strerror(errno));
}

static int module_new_copy(const struct module_plan *plan, const char *from, const char *name)
{
    struct text to = {0}, content = {0}, filled = {0};
    text_add(&to, "%s/", plan->folder);
    module_new_replace(plan, name, &to);
    int code = module_new_read(from, &content);
    if (!code) module_new_replace(plan, content.at ? content.at : "", &filled);
    if (!code) code = module_new_write(to.at, &filled);
    text_done(&to);
    text_done(&content);
    text_done(&filled);
    return code;
}

static int module_new_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

/* All files of one folder of skeletons. */
static int module_new_fill(const struct module_plan *plan, const char *which)
{
    char *folder = mem_print("%s/bulla/skeleton/%s", plan->sdk, which);
    struct dirent **files;
    int count = scandir(folder, &files, module_new_visible, alphasort), code = STATUS_OK;
    if (count < 0) code = status_fail(STATUS_RUN, "%s cannot be read: %s", folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        char *from = mem_print("%s/%s", folder, files[i]->d_name);
        if (!code) code = module_new_copy(plan, from, files[i]->d_name);
        mem_free(from);
        free(files[i]);
    }
    if (count >= 0) free(files);
    mem_free(folder);
    return code;
}

static int module_new_make(struct module_plan *plan)
{
    TRY(module_new_places(plan));
    const struct module_word words[MODULE_WORDS] = {{"the_name", plan->identifier},
                                                    {"the-name", plan->name},
                                                    {"@KIND@", plan->kind},
                                                    {"@SDK@", plan->sdk},
                                                    {"@BULLA@", plan->program}};
    memcpy(plan->words, words, sizeof words);
    if (mkdir(plan->folder, 0777) != 0) {
        if (errno == EEXIST)
            return status_fail(STATUS_CASE, "%s is there already; choose another name, or remove it", plan->folder);
        return status_fail(STATUS_RUN, "%s cannot be made: %s", plan->folder, strerror(errno));
    }
    TRY(module_new_fill(plan, plan->kind));
    return module_new_fill(plan, "any");
}

int module_new_command(const struct cli_given *given)
{
    if (comm_rank() != 0) return STATUS_OK;
    struct module_plan plan = {.kind = given->words[1], .folder = given->words[2]};
    int code = STATUS_OK;
    if (strcmp(given->words[0], "module") != 0)
        code = status_fail(STATUS_CASE, "new does not know '%s'; usage: bulla new module KIND NAME", given->words[0]);
    if (!code) code = module_new_kind(plan.kind);
    if (!code) code = module_new_name(plan.folder, &plan);
    if (!code) code = module_new_make(&plan);
    if (!code)
        printf("%s/ holds the module '%s' of kind %s, which works as it is; %s/README.md says what is what.\n\n"
               "  cd %s\n  make          builds %s-%s.so\n  make check    tests it and runs case.yaml with it\n",
               plan.folder, plan.name, plan.kind, plan.folder, plan.folder, plan.kind, plan.name);
    mem_free(plan.sdk);
    mem_free(plan.program);
    return cli_failed(code);
}
