/* The layouts of the public structures, as this library was compiled. */
#ifndef PBMPM_SRC_API_LAYOUT_H
#define PBMPM_SRC_API_LAYOUT_H

#include "pbmpm/base.h"

const pbmpm_layout_entry *layout_table(uint32_t *count);

#endif
