#include "api/layout.h"

#include <stddef.h>

#include "pbmpm/pbmpm.h"

#define PBMPM_LAYOUT_STRUCT(structure) {#structure, "", 0, (uint32_t)sizeof(structure)},
#define PBMPM_LAYOUT(structure, field)                                                                                  \
    {#structure, #field, (uint32_t)offsetof(structure, field), (uint32_t)sizeof(((structure *)0)->field)},

static const pbmpm_layout_entry entries[] = {
#include "api/layout_table.inc"
};

const pbmpm_layout_entry *layout_table(uint32_t *count)
{
    *count = (uint32_t)(sizeof entries / sizeof *entries);
    return entries;
}
