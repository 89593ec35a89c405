/* matrix.c - see matrix.h. Works on the text tree, before anything is resolved: what a list
 * holds is handed to --set as it stands, which checks it like any other value. */
#include "batch/matrix.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/show.h"

#include <string.h>

enum { MATRIX_ROWS = 10000, MATRIX_LEVELS = 100 }; /* most combinations; more levels than any case has */

/* Product of a list of numbers, and "64 x 64"; 0 if it is none. */
static double matrix_cells(const struct node *node, char **ret_text)
{
    struct text text = {0};
    double count = 1, value;
    for (unsigned i = 0; node && node->kind == TREE_LIST && i < node->count; i++) {
        const struct node *item = node->items[i];
        if (item->kind != TREE_SCALAR || text_number(item->text, &value) == 0) count = value = 0;
        count *= value;
        text_add(&text, "%s%s", i ? " x " : "", item->kind == TREE_SCALAR ? item->text : "?");
    }
    if (ret_text) *ret_text = mem_text(text.at ? text.at : "?");
    if (!text.at) count = 0;
    text_done(&text);
    return count;
}

static void matrix_fill(const struct node *lists, const struct node *own_cells, unsigned index, struct matrix_row *row)
{
    unsigned n = lists ? lists->count : 0;
    const struct node *cells = own_cells;
    row->sets = mem_new(n + 1, sizeof *row->sets);
    for (unsigned k = n; k-- > 0;) {
        const struct node *list = lists->items[k], *value = list->items[index % list->count];
        struct text text = {0};
        index /= list->count;
        text_add(&text, "%s=", lists->keys[k]->text);
        show_value(value, &text);
        row->sets[k] = mem_text(text.at);
        text_done(&text);
        if (strcmp(lists->keys[k]->text, "domain.cells") == 0) cells = value;
    }
    row->count = matrix_cells(cells, &row->cells);
    row->dim = cells && cells->count ? cells->count : 1;
}

/* mesh.levels; -1 if it is no plain number. */
static int matrix_levels(const struct node *root)
{
    const struct node *levels = tree_get(tree_get(root, "mesh"), "levels");
    double value;
    if (!levels) return 0;
    bool plain = levels->kind == TREE_SCALAR && text_number(levels->text, &value) == strlen(levels->text);
    return plain && value >= 0 && value <= MATRIX_LEVELS ? (int)value : -1;
}

int matrix_combine(const struct node *root, struct matrix *ret_matrix)
{
    const struct node *lists = tree_get(root, "matrix"), *title = tree_get(root, "title");
    const struct node *own_cells = tree_get(tree_get(root, "domain"), "cells");
    unsigned rows = 1;
    if (lists && lists->kind != TREE_MAP) return status_fail(STATUS_CASE, "matrix: a map of lists is needed");
    for (unsigned k = 0; lists && k < lists->count; k++) {
        if (lists->items[k]->kind != TREE_LIST || lists->items[k]->count == 0)
            return status_fail(STATUS_CASE, "matrix: %s: a list of values is needed", lists->keys[k]->text);
        rows *= lists->items[k]->count;
        if (rows > MATRIX_ROWS) return status_fail(STATUS_CASE, "matrix: more than %d combinations", MATRIX_ROWS);
    }
    *ret_matrix = (struct matrix){.title = mem_text(title && title->kind == TREE_SCALAR ? title->text : ""),
                                  .count = matrix_cells(own_cells, NULL),
                                  .levels = matrix_levels(root),
                                  .n_set = lists ? lists->count : 0,
                                  .n_row = rows,
                                  .rows = mem_new(rows, sizeof *ret_matrix->rows)};
    for (unsigned i = 0; i < rows; i++) matrix_fill(lists, own_cells, i, &ret_matrix->rows[i]);
    return STATUS_OK;
}

int matrix_read(const char *path, const struct merge_options *options, struct matrix *ret_matrix)
{
    static const struct merge_options none;
    struct forest *forest = tree_forest_new();
    struct diag *diag = diag_new();
    const struct node *root = merge_case(forest, diag, path, options ? options : &none);
    int code = root && !diag_errors(diag) ? STATUS_OK : status_fail(STATUS_CASE, "%s cannot be read", path);
    if (code) diag_print(diag, stderr, false);
    else if (matrix_combine(root, ret_matrix)) code = status_wrap(STATUS_CASE, "%s: ", path);
    diag_free(diag);
    tree_forest_free(forest);
    return code;
}

void matrix_done(struct matrix *matrix)
{
    for (unsigned i = 0; i < matrix->n_row; i++) {
        for (unsigned k = 0; k < matrix->n_set; k++) mem_free(matrix->rows[i].sets[k]);
        mem_free(matrix->rows[i].sets);
        mem_free(matrix->rows[i].cells);
    }
    mem_free(matrix->rows);
    mem_free(matrix->title);
    *matrix = (struct matrix){0};
}
