/* verify.c - see verify.h. With --save every table replaces the one between its markers
 *     <!-- verify ID -->  ...  <!-- end ID -->
 * in docs/verification.md, so that prose and the rows of other codes around it stay. */
#include "batch/verify.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "base/text.h"
#include "batch/study.h"
#include "batch/verify_beside.h"
#include "batch/verify_cost.h"
#include "batch/verify_file.h"
#include "batch/verify_hard.h"
#include "cli/cli.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* Columns of docs. */
enum { VERIFY_WIDE = 120 };

struct verify {
    bool save;
    char *source; /* folder that holds cases/ and docs/ */
    struct study_options options;
    char **paths; /* scenes to run, sorted */
    unsigned n_path;
};

static const struct cli_option verify_list_option = {"--list", NULL, NULL, "The scenes there are, with their cells."};
static const struct cli_option verify_save_option = {"--save", NULL, NULL,
                                                     "Write the tables into docs/verification.md too."};
static const struct cli_option verify_cost_option = {
    "--cost", NULL, NULL, "Error against CPU seconds of schemes and meshes (cases/cost.yaml): table, CSV, picture."};
static const struct cli_option verify_beside_option = {
    "--beside", NULL, "PATH=VALUE", "Every scene twice, coarse: as it is, and with this setting; may be repeated."};
static const struct cli_option verify_set_option = {"--set", NULL, "PATH=VALUE",
                                                    "With --beside: a setting of both runs; may be repeated."};
static const struct cli_option verify_output_option = {"--output", "-o", "DIR", "Where the runs write (out/verify)."};
static const struct cli_option verify_ranks_option = {"--ranks", "-n", "RANKS", "MPI ranks of each run."};
const struct cli_option *const verify_option_table[] = {&verify_list_option,  &verify_save_option,
                                                        &verify_cost_option,  &verify_beside_option,
                                                        &verify_set_option,   &verify_output_option,
                                                        &verify_ranks_option, NULL};

static int verify_by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void verify_add(struct verify *verify, char *path)
{
    for (unsigned i = 0; i < verify->n_path; i++)
        if (strcmp(verify->paths[i], path) == 0) {
            mem_free(path);
            return;
        }
    verify->paths = mem_grow(verify->paths, verify->n_path, verify->n_path + 1, sizeof *verify->paths);
    verify->paths[verify->n_path++] = path;
}

/* Does the file name belong to an ID: equal, or the ID followed by a letter (r09 -> r09a), or by a dash? */
static bool verify_matches(const char *name, const char *id)
{
    size_t length = strlen(id), stem = strlen(name) - strlen(".yaml");
    if (strncasecmp(name, id, length) != 0) return false;
    return stem == length || name[length] == '-' ||
           (isdigit((unsigned char)id[length - 1]) && isalpha((unsigned char)name[length]));
}

/* Adds the scenes of an ID; NULL: all. Returns how many. */
static unsigned verify_scan(struct verify *verify, const char *id)
{
    char *folder = mem_print("%s/cases/verify", verify->source);
    unsigned found = 0;
    DIR *directory = opendir(folder);
    for (struct dirent *entry; directory && (entry = readdir(directory));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".yaml") != 0 || (id && !verify_matches(entry->d_name, id))) continue;
        verify_add(verify, mem_print("%s/%s", folder, entry->d_name));
        found++;
    }
    if (directory) closedir(directory);
    mem_free(folder);
    return found;
}

static int verify_word(struct verify *verify, const char *word)
{
    size_t length = strlen(word);
    if (length > 5 && strcmp(word + length - 5, ".yaml") == 0) {
        if (access(word, R_OK) != 0) return status_fail(STATUS_CASE, "%s: %s", word, strerror(errno));
        verify_add(verify, mem_text(word));
        return STATUS_OK;
    }
    if (!verify->source) return status_fail(STATUS_CASE, "no folder cases/verify here; give a path to a case file");
    if (verify_scan(verify, word) == 0)
        return status_fail(STATUS_CASE, "no verification scene '%s'; bulla verify --list shows them", word);
    return STATUS_OK;
}

static int verify_read(struct verify *verify, const struct cli_given *given)
{
    for (int i = 0; i < given->n_word; i++) TRY(verify_word(verify, given->words[i]));
    if (given->n_word == 0 && (!verify->source || verify_scan(verify, NULL) == 0))
        return status_fail(STATUS_CASE, "no folder cases/verify here; give a path to a case file");
    qsort(verify->paths, verify->n_path, sizeof *verify->paths, verify_by_name);
    return STATUS_OK;
}

static int verify_list(const struct verify *verify)
{
    for (unsigned i = 0; i < verify->n_path; i++) {
        struct study study;
        TRY(study_new(verify->paths[i], &study));
        printf("%-20s", study.id);
        for (unsigned r = 0; r < study.matrix.n_row; r++) printf("%s%s", r ? ", " : "", study.matrix.rows[r].cells);
        printf("  %s\n", study.matrix.title);
        study_done(&study);
    }
    return STATUS_OK;
}

/* The first row that finished: it names the columns. */
static const struct study_row *verify_columns(const struct study *study)
{
    for (unsigned i = 0; i < study->matrix.n_row; i++)
        if (study->rows[i].n_value) return &study->rows[i];
    return &study->rows[0];
}

static void verify_head(struct text *out, const struct study *study, const struct study_row *columns)
{
    text_add(out, "| cells | CPU s |%s", study->levels ? " cell steps |" : "");
    for (unsigned v = 0; v < columns->n_value; v++)
        text_add(out, " %s |%s", columns->values[v].what, columns->values[v].is_norm ? " order |" : "");
    text_add(out, "\n| ---: | ---: |%s", study->levels ? " ---: |" : "");
    for (unsigned v = 0; v < columns->n_value; v++)
        text_add(out, " ---: |%s", columns->values[v].is_norm ? " ---: |" : "");
    text_add(out, "\n");
}

static void verify_row(struct text *out, const struct study *study, unsigned index, const struct study_row *columns)
{
    const struct study_row *row = &study->rows[index];
    const struct matrix_row *matrix = &study->matrix.rows[index];
    text_add(out, "| %s", matrix->cells);
    for (unsigned k = 0; k < study->matrix.n_set; k++)
        if (strncmp(matrix->sets[k], "domain.cells=", 13) != 0 && strncmp(matrix->sets[k], "mesh.levels=", 12) != 0)
            text_add(out, ", %s", matrix->sets[k]);
    text_add(out, " | %.2f |", row->cpu);
    if (study->levels) text_add(out, " %.3g |", row->work);
    if (row->code > STATUS_EXPECT) text_add(out, " **run failed (exit code %d)** |", row->code);
    for (unsigned v = 0; v < row->n_value && v < columns->n_value; v++) {
        const struct study_value *value = &row->values[v];
        double order = index > 0 ? study_order(study, index - 1, index, v) : NAN;
        int digits = !value->is_norm && fabs(value->value) > 0.01 ? 5 : 4;
        text_add(out, " %.*g%s |", digits, value->value, row->judged && !value->passed ? " **fails**" : "");
        if (value->is_norm && isfinite(order)) text_add(out, " %.2f |", order);
        else if (value->is_norm) text_add(out, " |");
    }
    text_add(out, "\n");
}

/* The orders from the first row to the last. */
static void verify_overall(struct text *out, const struct study *study, const struct study_row *columns)
{
    unsigned last = study->matrix.n_row - 1;
    bool any = false;
    for (unsigned v = 0; v < columns->n_value; v++)
        any = any || (columns->values[v].is_norm && isfinite(study_order(study, 0, last, v)));
    if (last < 2 || !any) return;
    text_add(out, "| all | |%s", study->levels ? " |" : "");
    for (unsigned v = 0; v < columns->n_value; v++) {
        if (columns->values[v].is_norm) text_add(out, " | %.2f |", study_order(study, 0, last, v));
        else text_add(out, " |");
    }
    text_add(out, "\n");
}

/* Ends lines at blanks before they are longer than docs are wide; not before a sign, which would begin a quotation or a
 * list. */
static void verify_wrap(char *line)
{
    char *blank = NULL;
    for (char *at = line; *at; at++) {
        if (*at == ' ' && !strchr("<>=+-", at[1])) blank = at;
        if (*at == ' ' || *at == '\n' || at - line < VERIFY_WIDE || !blank) continue;
        *blank = '\n';
        line = blank + 1;
        blank = NULL;
    }
}

/* The bounds that the table was judged by. */
static void verify_bounds(struct text *out, const struct study *study, const struct study_row *columns)
{
    text_add(out, "\n");
    size_t from = out->length;
    text_add(out, "Expected");
    if (study->matrix.count > 0) text_add(out, " from %g cells on", study->matrix.count);
    for (unsigned v = 0; v < columns->n_value; v++) {
        const struct study_value *value = &columns->values[v];
        text_add(out, "%s %s %s", v ? ";" : ":", value->what, value->bound);
        if (value->order > 0) text_add(out, ", order >= %g", value->order);
    }
    text_add(out, ". %s\n", study_passed(study) ? "Holds." : "**Does not hold.**");
    verify_wrap(out->at + from);
}

static void verify_table(struct text *out, const struct study *study)
{
    const struct study_row *columns = verify_columns(study);
    verify_head(out, study, columns);
    for (unsigned i = 0; i < study->matrix.n_row; i++) verify_row(out, study, i, columns);
    verify_overall(out, study, columns);
    verify_bounds(out, study, columns);
}

static int verify_save(const struct verify *verify, const struct study *study, const char *table)
{
    char *path = mem_print("%s/docs/verification.md", verify->source ? verify->source : ".");
    int code = verify_file_save(path, study->id, study->matrix.title, table);
    mem_free(path);
    return code;
}

static int verify_scene(const struct verify *verify, const char *path, bool *ret_passed)
{
    struct study study;
    struct text table = {0};
    TRY(study_new(path, &study));
    char *folder = mem_print("%s/%s", verify->options.directory, study.id);
    int code = verify_file_folder(folder);
    for (unsigned i = 0; !code && i < study.matrix.n_row; i++) {
        fprintf(stderr, "%s: %s cells (%u of %u)\n", study.id, study.matrix.rows[i].cells, i + 1, study.matrix.n_row);
        code = study_run(&study, i, &verify->options);
    }
    if (!code) {
        verify_table(&table, &study);
        printf("\n## %s: %s\n\n%s", study.id, study.matrix.title, table.at);
        fflush(stdout);
        if (verify->save) code = verify_save(verify, &study, table.at);
        *ret_passed = study_passed(&study);
    }
    text_done(&table);
    mem_free(folder);
    study_done(&study);
    return code;
}

static int verify_all(const struct verify *verify)
{
    unsigned failed = 0;
    for (unsigned i = 0; i < verify->n_path; i++) {
        bool passed = false;
        TRY(verify_scene(verify, verify->paths[i], &passed));
        failed += !passed;
    }
    if (failed)
        return status_fail(STATUS_EXPECT, "%u of %u scenes do not show what they expect", failed, verify->n_path);
    return STATUS_OK;
}

/* `bulla verify hard [SCENE...]`. */
static int verify_of_hard(const struct verify *verify, const struct cli_given *given)
{
    if (!verify->source) return status_fail(STATUS_CASE, "no folder cases/verify here, and no cases/hard beside it");
    struct verify_hard_options options = {.source = verify->source,
                                          .directory = verify->options.directory,
                                          .ranks = verify->options.ranks,
                                          .words = given->words + 1,
                                          .n_word = given->n_word - 1,
                                          .save = verify->save};
    return verify_hard(&options);
}

/* `bulla verify --cost ID...`. */
static int verify_of_cost(const struct verify *verify, const struct cli_given *given)
{
    struct verify_cost_options options = {verify->source, verify->options.directory, verify->options.ranks,
                                          verify->save};
    if (!verify->source)
        return status_fail(STATUS_CASE, "no folder cases/verify here, and no cases/cost.yaml beside it");
    if (given->n_word == 0) return status_fail(STATUS_CASE, "--cost of which scene? cases/cost.yaml lists them");
    for (int i = 0; i < given->n_word; i++) TRY(verify_cost(&options, given->words[i]));
    return STATUS_OK;
}

/* What an option gives, each time; ends with NULL. */
static char **verify_given(const struct cli_given *given, const char *name, char **list, unsigned *n)
{
    for (int i = 0; i < given->n_option; i++) {
        if (strcmp(given->options[i]->name, name) != 0) continue;
        list = mem_grow(list, *n + 1, *n + 2, sizeof *list);
        list[(*n)++] = mem_text(given->values[i]);
        list[*n] = NULL;
    }
    return list;
}

static void verify_given_free(char **list)
{
    for (char **at = list; *at; at++) mem_free(*at);
    mem_free(list);
}

/* "scheme.cfl=0.8 mesh.tile=8". */
static char *verify_words(char *const *list, unsigned from)
{
    struct text words = {0};
    for (unsigned i = from; list[i]; i++) text_add(&words, "%s%s", i > from ? " " : "", list[i]);
    return words.at ? words.at : mem_text("");
}

/* `bulla verify --beside PATH=VALUE [ID...]`. */
static int verify_of_beside(struct verify *verify, const struct cli_given *given)
{
    unsigned n_plain = 0, n = 0;
    TRY(verify_read(verify, given));
    char **plain = verify_given(given, "--set", mem_new(1, sizeof *plain), &n_plain);
    char **beside = verify_given(given, "--beside", verify_given(given, "--set", mem_new(1, sizeof *plain), &n), &n);
    char *both = verify_words(plain, 0), *other = verify_words(beside, n_plain);
    char *title = mem_print("%s%s%s", other, *both ? " beside " : "", both);
    struct verify_beside_options options = {verify->source,
                                            verify->options.directory,
                                            verify->options.ranks,
                                            verify->paths,
                                            verify->n_path,
                                            plain,
                                            beside,
                                            title,
                                            verify->save};
    int code = verify_beside(&options);
    mem_free(title);
    mem_free(other);
    mem_free(both);
    verify_given_free(plain);
    verify_given_free(beside);
    return code;
}

static int verify_of_scenes(struct verify *verify, const struct cli_given *given)
{
    if (cli_value(given, "--set"))
        return status_fail(STATUS_CASE, "--set goes with --beside: cases/verify are run as they are");
    TRY(verify_read(verify, given));
    return cli_value(given, "--list") ? verify_list(verify) : verify_all(verify);
}

int verify_command(const struct cli_given *given)
{
    const char *directory = cli_value(given, "--output");
    struct verify verify = {
        .save = cli_value(given, "--save") != NULL,
        .source = verify_file_source(),
        .options = {.directory = directory ? directory : "out/verify", .ranks = cli_value(given, "--ranks")},
    };
    bool hard = given->n_word > 0 && strcmp(given->words[0], "hard") == 0;
    int code = hard                           ? verify_of_hard(&verify, given)
               : cli_value(given, "--cost")   ? verify_of_cost(&verify, given)
               : cli_value(given, "--beside") ? verify_of_beside(&verify, given)
                                              : verify_of_scenes(&verify, given);
    for (unsigned i = 0; i < verify.n_path; i++) mem_free(verify.paths[i]);
    mem_free(verify.paths);
    mem_free(verify.source);
    return code ? cli_failed(code) : STATUS_OK;
}
