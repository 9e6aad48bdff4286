/* Particles, their fields and identifiers in a snapshot. */
#ifndef PBMPM_SRC_SNAPSHOT_SNAPSHOT_PARTICLES_H
#define PBMPM_SRC_SNAPSHOT_SNAPSHOT_PARTICLES_H

#include "snapshot/payload.h"

extern const SnapshotSection particles_section;

uint32_t particles_section_bytes_each(const World *world);

#endif
