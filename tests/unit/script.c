/* Lua in its fence: values, messages with the line of the case file, and hostile scripts. */
#include "case/script_table.h"

#include "base/status.h"
#include "case/script_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct script_host *host;

static int open_host(void **state)
{
    (void)state;
    host = script_host_new();
    script_set_number(host, "R0", 2.0);
    return 0;
}

static int close_host(void **state)
{
    (void)state;
    script_host_free(host);
    return 0;
}

static void assert_says(const char *words)
{
    if (!strstr(status_text(), words)) fail_msg("message is '%s', wanted '%s'", status_text(), words);
}

static double value_of(const char *text)
{
    double value = 0.0;
    if (script_evaluate(host, text, "case.yaml", 7, &value)) fail_msg("%s: %s", text, status_text());
    return value;
}

/* Exact ends, monotone between them, antisymmetric about the surface, with the slope of a tanh of that width there. */
static void steps_smoothly_and_ends(void **state)
{
    (void)state;
    assert_true(value_of("bulla.smooth(0, 0.2)") == 0.5);
    assert_true(value_of("bulla.smooth(0.375, 0.2)") == 0.0 && value_of("bulla.smooth(-0.375, 0.2)") == 1.0);
    assert_true(value_of("bulla.smooth(1e300, 1e-300)") == 0.0 && value_of("bulla.smooth(-1e300, 1e-300)") == 1.0);
    double before = 1.0, slope = (value_of("bulla.smooth(1e-4, 0.2)") - 0.5) / 1e-4;
    for (int i = -400; i <= 400; i++) {
        char text[80];
        snprintf(text, sizeof text, "bulla.smooth(%.17g, 0.2)", 1e-3 * i);
        double here = value_of(text);
        snprintf(text, sizeof text, "bulla.smooth(%.17g, 0.2)", -1e-3 * i);
        if (here > before || fabs(here + value_of(text) - 1.0) > 1e-15) fail_msg("at %d: %.17g", i, here);
        if (fabs(here - 0.5 * (1.0 - tanh(1e-3 * i / 0.2))) > 0.042) fail_msg("far from a tanh at %d", i);
        before = here;
    }
    assert_true(fabs(slope + 1.0 / (2.0 * 0.2)) < 1e-6);
}

static void evaluates(void **state)
{
    (void)state;
    assert_true(value_of("1.1 * R0") == 1.1 * 2.0);
    assert_true(value_of("math.exp(1) -- e") == exp(1.0));
    assert_true(value_of("7 // 2") == 3.0);
    assert_true(value_of("bulla.sphere(3,4,0, 0,0,0, 1)") == 4.0);
    assert_true(value_of("bulla.smooth(-1, 0)") == 1.0 && value_of("bulla.smooth(1, 0)") == 0.0);
    assert_true(fabs(value_of("bulla.lithotripter(0, 3e7)") - 3e7) < 1.0 &&
                value_of("bulla.lithotripter(-1, 3e7)") == 0.0);
    assert_true(value_of("math.tanh(0.5)") == tanh(0.5) && value_of("math.erf(0.5)") == erf(0.5));
    assert_true(value_of("pi - math.pi") == 0.0 && value_of("sqrt(4) + abs(-1) + exp(0) + log(1)") == 4.0);
    assert_true(value_of("min(3, 2) + max(3, 2)") == 5.0);
    script_set_number(host, "R0", 3.0);
    assert_true(value_of("R0") == 3.0);
    script_set_number(host, "R0", 2.0);
}

static void expects(const char *text, const char *words)
{
    double value = -5.0;
    int code =
        script_evaluate(host, text, "a/long/path/that/would/not/fit/into/the/sixty/bytes/of/lua/case.yaml", 7, &value);
    if (code != STATUS_CASE) fail_msg("'%.40s' was accepted and gave %g", text, value);
    assert_true(value == -5.0);
    assert_says("lua/case.yaml:");
    assert_says(words);
}

static void says_what_is_wrong(void **state)
{
    (void)state;
    expects("1 +", "case.yaml:7: unexpected symbol near <eof>");
    expects("1, 5", "')' expected");
    expects("1 end, 2", "near 'end'");
    expects("1\n+ nil", "case.yaml:8: attempt to perform arithmetic on a nil value");
    expects("R1 * 2", "global 'R1'");
    expects("'5'", "gives a string");
    expects("nil", "gives a nil");
    expects("1/0", "gives inf");
    expects("0/0", "nan");
    expects("error('no')", "case.yaml:7: no");
    expects("error({})", "case.yaml:7:");
    expects("assert(false, 'R0 is negative')", "case.yaml:7: R0 is negative");
    expects("math.exp('x')", "case.yaml:7: bad argument");
}

/* Each is one expression that a fence with a hole would let through. */
static void refuses_the_outside(void **state)
{
    (void)state;
    static const char *const names[] = {
        "io",           "os",          "debug",        "package",         "require",     "load",        "loadfile",
        "dofile",       "loadstring",  "setmetatable", "getmetatable",    "rawset",      "rawget",      "rawequal",
        "rawlen",       "next",        "print",        "collectgarbage",  "coroutine",   "utf8",        "_G",
        "_VERSION",     "xpcall",      "math.random",  "math.randomseed", "string.dump", "string.find", "string.gmatch",
        "string.match", "string.gsub", "string.pack",  "table.sort",      "table.move",  "warn",
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[80];
        snprintf(text, sizeof text, "%s == nil and 1 or 0", names[i]);
        if (value_of(text) != 1.0) fail_msg("%s is there", names[i]);
    }
    expects("io.open('/etc/passwd')", "global 'io'");
    expects("('x'):rep(3)", "attempt to index a string value");
    expects("('x').find", "attempt to index a string value");
    expects("'\\27Lua'", "string");
    expects("\033Lua", "case.yaml:7");
    expects("(function() R0 = 1 return 1 end)()", "cannot be written here");
    expects("(function() fresh = 1 return 1 end)()", "cannot be written here");
    expects("(function() math.pi = 3 return 1 end)()", "a field of math ('pi') cannot be written");
    expects("(function() table.insert(math, 3) return 1 end)()", "cannot be changed");
    expects("(function() bulla.smooth = nil return 1 end)()", "cannot be written");
    expects("string.format('%p', 'x')", "%p");
    expects("string.format('%s', {})", "is a table");
    expects("string.format('%d', 1.5)", "case.yaml:7: format: ");
    assert_true(value_of("tostring({}) == 'table' and tostring(1.5) == '1.5' and 1 or 0") == 1.0);
}

/* All of these must come back, and soon. */
static void ends_what_does_not_end(void **state)
{
    (void)state;
    expects("(function()\n while true do end end)()", "case.yaml:8: the script ran for too long");
    expects("(function() while true do pcall(function()\n while true do end end) end end)()", "ran for too long");
    expects("(function() local function f() pcall(f) return f() end return f() end)()", "case.yaml:7: ");
    expects("(function() repeat local ok = pcall(error) until ok end)()", "ran for too long");
    expects("(function() for i = 1, math.huge do pcall(pcall, pcall, error) end end)()", "ran for too long");
    expects("(function() local function f() return 1 + f() end return f() end)()", "case.yaml:7: ");
    assert_true(value_of("1 + 1") == 2.0);
}

/* Calls that each take a few milliseconds are ended sooner or later, many that take little never; a script that was
 * ended is not called again, and the next one starts afresh. */
static void ends_what_takes_too_long_in_all(void **state)
{
    (void)state;
    const struct script *slow, *quick;
    const char *loop =
        "(function() local s = 0 for i = 1, 1e9 do if i > x then break end s = s + i end return s end)()";
    double in = 4e5, out;
    int calls = 0;
    assert_int_equal(script_compile(host, loop, "x", "case.yaml", 4, &slow), 0);
    assert_int_equal(script_compile(host, "x + 1", "x", "case.yaml", 5, &quick), 0);
    while (calls < 100000 && script_call(slow, &in, 1, &out, 1) == STATUS_OK) calls++;
    assert_true(calls > 1 && calls < 100000);
    assert_says("case.yaml:4: the scripts of the case ran for too long: calls that take more than 0.001 s each");
    assert_int_equal(script_call(slow, &in, 1, &out, 1), STATUS_CASE);
    assert_says("case.yaml:4: the script ran for too long before");
    for (int i = 0; i < 1000000; i++) assert_int_equal(script_call(quick, &in, 1, &out, 1), 0);
    script_host_limit(host, 1000.0);
    assert_int_equal(script_compile(host, loop, "x", "case.yaml", 6, &slow), 0);
    for (int i = 0; i < calls + 20; i++)
        if (script_call(slow, &in, 1, &out, 1)) fail_msg("%s", status_text());
    script_host_limit(host, SCRIPT_HOST_TIME);
}

/* A table whose keys 1, 2, 4, ... 2^62 make Lua believe that it has 2^62 elements. */
static void expects_long_list(const char *action)
{
    char text[4000];
    size_t at = (size_t)snprintf(text, sizeof text, "(function() local t = {");
    for (int i = 0; i < 63; i++) at += (size_t)snprintf(text + at, sizeof text - at, "[%lld] = 1, ", 1ll << i);
    snprintf(text + at, sizeof text - at, "} %s return 1 end)()", action);
    expects(text, "the list is too long");
}

static void ends_bombs(void **state)
{
    (void)state;
    expects("string.rep('x', 1e9)", "rep: the text would be longer");
    expects("string.rep('', 1e18) == '' and error('came back')", "came back");
    expects("string.rep('x', 1e18, 'y')", "rep: the text would be longer");
    script_host_limit(host, 20.0); /* memory ends these also where sanitizers make it slow */
    expects("(function() local s = string.rep('x', 1e6) while true do s = s .. s end end)()", "not enough memory");
    expects("(function() local t, s = {}, string.rep('x', 1e5) for i = 1, 1e9 do t[i] = s .. i end end)()",
            "not enough memory");
    script_host_limit(host, SCRIPT_HOST_TIME);
    expects_long_list("table.insert(t, 1, 0)");
    expects_long_list("table.remove(t, 1)");
    expects("#table.concat({}, 'x', 1, 1e15)", "invalid value");
    expects("select('#', table.unpack({}, 1, 1e8))", "too many results");
    expects("(function() local k = {} for i = 1, 1e6 do k[{}] = 1 end return pairs(k) end)()", "case.yaml:7");
    char deep[4001];
    memset(deep, '(', 4000);
    deep[4000] = 0;
    expects(deep, "case.yaml:7");
    assert_true(value_of("R0 + 1") == 3.0);
}

static void sorts_pairs(void **state)
{
    (void)state;
    const char *text =
        "(function() local s = '' for k, v in pairs{b = 1, [10] = 2, a = 3, [2.5] = 4, [-1] = 5, 6, aa = 7} do "
        "s = s .. k .. '=' .. v .. ' ' end assert(s == '-1=5 1=6 2.5=4 10=2 a=3 aa=7 b=1 ', s) return 1 end)()";
    assert_true(value_of(text) == 1.0);
    assert_true(value_of("(function() local n = 0 local t = {a = 1, b = 2, c = 3} for k in pairs(t) do n = n + 1 "
                         "if k == 'a' then t.b = nil end end return n end)()") == 2.0);
    expects("(function() for k in pairs{[true] = 1} do end return 1 end)()", "a key is a boolean");
    assert_true(
        value_of("(function() local t = {1, 2, 4} table.insert(t, 3, 3) table.insert(t, 5) assert(table.concat(t, ' ') "
                 "== '1 2 3 4 5') assert(table.remove(t, 1) == 1 and table.remove(t) == 5 and #t == 3) return t[3] "
                 "end)()") == 4.0);
}

static void compiles_expressions(void **state)
{
    (void)state;
    const struct script *script;
    double in[5] = {1.0, 2.0, 3.0, 4.0, 5.0}, out[2];
    assert_int_equal(script_compile(host, "R0 * x + t", "x,y,z,r,t", "case.yaml", 3, &script), 0);
    assert_false(script_is_constant(script));
    assert_int_equal(script_call(script, in, 5, out, 1), 0);
    assert_true(out[0] == 7.0);
    assert_int_equal(script_compile(host, "1/(x - 1)", "x,y,z,r,t", "case.yaml", 3, &script), 0);
    assert_int_equal(script_call(script, in, 5, out, 1), STATUS_CASE);
    assert_says("case.yaml:3: the script gives inf, not a finite number (called with x,y,z,r,t = 1, 2, 3, 4, 5)");
    assert_int_equal(script_compile(host, "x < 2 and {} or nil", "x", "case.yaml", 3, &script), 0);
    assert_int_equal(script_call(script, in, 1, out, 1), STATUS_CASE);
    assert_says("gives a table");
    assert_int_equal(script_compile(host, "x +* 2", "x", "case.yaml", 30, &script), STATUS_CASE);
    assert_says("case.yaml:30: unexpected symbol near '*'");
}

static void knows_constants(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool constant;
    } samples[] = {
        {"1.1 * R0", true}, {"math.max(R0, 1)", true}, {"xx + _x", true},
        {"0x10", true},     {"math.t", true},          {"t", false},
        {"R0*t", false},    {"1 ..t", false},          {"f(x)", false},
        {"(y)", false},     {"a.r+r", false},          {"x.a", false},
    };
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        const struct script *script;
        assert_int_equal(script_compile(host, samples[i].text, "x, y,z,r,t", "case.yaml", 1, &script), 0);
        if (script_is_constant(script) != samples[i].constant) fail_msg("%s", samples[i].text);
    }
}

static void compiles_functions(void **state)
{
    (void)state;
    const struct script *script;
    double in[3] = {1.0, 2.0, 3.0}, out[3];
    assert_int_equal(script_compile_function(host, "-- u\nfunction(x, y, z) return x, y + R0, z end", "f.lua", 1,
                                             &script),
                     0);
    assert_int_equal(script_call(script, in, 3, out, 3), 0);
    assert_true(out[0] == 1.0 && out[1] == 4.0 && out[2] == 3.0);
    assert_int_equal(script_call(script, in, 2, out, 3), STATUS_CASE);
    assert_says("f.lua:1: a number is needed here, but the script gives a nil as result 3 of 3 (called with 1, 2)");
    const char *helper = "half = 0.5\nfunction scale(x) return half * x end\nreturn function(x) return scale(x) end";
    assert_int_equal(script_compile_function(host, helper, "f.lua", 1, &script), 0);
    assert_int_equal(script_call(script, in, 1, out, 1), 0);
    assert_true(out[0] == 0.5);
    assert_true(value_of("half == nil and scale == nil and 1 or 0") == 1.0); /* a chunk's globals are its own */
    const char *writes = "n = 0\nreturn function(x)\n n = n + 1\n return n end";
    assert_int_equal(script_compile_function(host, writes, "case.yaml", 40, &script), 0);
    assert_int_equal(script_call(script, in, 1, out, 1), STATUS_CASE);
    assert_says("case.yaml:42: a global ('n') cannot be written here");
    assert_int_equal(script_compile_function(host, "function f(x) return x end", "f.lua", 5, &script), STATUS_CASE);
    assert_says("f.lua:5: the script must return a function");
    assert_int_equal(script_compile_function(host, "x = = 1", "f.lua", 5, &script), STATUS_CASE);
    assert_says("f.lua:5: unexpected symbol");
    assert_int_equal(script_compile_function(host, "while true do end", "f.lua", 5, &script), STATUS_CASE);
    assert_says("f.lua:5: the script"); /* or all of them, where the machine is so slow that they have spent the time */
    assert_says("ran for too long");
}

static int call_table(const char *text, double *out)
{
    static const char *const list[] = {
        "pressure",  "density",    "density.water", "alpha.water",
        "alpha.air", "velocity.1", "velocity.2",    "alpha.a_material_whose_name_is_longer_than_forty_bytes",
        NULL};
    const struct script_table *names = script_table(host, list, 8);
    assert_ptr_equal(names, script_table(host, list, 8));
    const struct script *script;
    double in[3] = {1.0, 2.0, 3.0};
    if (script_compile_function(host, text, "case.yaml", 9, &script)) fail_msg("%s", status_text());
    return script_table_call(script, in, 3, names, out);
}

static void reads_tables(void **state)
{
    (void)state;
    double out[8];
    assert_int_equal(
        call_table("function(x, y) return {pressure = x, density = {water = y}, velocity = {0, 7}, alpha = {air = 1, "
                   "a_material_whose_name_is_longer_than_forty_bytes = 0.5}} end",
                   out),
        0);
    assert_true(out[0] == 1.0 && isnan(out[1]) && out[2] == 2.0 && isnan(out[3]) && out[4] == 1.0);
    assert_true(out[5] == 0.0 && out[6] == 7.0 && out[7] == 0.5);
    assert_int_equal(call_table("function() return {density = 5} end", out), 0);
    assert_true(out[1] == 5.0);
    static const char *const wrong[][2] = {
        {"return {presure = 1}", "unknown field 'presure'; did you mean 'pressure'?"},
        {"return {alpha = {watr = 1}}", "unknown field 'alpha.watr'; did you mean 'alpha.water'?"},
        {"return {velocity = {1, 2, 3}}", "unknown field 'velocity.3'"},
        {"return {pressure = {1}}", "unknown field 'pressure.1'"},
        {"return {alpha = 1}", "unknown field 'alpha'"},
        {"return {1, 2}", "unknown field '1'"},
        {"return {[true] = 1}", "unknown field '(boolean)'"},
        {"return {alpha = {water = {1}}}", "gives a table, in the field 'alpha.water'"},
        {"return {pressure = '1'}", "gives a string, in the field 'pressure'"},
        {"return {pressure = 0/0}", "nan, not a finite number, in the field 'pressure'"},
        {"return 5", "must return a table of named fields, but gives a number"},
        {"return nil", "but gives a nil"},
        {"local t = {} t.alpha = t return t", "unknown field 'alpha.alpha'"},
        {"\nlocal a = nil return a.b", "case.yaml:10: attempt to index a nil value (local 'a') (called with 1, 2, 3)"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[200];
        snprintf(text, sizeof text, "function() %s end", wrong[i][0]);
        assert_int_equal(call_table(text, out), STATUS_CASE);
        assert_says("case.yaml:");
        assert_says(wrong[i][1]);
    }
}

static void keeps_hosts_apart(void **state)
{
    (void)state;
    struct script_host *other = script_host_new();
    double value;
    assert_int_equal(script_evaluate(other, "R0", "b.yaml", 1, &value), STATUS_CASE);
    script_host_free(other);
    expects("(function() while true do end end)()", "ran for too long"); /* the guard outlives the other host */
    script_host_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_what_takes_too_long_in_all), /* first: after each call that was ended, less is allowed */
        cmocka_unit_test(evaluates),
        cmocka_unit_test(steps_smoothly_and_ends),
        cmocka_unit_test(says_what_is_wrong),
        cmocka_unit_test(refuses_the_outside),
        cmocka_unit_test(ends_bombs),
        cmocka_unit_test(ends_what_does_not_end),
        cmocka_unit_test(sorts_pairs),
        cmocka_unit_test(compiles_expressions),
        cmocka_unit_test(knows_constants),
        cmocka_unit_test(compiles_functions),
        cmocka_unit_test(reads_tables),
        cmocka_unit_test(keeps_hosts_apart),
    };
    return cmocka_run_group_tests(tests, open_host, close_host);
}
