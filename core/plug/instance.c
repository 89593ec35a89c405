/* instance.c - see instance.h. */
#include "plug/instance.h"

#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "plug/block.h"
#include "plug/vet.h"

#include <stdio.h>
#include <string.h>

static char instance_reason[512]; /* what the module said in host->fail; one thread, one open at a time */

static void instance_say(const char *text)
{
    log_note("%s", text);
}

static void instance_fail(const char *text)
{
    snprintf(instance_reason, sizeof instance_reason, "%s", text ? text : "");
}

static const void *
instance_share(const char *name, size_t bytes, unsigned phases,
               int (*fill)(void *context, void *block, unsigned phase, unsigned part, unsigned parts), void *context)
{
    return block_share(name, bytes, phases, fill, context, instance_reason, sizeof instance_reason);
}

static const struct bulla_host instance_host = {.size = sizeof(struct bulla_host),
                                                .say = instance_say,
                                                .fail = instance_fail,
                                                .share = instance_share};

unsigned instance_param_count(const struct bulla_module *module)
{
    unsigned count = 0;
    while (module->params && module->params[count].name) count++;
    return count;
}

int instance_param_find(const struct bulla_module *module, const char *name)
{
    for (int i = 0; module->params && module->params[i].name; i++)
        if (strcmp(module->params[i].name, name) == 0) return i;
    return -1;
}

static void instance_forget(struct bulla_value *values, unsigned count)
{
    for (unsigned i = 0; i < count; i++) mem_free((char *)values[i].text);
    mem_free(values);
}

int instance_open(const struct bulla_module *module, const struct bulla_value *values, struct instance *ret_instance)
{
    unsigned count = instance_param_count(module);
    struct instance instance = {.module = module, .values = mem_new(count + 1, sizeof *instance.values)};
    for (unsigned i = 0; i < count; i++)
        instance.values[i] = (struct bulla_value){values[i].number, mem_text(values[i].text)};
    instance_reason[0] = '\0';
    block_begin(module, instance.values);
    int refused = module->open ? module->open(&instance_host, instance.values, &instance.self) : 0;
    instance.blocks = block_end();
    if (refused) {
        block_release(instance.blocks);
        instance_forget(instance.values, count);
        return status_fail(STATUS_CASE, "%s '%s': %s", module->kind, module->name,
                           instance_reason[0] ? instance_reason : "it cannot be opened and gives no reason");
    }
    int code = vet_instance(module, instance.self);
    if (code) {
        instance_done(&instance);
        return code;
    }
    *ret_instance = instance;
    return STATUS_OK;
}

void instance_done(struct instance *instance)
{
    if (!instance->module) return;
    if (instance->module->open && instance->module->close) instance->module->close(instance->self);
    block_release(instance->blocks);
    instance_forget(instance->values, instance_param_count(instance->module));
    *instance = (struct instance){0};
}
