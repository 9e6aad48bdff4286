#include "contact/domain.h"

#include <math.h>
#include <string.h>

#include "base/numbers.h"

bool friction_known(pbmpm_friction friction)
{
    return friction == PBMPM_FRICTION_COULOMB || friction == PBMPM_FRICTION_STICK || friction == PBMPM_FRICTION_SLIP;
}

static pbmpm_domain_wall wall_of(const pbmpm_world_def *def)
{
    return (pbmpm_domain_wall){.size = sizeof(pbmpm_domain_wall),
                               .open = !def->domain_enabled,
                               .friction = PBMPM_FRICTION_COULOMB,
                               .friction_coefficient = def->domain_friction};
}

Domain domain_of(const pbmpm_world_def *def)
{
    const pbmpm_domain_wall wall = wall_of(def);
    Domain domain = {.measures = def->domain_enabled && def->domain_measures_impulse};
    for (int place = 0; place < DOMAIN_WALLS; place++) domain_set_wall(&domain, def, place, &wall);
    return domain;
}

const char *domain_wall_problem(const pbmpm_domain_wall *wall)
{
    if (wall->open != 0 && wall->open != 1) return "wall.open must be 0 or 1";
    if (!friction_known(wall->friction)) return "wall.friction is unknown";
    if (!in_range(wall->friction_coefficient, 0.0, 100.0)) return "wall.friction_coefficient must be in [0, 100]";
    return NULL;
}

void domain_set_wall(Domain *domain, const pbmpm_world_def *def, int place, const pbmpm_domain_wall *wall)
{
    const int axis = place / 2;
    domain->wall[place] = *wall;
    if (place % 2 == 0)
        domain->low[axis] = wall->open ? -INFINITY : (double)def->domain_min[axis];
    else
        domain->high[axis] = wall->open ? INFINITY : (double)def->domain_max[axis];
}

bool domain_changed(const Domain *domain, const pbmpm_world_def *def)
{
    const pbmpm_domain_wall wall = wall_of(def);
    for (int place = 0; place < 2 * def->dimension; place++)
        if (memcmp(&domain->wall[place], &wall, sizeof wall) != 0) return true;
    return false;
}
