/* contract.c - see contract.h. */
#include "suite/contract.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void contract_doing(struct contract *contract, const char *what)
{
    if (contract->progress) snprintf(contract->progress, CONTRACT_NAME, "%s", what);
}

void contract_begin(struct contract *contract, const char *check, double limit)
{
    unsigned at = 0;
    while (at < contract->n_row && strcmp(contract->rows[at].check, check) != 0) at++;
    if (at == CONTRACT_ROWS) at--;
    if (at == contract->n_row) contract->rows[contract->n_row++] = (struct contract_row){.check = check};
    contract->rows[at].limit = limit;
    contract->at = at;
}

/* Counts a value; true if it is the worst so far, whose place is then to be noted. */
static bool contract_count(struct contract_row *row, double error)
{
    bool worst = row->points++ == 0 || !(error <= row->worst);
    if (!worst) return false;
    row->worst = isnan(error) ? INFINITY : error;
    row->compared = false;
    return true;
}

void contract_error(struct contract *contract, double error, const char *format, ...)
{
    struct contract_row *row = &contract->rows[contract->at];
    if (!contract_count(row, error)) return;
    int used = *contract->preset ? snprintf(row->where, sizeof row->where, "%s: ", contract->preset) : 0;
    va_list list;
    va_start(list, format);
    vsnprintf(row->where + used, sizeof row->where - (size_t)used, format, list);
    va_end(list);
}

void contract_near(struct contract *contract, double got, double want, double scale, const char *where)
{
    struct contract_row *row = &contract->rows[contract->at];
    if (!contract_count(row, got == want ? 0.0 : fabs(got - want) / scale)) return;
    snprintf(row->where, sizeof row->where, "%s%s%s", contract->preset, *contract->preset ? ": " : "", where);
    row->compared = true;
    row->got = got;
    row->want = want;
}

void contract_holds(struct contract *contract, bool holds, const char *where)
{
    contract_error(contract, holds ? 0.0 : 1.0, "%s", where);
}

void contract_fact(struct contract *contract, const char *what, bool holds)
{
    unsigned at = 0;
    while (at < contract->n_fact && strcmp(contract->facts[at].what, what) != 0) at++;
    if (at == CONTRACT_FACTS) return;
    if (at == contract->n_fact) contract->facts[contract->n_fact++] = (struct contract_fact){what, true};
    contract->facts[at].holds &= holds;
}

void contract_cost(struct contract *contract, const char *call, double ns)
{
    unsigned at = 0;
    while (at < contract->n_cost && strcmp(contract->costs[at].call, call) != 0) at++;
    if (at == CONTRACT_COSTS) return;
    if (at == contract->n_cost) contract->costs[contract->n_cost++] = (struct contract_cost){.call = call};
    if (ns > contract->costs[at].ns) contract->costs[at].ns = ns;
}

static bool contract_fails(const struct contract_row *row)
{
    return row->points && !(row->worst <= row->limit);
}

unsigned contract_failed(const struct contract *contract)
{
    unsigned count = 0;
    for (unsigned i = 0; i < contract->n_row; i++) count += contract_fails(&contract->rows[i]);
    return count;
}

static void contract_line(const struct contract_row *row, int width, struct text *text)
{
    if (!row->points) {
        text_add(text, "  %-*s  %8s  %9s  %9s  not offered\n", width, row->check, "-", "-", "-");
        return;
    }
    text_add(text, "  %-*s  %8ld  %9.2g  %9.2g  %s", width, row->check, row->points, row->worst, row->limit,
             contract_fails(row) ? "FAIL" : "pass");
    if (row->worst > 0.0) text_add(text, "  %s", row->where);
    if (contract_fails(row) && row->compared) text_add(text, ": %.17g instead of %.17g", row->got, row->want);
    text_add(text, "\n");
}

void contract_table(const struct contract *contract, struct text *text)
{
    int width = 5;
    for (unsigned i = 0; i < contract->n_row; i++) {
        int length = (int)strlen(contract->rows[i].check);
        width = length > width ? length : width;
    }
    text_add(text, "  %-*s  %8s  %9s  %9s  %s  %s\n", width, "check", "values", "worst", "allowed", "result", "where");
    for (unsigned i = 0; i < contract->n_row; i++) contract_line(&contract->rows[i], width, text);
    for (unsigned i = 0; i < contract->n_fact; i++)
        text_add(text, "%s  %s: %s\n", i ? "" : "\n", contract->facts[i].what, contract->facts[i].holds ? "yes" : "no");
    for (unsigned i = 0; i < contract->n_cost; i++)
        text_add(text, "%s %s %.1f", i ? "," : "\n  ns per point:", contract->costs[i].call, contract->costs[i].ns);
    if (contract->n_cost) text_add(text, "\n");
}

bool contract_same(double a, double b)
{
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

double contract_random(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*state >> 11) * 0x1p-53;
}

double contract_decades(uint64_t *state, double low, double high)
{
    return pow(10.0, contract_random(state, log10(low), log10(high)));
}
