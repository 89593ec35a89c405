/* checkpoint.c - a state comes back as it was, to the bit; other cases are refused with what differs; a file is
 * kept until a newer one is whole. With two files as arguments: do they hold the same tiles, fields, time and
 * counts? */
#include "io/checkpoint.h"

#include "case/scene_read.h"
#include "io/rebuild.h"
#include "io/seal.h"
#include "small.h"
#include "solve/advance.h"

#include <fcntl.h>
#include <math.h>
#include <stddef.h>
#include <sys/stat.h>

static const char *const outputs_text = "mine = 1 2 3\n";

static char *write_step(struct small *small, struct checkpoints *checkpoints)
{
    struct notes outputs = {0};
    text_add(&outputs.text, "%s", outputs_text);
    int code = checkpoint_write(checkpoints, small->state, &outputs);
    if (code) print_error("%s\n", status_text());
    assert_int_equal(code, 0);
    text_done(&outputs.text);
    return mem_text(checkpoint_last(checkpoints));
}

static void compare_states(const struct state *a, const struct state *b)
{
    assert_int_equal(a->mesh->n_level, b->mesh->n_level);
    assert_memory_equal(&a->t, &b->t, sizeof a->t);
    assert_memory_equal(&a->dt, &b->dt, sizeof a->dt);
    assert_memory_equal(&a->dt_shrink, &b->dt_shrink, sizeof a->dt_shrink);
    assert_memory_equal(&a->signal, &b->signal, sizeof a->signal);
    assert_memory_equal(&a->counts, &b->counts, offsetof(struct state_counts, regrid_seconds));
    assert_memory_equal(a->level_steps, b->level_steps, sizeof a->level_steps);
    assert_int_equal(a->step, b->step);
    size_t block = a->mesh->n_field * a->mesh->n_cell * sizeof(double);
    for (int l = 0; l < a->mesh->n_level; l++) {
        const struct level *x = &a->mesh->levels[l], *y = &b->mesh->levels[l];
        assert_int_equal(x->n_tile, y->n_tile);
        for (unsigned i = 0; i < x->n_tile; i++) {
            assert_true(x->tiles[i].key == y->tiles[i].key && x->tiles[i].unwanted == y->tiles[i].unwanted);
            assert_memory_equal(x->u_old[i], y->u_old[i], block);
            assert_memory_equal(x->w[i], y->w[i], block);
        }
    }
}

/* Saves the state of `small`, takes it up again and compares. */
static void there_and_back(struct small *small)
{
    struct resume *resume;
    struct state *again;
    double mine[3];
    struct checkpoints *checkpoints = checkpoint_new(small->scene);
    char *path = write_step(small, checkpoints);
    assert_int_equal(resume_open(path, &resume), 0);
    int code = rebuild_state(resume, small->scene, &again);
    if (code) print_error("%s\n", status_text());
    assert_int_equal(code, 0);
    compare_states(small->state, again);
    assert_true(notes_get(&resume->notes, "mine", 3, mine) && mine[2] == 3.0);
    resume_close(resume);
    state_free(again);
    mem_free(path);
    checkpoint_free(checkpoints);
}

static void a_state_comes_back(void **state)
{
    (void)state;
    struct small small;
    small_start(&small, SMALL_AXISYMMETRIC);
    for (int i = 0; i < 5; i++) small_skip(&small, 1e-9 / 3.0);
    small.state->dt_shrink = 0.55;
    small.state->level_steps[0] = 5;
    small.state->counts = (struct state_counts){.cells = 1000001,
                                                .carried = 2,
                                                .fallback = 3,
                                                .relaxed = 4,
                                                .clipped = 5,
                                                .retries = 6,
                                                .regrids = 7,
                                                .limited = 8,
                                                .spread = 9};
    there_and_back(&small);
    small_stop(&small);
}

static void take_steps(struct small *small, int n)
{
    for (int i = 0; i < n; i++) {
        int code = advance_step(small->state, INFINITY);
        if (code) print_error("%s\n", status_text());
        assert_int_equal(code, 0);
    }
}

static void levels_come_back(void **state)
{
    (void)state;
    struct small small;
    small_start_levels(&small, SMALL_LEVELS, 2);
    take_steps(&small, 6);
    assert_int_equal(small.state->mesh->n_level, 3);
    there_and_back(&small);
    small_stop(&small);
}

/* The same laws without closed forms: the pressure is iterated, from the one before. It comes back as it was, not
 * iterated once more. */
static void iterated_pressures_come_back(void **state)
{
    (void)state;
    struct small small;
    struct bulla_module modules[2];
    struct bulla_eos tables[2];
    small_start_levels(&small, SMALL_LEVELS, 1);
    for (int l = 0; l < 2; l++) {
        modules[l] = *small.scene->material[l].eos.module;
        tables[l] = *(const struct bulla_eos *)modules[l].table;
        tables[l].linear = NULL;
        modules[l].table = &tables[l];
        small.scene->material[l].eos.module = &modules[l];
    }
    state_free(small.state);
    assert_int_equal(state_new(small.scene, &small.state), 0);
    assert_false(small.state->model->linear);
    for (int i = 0; i < 4; i++) {
        take_steps(&small, 3);
        there_and_back(&small);
    }
    small_stop(&small);
}

/* The files in checkpoints/, as one sorted text. */
static char *list_files(const struct small *small)
{
    char *folder = small_path(small, "checkpoints"), *command = mem_print("ls '%s' | tr '\\n' ' '", folder);
    char *text = mem_new(1024, 1);
    FILE *list = popen(command, "r");
    assert_true(fread(text, 1, 1023, list) < 1023);
    pclose(list);
    mem_free(command);
    mem_free(folder);
    return text;
}

static void assert_files(const struct small *small, const char *wanted)
{
    char *files = list_files(small);
    assert_string_equal(files, wanted);
    mem_free(files);
}

static void a_few_are_kept(void **state)
{
    (void)state;
    struct small small;
    small_start(&small, SMALL_AXISYMMETRIC "output: {checkpoints: {every: 1 step, keep: 3}}\n");
    struct checkpoints *checkpoints = checkpoint_new(small.scene);
    for (int i = 0; i < 5; i++) {
        small_skip(&small, 1e-9);
        mem_free(write_step(&small, checkpoints));
        mem_free(write_step(&small, checkpoints)); /* the same step again: nothing happens */
    }
    assert_files(&small, "tiny_000003.chk tiny_000004.chk tiny_000005.chk ");
    checkpoint_free(checkpoints);
    small_stop(&small);
}

static void damage(const char *path, off_t at)
{
    unsigned char byte;
    int file = open(path, O_RDWR);
    assert_int_equal(pread(file, &byte, 1, at), 1);
    byte ^= 16;
    assert_int_equal(pwrite(file, &byte, 1, at), 1);
    assert_int_equal(close(file), 0);
}

/* The newest that is whole is taken; a run that went back and on counts as newer than what it left behind. */
static void damaged_files_are_passed_over(void **state)
{
    (void)state;
    struct small small;
    struct resume *resume;
    char *paths[4];
    small_start(&small, SMALL_AXISYMMETRIC "output: {checkpoints: {every: 1 step, keep: 4}}\n");
    char *out = mem_print("%s/out", small.folder);
    assert_int_equal(resume_newest(out, &resume), STATUS_CASE);
    assert_non_null(strstr(status_text(), "there is no whole checkpoint in"));
    struct checkpoints *checkpoints = checkpoint_new(small.scene);
    static const long steps[] = {1, 2, 9, 5};
    for (int i = 0; i < 4; i++) {
        small.state->step = steps[i];
        paths[i] = write_step(&small, checkpoints);
    }
    for (int i = 3; i >= 0; i--) {
        assert_int_equal(resume_newest(out, &resume), 0);
        assert_non_null(strstr(resume->path, strrchr(paths[i], '/')));
        resume_close(resume);
        damage(paths[i], i % 2 ? 100 : 20000);
    }
    assert_int_equal(resume_newest(out, &resume), STATUS_CASE);
    assert_non_null(strstr(status_text(), "no checkpoint in"));
    for (int i = 0; i < 4; i++) mem_free(paths[i]);
    mem_free(out);
    checkpoint_free(checkpoints);
    small_stop(&small);
}

/* A checkpoint that cannot be written leaves the older one, and no draft. */
static void a_failure_leaves_the_older_one(void **state)
{
    (void)state;
    struct small small;
    struct notes nothing = {0};
    small_start(&small, SMALL_AXISYMMETRIC);
    struct checkpoints *checkpoints = checkpoint_new(small.scene);
    mem_free(write_step(&small, checkpoints));
    char *draft = small_path(&small, "checkpoints/tiny_000001.chk.tmp");
    assert_int_equal(symlink("/dev/full", draft), 0);
    small_skip(&small, 1e-9);
    assert_int_equal(checkpoint_write(checkpoints, small.state, &nothing), STATUS_RUN);
    assert_non_null(strstr(status_text(), "no checkpoint of step 1: "));
    assert_non_null(strstr(status_text(), "No space left on device"));
    assert_files(&small, "tiny_000000.chk ");
    mem_free(draft);
    checkpoint_free(checkpoints);
    small_stop(&small);
}

static void other_cases_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *set, *said;
    } others[] = {
        {"domain.cells=[16, 32]", "domain.cells is '32 64' there and '16 32' here"},
        {"domain.geometry=cartesian", "domain.geometry is 'axisymmetric' there and 'cartesian' here"},
        {"domain.upper=[2 mm, 1 mm]", "domain.upper is '0.001 0.001' there and '0.002 0.001' here"},
        {"mesh.tile=8", "mesh.tile is '16' there and '8' here"},
        {"materials.air.eos.gamma=1.5", "materials.air.eos is 'ideal-gas gamma=1.4 cv=717.5 heat-bond=0 "
                                        "entropy-zero=0' there and 'ideal-gas gamma=1.5 "
                                        "cv=717.5 heat-bond=0 entropy-zero=0' here"},
        {"run.until=5 us", NULL},
        {"scheme.cfl=0.1", NULL},
        {"output.history.every=3 steps", NULL},
    };
    struct small small;
    struct resume *resume;
    small_start(&small, SMALL_AXISYMMETRIC);
    struct checkpoints *checkpoints = checkpoint_new(small.scene);
    char *path = write_step(&small, checkpoints), *file = mem_print("%s/tiny.yaml", small.folder);
    assert_int_equal(resume_open(path, &resume), 0);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        const char *sets[] = {others[i].set, others[i].said && i == 1 ? "domain.boundaries.x-=outflow" : NULL, NULL};
        struct scene_options options = {.sets = sets};
        struct scene *scene;
        struct state *again = NULL;
        assert_int_equal(scene_read(file, &options, &scene), 0);
        assert_int_equal(rebuild_state(resume, scene, &again), others[i].said ? STATUS_CASE : 0);
        if (others[i].said && !strstr(status_text(), others[i].said)) print_error("%s\n", status_text());
        if (others[i].said) assert_non_null(strstr(status_text(), others[i].said));
        state_free(again);
        scene_free(scene);
    }
    resume_close(resume);
    mem_free(file);
    mem_free(path);
    checkpoint_free(checkpoints);
    small_stop(&small);
}

/* Lines of notes that belong to the state, not to who wrote it. */
static void keep_state(char *notes)
{
    char *to = notes;
    for (char *line = notes, *end; *line; line = end) {
        end = line + strcspn(line, "\n") + 1;
        if (strncmp(line, "state.", 6) && strncmp(line, "counts.", 7) && strncmp(line, "history.origin", 14)) continue;
        memmove(to, line, (size_t)(end - line));
        to += end - line;
    }
    *to = '\0';
}

/* Bytes of a tile's row; 0: there are no such rows. */
static uint64_t row_bytes(const struct resume *resume, const char *name)
{
    for (unsigned i = 0; i < resume->n_part; i++) {
        const struct seal_part *part = seal_find(&resume->parts[i].seal, name);
        if (part) return part->length / resume->parts[i].n_tile;
    }
    return 0;
}

static bool same_tiles(const struct resume *a, const struct resume *b)
{
    bool same = a->n_level == b->n_level && a->n_all == b->n_all && !memcmp(a->n_tile, b->n_tile, sizeof a->n_tile);
    for (size_t i = 0; same && i < a->n_all; i++)
        same = a->tiles[i].key == b->tiles[i].key && a->tiles[i].unwanted == b->tiles[i].unwanted;
    return same;
}

/* Wherever the rows lie. */
static bool same_rows(const struct resume *a, const struct resume *b, const char *name)
{
    uint64_t bytes = row_bytes(a, name);
    bool same = bytes == row_bytes(b, name);
    char *x = mem_new(bytes + 1, 1), *y = mem_new(bytes + 1, 1);
    for (size_t i = 0; same && bytes && i < a->n_all; i++)
        same = !resume_row(a, name, i, bytes, x) && !resume_row(b, name, i, bytes, y) && !memcmp(x, y, bytes);
    mem_free(x);
    mem_free(y);
    return same;
}

static bool same_notes(struct resume *a, struct resume *b)
{
    keep_state(a->notes.text.at);
    keep_state(b->notes.text.at);
    bool same = *a->notes.text.at && !strcmp(a->notes.text.at, b->notes.text.at);
    if (!same) fprintf(stderr, "%s%s", a->notes.text.at, b->notes.text.at);
    return same;
}

/* With one writer or many. */
static int compare_files(char **paths)
{
    struct resume *files[2];
    for (int i = 0; i < 2; i++)
        if (resume_look(paths[i], &files[i])) return fprintf(stderr, "%s\n", status_text()), 2;
    bool same[] = {same_tiles(files[0], files[1]), same_rows(files[0], files[1], "/u"),
                   same_rows(files[0], files[1], "/p"), same_notes(files[0], files[1])};
    static const char *const names[] = {"/tiles", "/u", "/p", "/notes"};
    int differences = 0;
    for (int k = 0; k < 4; k++) {
        if (!same[k]) fprintf(stderr, "%s differs\n", names[k]);
        differences += !same[k];
    }
    for (int i = 0; i < 2; i++) resume_close(files[i]);
    return differences != 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_state_comes_back),
        cmocka_unit_test(levels_come_back),
        cmocka_unit_test(iterated_pressures_come_back),
        cmocka_unit_test(a_few_are_kept),
        cmocka_unit_test(damaged_files_are_passed_over),
        cmocka_unit_test(a_failure_leaves_the_older_one),
        cmocka_unit_test(other_cases_are_refused),
    };
    if (argc == 3) return compare_files(argv + 1);
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
