/* Emitters, drains, kill bounds and forces in a snapshot: their definitions, which may change between steps, and what they have
 * done. */
#ifndef PBMPM_SRC_SNAPSHOT_SNAPSHOT_FLOW_H
#define PBMPM_SRC_SNAPSHOT_SNAPSHOT_FLOW_H

#include "snapshot/payload.h"

extern const SnapshotSection sleep_section; /* snapshot_sleep.c */
extern const SnapshotSection emitters_section;
extern const SnapshotSection drains_section;
extern const SnapshotSection forces_section;
extern const SnapshotSection flow_section; /* kill bounds and the account */

#endif
