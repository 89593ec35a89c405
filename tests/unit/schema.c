/* The schema of case files: made from the tables, and the file in schemas/ is that of today. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/text.h"
#include "case/schema.h"
#include "plug/registry.h"

#include <jansson.h>
#include <stdio.h>
#include <string.h>

static json_t *schema;

static json_t *at(const char *path)
{
    char name[256];
    json_t *here = schema;
    while (here && *path) {
        size_t length = strcspn(path, "/");
        snprintf(name, sizeof name, "%.*s", (int)length, path);
        here = json_is_array(here) ? json_array_get(here, (size_t)(name[0] - '0')) : json_object_get(here, name);
        path += length + (path[length] == '/');
    }
    if (!here) fail_msg("the schema has nothing at %s", path);
    return here;
}

static const char *text_at(const char *path)
{
    const char *text = json_string_value(at(path));
    assert_non_null(text);
    return text;
}

static void keys_carry_their_table_rows(void **state)
{
    (void)state;
    assert_true(json_number_value(at("definitions/mesh/properties/buffer/default")) == 4.0);
    assert_true(json_number_value(at("definitions/scheme/properties/cfl/maximum")) == 1.0);
    assert_string_equal(text_at("definitions/domain/properties/geometry/enum/1"), "axisymmetric");
    assert_non_null(strstr(text_at("definitions/run/properties/until/markdownDescription"), "Unit: `s`"));
    assert_non_null(
        strstr(text_at("definitions/run/properties/until/patternErrorMessage"), "a time above 0 is needed"));
    assert_true(json_is_false(at("definitions/domain/additionalProperties")));
    assert_string_equal(text_at("definitions/case/required/0"), "bulla");
    assert_null(json_object_get(at("definitions/case-part"), "required"));
}

/* Keys of modules come from the modules. */
static void modules_are_cases(void **state)
{
    (void)state;
    bool found = false;
    size_t i;
    json_t *branch;
    json_array_foreach(at("definitions/eos/allOf"), i, branch)
    {
        json_t *name =
            json_object_get(json_object_get(json_object_get(json_object_get(branch, "if"), "properties"), "type"),
                            "const");
        json_t *keys = json_object_get(json_object_get(branch, "then"), "properties");
        if (name && strcmp(json_string_value(name), "stiffened-gas") == 0)
            found = json_object_get(keys, "p-inf") != NULL;
    }
    assert_true(found);
}

static void every_reference_has_a_definition(void **state)
{
    (void)state;
    char *text = json_dumps(schema, 0);
    unsigned count = 0;
    static const char mark[] = "#/definitions/";
    for (const char *from = text; (from = strstr(from, mark)) != NULL; count++) {
        char name[128];
        from += sizeof mark - 1;
        snprintf(name, sizeof name, "%.*s", (int)strcspn(from, "\""), from);
        if (!json_object_get(at("definitions"), name)) fail_msg("no definition '%s'", name);
    }
    assert_true(count > 20);
    free(text);
}

/* Rules that stand beside the tables are JSON, and each is there. */
static void rules_are_read(void **state)
{
    (void)state;
    char *text = json_dumps(schema, 0);
    if (strstr(text, "wrong-rules")) fail_msg("rules that are no JSON: %.120s", strstr(text, "wrong-rules"));
    free(text);
    assert_string_equal(text_at("definitions/expectation/allOf/1/dependencies/norm/0"), "field");
    assert_null(json_object_get(at("definitions/expectation-part"), "allOf"));
}

static void the_file_is_current(void **state)
{
    (void)state;
    struct text have = {0};
    char block[4096], *want = schema_text();
    FILE *file = fopen("schemas/case.schema.json", "rb");
    assert_non_null(file);
    for (size_t got; (got = fread(block, 1, sizeof block, file)) > 0;) text_add_n(&have, block, got);
    fclose(file);
    if (strcmp(have.at, want) != 0) fail_msg("schemas/case.schema.json is old: bulla schema >schemas/case.schema.json");
    text_done(&have);
    mem_free(want);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_carry_their_table_rows),
        cmocka_unit_test(modules_are_cases),
        cmocka_unit_test(every_reference_has_a_definition),
        cmocka_unit_test(rules_are_read),
        cmocka_unit_test(the_file_is_current),
    };
    if (registry_init()) return 1;
    char *text = schema_text();
    schema = json_loads(text, 0, NULL);
    mem_free(text);
    int failed = schema ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
    json_decref(schema);
    return failed;
}
