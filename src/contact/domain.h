/* The box that a world may be in, and its walls. */
#ifndef PBMPM_SRC_CONTACT_DOMAIN_H
#define PBMPM_SRC_CONTACT_DOMAIN_H

#include <stdbool.h>

#include "pbmpm/collider.h"
#include "pbmpm/world.h"

enum { DOMAIN_WALLS = 6 };

typedef struct Domain {
    bool measures;                       /* its walls' impulses */
    double low[3], high[3];              /* where matter may be [m]; infinite where no wall is */
    pbmpm_domain_wall wall[DOMAIN_WALLS]; /* all open in a world without a box */
} Domain;

/* The place of a wall among them. */
static inline int domain_place(int axis, bool upper) { return 2 * axis + (upper ? 1 : 0); }

bool friction_known(pbmpm_friction friction);

/* As the definition has it. */
Domain domain_of(const pbmpm_world_def *def);

/* Null if valid, else what is wrong. */
const char *domain_wall_problem(const pbmpm_domain_wall *wall);

void domain_set_wall(Domain *domain, const pbmpm_world_def *def, int place, const pbmpm_domain_wall *wall);

/* Whether any wall differs from the definition. */
bool domain_changed(const Domain *domain, const pbmpm_world_def *def);

#endif
