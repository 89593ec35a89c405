/* registry.c - finding, vetting and opening modules: built-in ones, a good foreign one, and one
 * hostile module per flaw (tests/hostile/hostile.c), each refused with one line that says why. */
#include "plug/registry.h"

#include "base/mem.h"
#include "base/status.h"
#include "plug/instance.h"
#include "plug/vet.h"

#include <dlfcn.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char *hostile_path(const char *flaw)
{
    return mem_print("%s/tests/hostile/%s.so", getenv("BULLA_BUILD"), flaw);
}

static char *builtin_path(const char *name)
{
    return mem_print("%s/lib/bulla/modules/%s.so", getenv("BULLA_BUILD"), name);
}

static int start(void **state)
{
    (void)state;
    return registry_init();
}

static int stop(void **state)
{
    (void)state;
    registry_done();
    return 0;
}

/* All that is built in, sorted as the registry sorts; one to a line, as others will come. */
/* clang-format off */
static const char *const builtin[][2] = {
    {"conductivity", "constant"},
    {"conductivity", "powers"},
    {"conductivity", "sutherland"},
    {"constitutive", "fung"},
    {"constitutive", "gent"},
    {"constitutive", "mooney-rivlin"},
    {"constitutive", "neo-hookean"},
    {"constitutive", "quadratic"},
    {"damage", "energy"},
    {"damage", "johnson-cook"},
    {"damage", "strain"},
    {"damage", "stretch"},
    {"damage", "tension"},
    {"damage", "tuler-butcher"},
    {"eos", "cochran-chan"},
    {"eos", "helmholtz-air"},
    {"eos", "iapws95"},
    {"eos", "iapws95-vapour"},
    {"eos", "ideal-gas"},
    {"eos", "jwl"},
    {"eos", "mnasg"},
    {"eos", "modified-tait"},
    {"eos", "nasg"},
    {"eos", "peng-robinson"},
    {"eos", "rkpr"},
    {"eos", "stiffened-gas"},
    {"eos", "table"},
    {"eos", "tait"},
    {"inelastic", "johnson-cook"},
    {"inelastic", "power-law"},
    {"inelastic", "steinberg-guinan"},
    {"inelastic", "von-mises"},
    {"limiter", "koren"},
    {"limiter", "mc"},
    {"limiter", "minmod"},
    {"limiter", "superbee"},
    {"limiter", "thinc"},
    {"limiter", "van-albada"},
    {"limiter", "van-leer"},
    {"reconstruction", "muscl"},
    {"reconstruction", "weno5-z"},
    {"riemann", "hll"},
    {"riemann", "hllc"},
    {"riemann", "hllc-release"},
    {"riemann", "hlld"},
    {"riemann", "rusanov"},
    {"viscosity", "carreau"},
    {"viscosity", "casson"},
    {"viscosity", "cross"},
    {"viscosity", "herschel-bulkley"},
    {"viscosity", "newtonian"},
    {"viscosity", "power"},
    {"viscosity", "sutherland"},
    {"viscosity", "vogel"},
};
/* clang-format on */
enum { BUILTIN = sizeof builtin / sizeof *builtin };

static void test_builtin(void **state)
{
    (void)state;
    assert_int_equal(registry_count(), BUILTIN);
    for (size_t i = 0; i < BUILTIN; i++) {
        const struct registry_entry *entry = registry_at(i);
        assert_string_equal(entry->module->kind, builtin[i][0]);
        assert_string_equal(entry->module->name, builtin[i][1]);
        assert_int_equal(entry->path[0], '/');
        assert_true(entry->hash != 0);
        assert_ptr_equal(registry_find(builtin[i][0], builtin[i][1]), entry);
        char *file = mem_print("/%s-%s.so", builtin[i][0], builtin[i][1]);
        assert_string_equal(strrchr(entry->path, '/'), file); /* by this it is found before it is loaded */
        mem_free(file);
    }
    assert_null(registry_at(BUILTIN));
    assert_null(registry_find("eos", "minmod"));
    assert_null(registry_find("limiter", "zzz"));
}

/* Is this built-in module in the process? */
static bool is_loaded(const char *name)
{
    char *path = builtin_path(name);
    void *handle = dlopen(path, RTLD_NOW | RTLD_NOLOAD);
    if (handle) dlclose(handle);
    mem_free(path);
    return handle != NULL;
}

/* What nobody asks for is not loaded; a list of names asks for all. */
static void test_waits(void **state)
{
    (void)state;
    registry_done();
    assert_int_equal(registry_init(), 0);
    assert_false(registry_is_empty());
    assert_false(is_loaded("eos-jwl"));
    assert_non_null(registry_find("eos", "ideal-gas"));
    assert_true(is_loaded("eos-ideal-gas"));
    assert_false(is_loaded("eos-jwl"));
    assert_non_null(registry_names("eos")[0]);
    assert_true(is_loaded("eos-jwl"));
    registry_done();
    assert_true(registry_is_empty());
    assert_int_equal(registry_init(), 0);
}

static void test_names(void **state)
{
    (void)state;
    const char *const *names = registry_names("riemann");
    assert_string_equal(names[0], "hll");
    assert_string_equal(names[1], "hllc");
    assert_string_equal(names[2], "hllc-release");
    assert_string_equal(names[3], "hlld");
    assert_string_equal(names[4], "rusanov");
    assert_null(names[5]);
    assert_null(registry_names("weather")[0]);
}

static void test_params(void **state)
{
    (void)state;
    const struct bulla_module *module = registry_find("eos", "mnasg")->module;
    assert_int_equal(instance_param_count(module), 6);
    assert_int_equal(instance_param_find(module, "covolume"), 2);
    assert_int_equal(instance_param_find(module, "co-volume"), -1);
    assert_int_equal(instance_param_count(registry_find("limiter", "mc")->module), 0);
    assert_int_equal(instance_param_find(registry_find("limiter", "mc")->module, "x"), -1);
}

/* Loading a file twice, or a byte-for-byte copy of it, changes nothing. */
static void test_same_again(void **state)
{
    (void)state;
    size_t count = registry_count();
    char *path = builtin_path("limiter-mc");
    assert_int_equal(registry_load(path), 0);
    assert_int_equal(registry_count(), count);
    mem_free(path);
}

struct refusal {
    const char *flaw, *says;
};

static const struct refusal refusals[] = {
    {"bad_magic", "is no module: magic number 0x12345678"},
    {"old_abi", "the older module interface 0; this program has 1"},
    {"new_abi", "a newer module interface 2; this program has 1"},
    {"short_size", "descriptor of 40 bytes"},
    {"no_table", "no table of functions"},
    {"short_table", "table of functions of size 4; kind limiter needs"},
    {"null_slot", "has no function 'slope', which kind limiter needs"},
    {"new_flags", "has the flags 0x4; this program knows 0x3"},
    {"null_edges", "has no function 'edges', which BULLA_TWO_SIDED needs"},
    {"unknown_kind", "unknown kind 'weather'; kinds are boundary, conductivity, constitutive, damage, eos, field, "
                     "inelastic, limiter, reconstruction, riemann, viscosity"},
    {"bad_name", "'Bad_Name'; names are lower case with hyphens"},
    {"no_doc", "lacks its doc"},
    {"param_twice", "parameter 'strength' twice"},
    {"param_upper", "parameter 'Strength'; names are lower case"},
    {"param_reserved", "parameter 'type'; that key is reserved"},
    {"param_range", "parameter 'strength' with the range 5 to 2"},
    {"param_fallback", "the default 3 outside 0 to 2"},
    {"param_unit", "parameter 'strength' without a unit"},
    {"param_choices", "bad choices 'one||two'"},
    {"preset_range", "preset 'usual' with strength = 7 outside 0 to 2"},
    {"duplicate", "brings limiter 'minmod', which"},
    {"no_symbol", "no symbol bulla_module"},
    {"small_symbol", "is no module: its bulla_module has 4 bytes"},
    {"missing_function", "nobody_defines_this"},
    {"aborts", "is damaged: trying to load it ended with SIGABRT"},
#ifdef __SSE2__
    {"flush_to_zero", "changes the floating-point mode"},
#endif
};

/* One line that names the file and says what is wrong. */
static void assert_refused(const char *path, const char *says)
{
    size_t count = registry_count();
    assert_int_equal(registry_load(path), STATUS_CASE);
    assert_non_null(strstr(status_text(), path));
    if (!strstr(status_text(), says)) fail_msg("'%s' does not say '%s'", status_text(), says);
    assert_null(strchr(status_text(), '\n'));
    assert_int_equal(registry_count(), count);
}

static void test_hostile(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        char *path = hostile_path(refusals[i].flaw);
        assert_refused(path, refusals[i].says);
        mem_free(path);
    }
}

/* A law of rupture stands beside keys of the program's own. */
static void test_taken(void **state)
{
    (void)state;
    static const char *const names[] = {"time", "opens", "void-pressure", "opens-at"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct bulla_module module = *registry_find("damage", "tension")->module;
        struct bulla_param params[] = {module.params[0], {0}};
        params[0].name = names[i];
        module.params = params;
        module.presets = NULL;
        assert_int_equal(vet_module(&module, sizeof module), i < 3 ? STATUS_CASE : STATUS_OK);
        if (i < 3) assert_non_null(strstr(status_text(), "that key is reserved"));
    }
}

static void test_duplicate_names_both(void **state)
{
    (void)state;
    char *path = hostile_path("duplicate"), *first = builtin_path("limiter-minmod");
    assert_refused(path, first);
    mem_free(path);
    mem_free(first);
}

/* Small numbers must still be there after the refusal; linking with -ffast-math adds start-up code
 * that removes them with some compilers (others leave it out of shared objects: then it loads). */
static void test_fast_math(void **state)
{
    (void)state;
    volatile double tiny = 1e-300;
    char *path = hostile_path("fast_math");
    int code = registry_load(path);
    if (code) assert_non_null(strstr(status_text(), "changes the floating-point mode"));
    assert_true(tiny * 1e-13 > 0.0);
    char *other = hostile_path("flush_to_zero");
    assert_int_equal(registry_load(other), STATUS_CASE);
    assert_true(tiny * 1e-13 > 0.0);
    mem_free(path);
    mem_free(other);
    registry_done();
    assert_int_equal(registry_init(), 0);
}

static void write_file(const char *path, const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static size_t read_file(const char *path, char **ret_bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    size_t size = (size_t)ftell(file);
    rewind(file);
    *ret_bytes = mem_new(size, 1);
    assert_int_equal(fread(*ret_bytes, 1, size, file), size);
    fclose(file);
    return size;
}

/* A good module cut at many lengths, and with damaged headers: refused, never a signal. */
static void test_truncated(void **state)
{
    (void)state;
    char *path = hostile_path("none"), *cut = hostile_path("truncated"), *bytes;
    size_t size = read_file(path, &bytes);
    for (size_t length = 0; length < size; length += 1 + length / 3) {
        write_file(cut, bytes, length);
        assert_refused(cut, length < 64 ? "is not a shared object" : "is truncated or damaged");
    }
    write_file(cut, bytes, size - 1);
    assert_refused(cut, "is truncated or damaged");
    bytes[18] ^= 1; /* e_machine */
    write_file(cut, bytes, size);
    assert_refused(cut, "another kind of machine");
    unlink(cut);
    mem_free(bytes);
    mem_free(cut);
    mem_free(path);
}

static void test_no_file(void **state)
{
    (void)state;
    assert_refused("/nonexistent/x.so", "No such file");
    assert_refused("/dev/null", "is not a file");
    char *path = mem_print("%s/CMakeLists.txt", getenv("BULLA_SOURCE"));
    assert_refused(path, "is not a shared object");
    mem_free(path);
}

/* The module without a flaw loads: so the refusals above are due to the flaws. */
static void test_good(void **state)
{
    (void)state;
    char *path = hostile_path("none");
    assert_int_equal(registry_load(path), 0);
    const struct registry_entry *entry = registry_find("limiter", "hostile");
    assert_non_null(entry);
    assert_string_equal(entry->path, path);
    struct bulla_value values[3] = {{1.5, NULL}, {0.0, "two"}, {0.0, "text"}};
    struct instance instance = {0};
    assert_int_equal(instance_open(entry->module, values, &instance), 0);
    assert_true(instance.values[0].number == 1.5);
    assert_string_equal(instance.values[1].text, "two");
    assert_ptr_not_equal(instance.values[1].text, values[1].text);
    instance_done(&instance);
    instance_done(&instance);
    mem_free(path);
    registry_done();
    assert_int_equal(registry_init(), 0);
    assert_null(registry_find("limiter", "hostile"));
}

static void test_open_fails(void **state)
{
    (void)state;
    char *path = hostile_path("open_fails");
    assert_int_equal(registry_load(path), 0);
    struct bulla_value values[3] = {{1.5, NULL}, {0.0, "two"}, {0.0, "text"}};
    struct instance instance = {0};
    const struct bulla_module *module = registry_find("limiter", "hostile")->module;
    assert_int_equal(instance_open(module, values, &instance), STATUS_CASE);
    assert_string_equal(status_text(), "limiter 'hostile': the moon is not full");
    assert_null(instance.module);
    mem_free(path);
}

/* Folders are searched in order and the first file with a name keeps it; a folder that is not there,
 * and files that are refused, cost a warning. The program's own folder comes last. */
static void test_search_order(void **state)
{
    (void)state;
    char *before = mem_text(getenv("BULLA_MODULE_PATH"));
    char *path = mem_print("/nonexistent::%s/tests/hostile", getenv("BULLA_BUILD")), *first = hostile_path("duplicate");
    registry_done();
    setenv("BULLA_MODULE_PATH", path, 1);
    assert_int_equal(registry_init(), 0);
    assert_non_null(registry_find("limiter", "hostile"));
    assert_string_equal(registry_find("limiter", "minmod")->path, first);
    assert_non_null(strstr(registry_find("limiter", "mc")->path, "/lib/bulla/modules/"));
    assert_int_equal(registry_count(), BUILTIN + 1);
    setenv("BULLA_MODULE_PATH", before, 1);
    registry_done();
    assert_int_equal(registry_init(), 0);
    assert_int_equal(registry_count(), BUILTIN);
    mem_free(before);
    mem_free(path);
    mem_free(first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_builtin),    cmocka_unit_test(test_waits),
        cmocka_unit_test(test_names),      cmocka_unit_test(test_params),
        cmocka_unit_test(test_same_again), cmocka_unit_test(test_hostile),
        cmocka_unit_test(test_taken),      cmocka_unit_test(test_duplicate_names_both),
        cmocka_unit_test(test_fast_math),  cmocka_unit_test(test_truncated),
        cmocka_unit_test(test_no_file),    cmocka_unit_test(test_good),
        cmocka_unit_test(test_open_fails), cmocka_unit_test(test_search_order),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
