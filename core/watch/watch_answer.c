/* watch_answer.c - see watch_answer.h. */
#include "watch/watch_answer.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "watch/watch_look.h"
#include "watch/watch_page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ANSWER_OK = 200, ANSWER_REFUSED = 403, ANSWER_UNKNOWN = 404, ANSWER_METHOD = 405, ANSWER_FAILED = 500 };

static void watch_answer_text(struct watch_answer *answer, unsigned status, const char *text)
{
    *answer = (struct watch_answer){status, "text/plain; charset=utf-8", strlen(text), mem_text(text), ""};
}

/* Takes the object; NULL: it is not there. */
static void watch_answer_json(struct watch_answer *answer, json_t *object)
{
    char *text = object ? json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(object);
    if (!text) {
        watch_answer_text(answer, ANSWER_UNKNOWN, "not here\n");
        return;
    }
    *answer = (struct watch_answer){ANSWER_OK, "application/json", strlen(text), mem_text(text), ""};
    free(text);
}

static void watch_answer_page(struct watch_answer_world *world, const struct watch_answer_request *request,
                              struct watch_answer *answer)
{
    struct text page = {0};
    const char *at = watch_page_text;
    (void)world;
    (void)request;
    if (watch_gate_token(answer->nonce)) {
        watch_answer_text(answer, ANSWER_FAILED, "no random numbers\n");
        return;
    }
    for (const char *mark; (mark = strstr(at, WATCH_PAGE_NONCE)); at = mark + strlen(WATCH_PAGE_NONCE)) {
        text_add_n(&page, at, (size_t)(mark - at));
        text_add(&page, "%s", answer->nonce);
    }
    text_add(&page, "%s", at);
    answer->status = ANSWER_OK;
    answer->type = "text/html; charset=utf-8";
    answer->n = page.length;
    answer->bytes = page.at;
}

static void watch_answer_state(struct watch_answer_world *world, const struct watch_answer_request *request,
                               struct watch_answer *answer)
{
    json_t *list = json_array();
    (void)request;
    watch_runs_look(&world->runs);
    for (unsigned i = 0; i < world->runs.n; i++)
        json_array_append_new(list, watch_look_short(world->runs.paths[i], world->runs.names[i]));
    watch_answer_json(answer, json_pack("{s:s, s:o}", "version", BULLA_VERSION, "runs", list));
}

/* The run that a request names; false, and an answer, if there is no such. */
static bool watch_answer_run_of(const struct watch_answer_world *world, const struct watch_answer_request *request,
                                struct watch_answer *answer, unsigned long *ret_run)
{
    if (request->number(request->data, "run", ret_run) && *ret_run < world->runs.n) return true;
    watch_answer_json(answer, NULL);
    return false;
}

static void watch_answer_run(struct watch_answer_world *world, const struct watch_answer_request *request,
                             struct watch_answer *answer)
{
    unsigned long run;
    if (watch_answer_run_of(world, request, answer, &run))
        watch_answer_json(answer, watch_look_whole(world->runs.paths[run], world->runs.names[run]));
}

static void watch_answer_curve(struct watch_answer_world *world, const struct watch_answer_request *request,
                               struct watch_answer *answer)
{
    unsigned long run, column;
    if (!watch_answer_run_of(world, request, answer, &run)) return;
    bool named = request->number(request->data, "column", &column);
    watch_answer_json(answer, named ? watch_curve_look(&world->curves, world->runs.paths[run], column) : NULL);
}

/* The others whose scale a picture shares: run1, snapshot1, run2, ... after the first of `places`. false: one of them
 * is not there. */
static bool watch_answer_like(const struct watch_answer_world *world, const struct watch_answer_request *request,
                              struct watch_picture_place *places, unsigned *n)
{
    for (; *n < WATCH_PICTURE_LIKE; ++*n) {
        char name[2][16];
        unsigned long run;
        snprintf(name[0], sizeof name[0], "run%u", *n);
        snprintf(name[1], sizeof name[1], "snapshot%u", *n);
        if (!request->number(request->data, name[0], &run)) return true;
        if (run >= world->runs.n || !request->number(request->data, name[1], &places[*n].snapshot)) return false;
        places[*n].directory = world->runs.paths[run];
    }
    return true;
}

static void watch_answer_picture(struct watch_answer_world *world, const struct watch_answer_request *request,
                                 struct watch_answer *answer)
{
    struct watch_picture_place places[WATCH_PICTURE_LIKE];
    unsigned long run, field;
    unsigned n = 1;
    const struct watch_picture *picture;
    if (!watch_answer_run_of(world, request, answer, &run)) return;
    int code = STATUS_CASE;
    places[0].directory = world->runs.paths[run];
    bool named = request->number(request->data, "snapshot", &places[0].snapshot) &&
                 request->number(request->data, "field", &field);
    if (named && watch_answer_like(world, request, places, &n))
        code = watch_picture_take(&world->pictures, places, n, field, &picture);
    if (code == STATUS_CASE) watch_answer_json(answer, NULL);
    else if (code) watch_answer_text(answer, ANSWER_FAILED, "this picture cannot be drawn\n");
    else {
        *answer = (struct watch_answer){ANSWER_OK, "image/png", picture->n, mem_new(picture->n, 1), ""};
        memcpy(answer->bytes, picture->bytes, picture->n);
    }
}

static const struct watch_answer_row {
    const char *word;
    void (*make)(struct watch_answer_world *world, const struct watch_answer_request *request,
                 struct watch_answer *answer);
} watch_answer_rows[] = {{"", watch_answer_page},
                         {"state", watch_answer_state},
                         {"run", watch_answer_run},
                         {"curve", watch_answer_curve},
                         {"picture", watch_answer_picture}};

void watch_answer_make(struct watch_answer_world *world, const struct watch_answer_request *request,
                       struct watch_answer *ret_answer)
{
    const struct watch_answer_row *row = NULL;
    const char *word = watch_gate_open(request->path, world->token);
    for (size_t i = 0; word && i < sizeof watch_answer_rows / sizeof *watch_answer_rows; i++)
        if (strcmp(word, watch_answer_rows[i].word) == 0) row = &watch_answer_rows[i];
    *ret_answer = (struct watch_answer){0};
    if (!watch_gate_is_local(request->host))
        watch_answer_text(ret_answer, ANSWER_REFUSED, "this page is for this machine only\n");
    else if (strcmp(request->method, "GET") != 0) watch_answer_text(ret_answer, ANSWER_METHOD, "GET only\n");
    else if (!row)
        watch_answer_text(ret_answer, ANSWER_UNKNOWN, "not here: the address that bulla watch has printed is whole\n");
    else row->make(world, request, ret_answer);
}

char *watch_answer_policy(const struct watch_answer *answer)
{
    static const char closed[] = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
    if (!*answer->nonce) return mem_text(closed);
    return mem_print("%s; img-src 'self' data:; connect-src 'self'; script-src 'nonce-%s'; style-src 'nonce-%s'",
                     closed, answer->nonce, answer->nonce);
}
