/* script.c - the Lua sandbox: an expression, a function, a table of fields; called with numbers. */
#include "case/script.h"
#include "case/script_host.h"
#include "case/script_table.h"
#include "fuzz.h"

static const double script_in[] = {0.25, -1.0, 3.0, 1.5, 1e-6};

static void script_try_calls(struct script_host *host, const struct script *script)
{
    static const char *const fields[] = {"pressure", "velocity.1", "velocity.2", "fractions.air"};
    double out[4];
    bool yes;
    script_call(script, script_in, 5, out, 1);
    script_call(script, script_in, 3, out, 4);
    script_test(script, script_in, 5, &yes);
    script_table_call(script, script_in, 4, script_table(host, fields, 4), out);
}

FUZZ(data, size)
{
    char *text = fuzz_text(data, size);
    struct script_host *host = script_host_new();
    const struct script *script;
    double value;
    script_set_number(host, "R0", 2.0);
    script_evaluate(host, text, "case.yaml", 3, &value);
    if (script_compile(host, text, "x,y,z,r,t", "case.yaml", 1, &script) == 0) script_try_calls(host, script);
    if (script_compile_function(host, text, "case.yaml", 1, &script) == 0) script_try_calls(host, script);
    script_host_free(host);
    free(text);
    return 0;
}
