#include "services/effective_moduli.h"

#include <math.h>
#include <string.h>

#include "solvers/dual/dual.h"
#include "solvers/joint.h"
#include "solvers/moduli.h"
#include "solvers/paper.h"
#include "solvers/primal/primal.h"
#include "solvers/solver.h"
#include "world/island_groups.h"

/* The laws of the paper's solver: its N rounds remove the share w of a strain error each, which acts like the modulus
 * rho w N dx^2 / (4 dt^2) against a shape error and like a d-th of it against a volume error. */
static pbmpm_effective of_paper(const World *world, const pbmpm_material_def *def, const Substep *substep)
{
    const double cell = substep->to_velocity;
    const double rounds = world->settings.iterations;
    const double young = 0.25 * (double)def->density * (double)def->relaxation * rounds * cell * cell;
    const bool liquid = def->kind == PBMPM_LIQUID;
    const double viscosity = rounds * paper_viscous_share(world, def, substep) * cell * (double)world->def.cell_size / 8.0;
    return (pbmpm_effective){.bulk_modulus = (float)(young / world->def.dimension),
                             .young_modulus = liquid ? 0.0f : (float)young,
                             .kinematic_viscosity = liquid ? (float)viscosity : 0.0f};
}

/* The primal's liquid is as stiff as the iterations and the depth that it had in the last substep let it be; see moduli.c. */
static float bulk_of_liquid(const World *world, pbmpm_solver solver, const pbmpm_material_def *def, const Substep *substep)
{
    const bool bounded = def->bulk_modulus == 0.0f || world->settings.solver == PBMPM_SOLVER_CONVERGENT;
    if (solver != PBMPM_SOLVER_PRIMAL || !bounded) return def->bulk_modulus;
    const Substep taken = world_substep(world, (double)(float)substep->dt); /* see world_step() */
    const double most = (double)primal_liquid_dilation(world, &taken) / moduli_unit(def, substep);
    return (float)(def->bulk_modulus == 0.0f ? most : fmin(most, (double)def->bulk_modulus));
}

/* What `solver` holds of a solid's stiffness. */
static double share_of(const World *world, pbmpm_solver solver, const pbmpm_material_def *def, const Substep *substep)
{
    if (solver == PBMPM_SOLVER_DUAL) return dual_stiffness_share(world, def, substep);
    return solver == SOLVER_JOINT ? joint_stiffness_share(world, def, substep) : 1.0;
}

/* Solved by `solver`, among the particles that are counted now. */
static pbmpm_effective of_material(const World *world, pbmpm_solver solver, const pbmpm_material_def *def, const Substep *substep)
{
    if (def->kind == PBMPM_LIQUID) return (pbmpm_effective){.bulk_modulus = bulk_of_liquid(world, solver, def, substep), .kinematic_viscosity = def->kinematic_viscosity};
    const double young = share_of(world, solver, def, substep) * (double)def->young_modulus;
    const Lame lame = lame_of(young, (double)def->poisson_ratio);
    return (pbmpm_effective){.bulk_modulus = (float)(lame.lambda + 2.0 * lame.mu / world->def.dimension), .young_modulus = (float)young};
}

/* The pressure wave's modulus: K of a liquid, K + 2 (d - 1) / d mu of an elastic body. */
static double wave_modulus(const World *world, const pbmpm_material_def *def, const pbmpm_effective *effective)
{
    const double bulk = (double)effective->bulk_modulus, young = (double)effective->young_modulus;
    if (def->kind == PBMPM_LIQUID) return bulk;
    if (world->settings.solver == PBMPM_SOLVER_PAPER) return young; /* it has no Poisson effect */
    const double d = world->def.dimension;
    return bulk + (d - 1.0) / d * young / (1.0 + (double)def->poisson_ratio);
}

/* What the counted particles' kinds make of the setting. Without any of this material it is asked of an island of it alone. */
static pbmpm_effective where_it_is(World *world, uint32_t slot, const Substep *substep)
{
    uint32_t *count = &world->particles.of_material[slot];
    const uint32_t particles = *count;
    if (particles == 0) *count = 1;
    const uint32_t kinds = particles ? islands_kinds(world) : islands_kind(&world->materials, slot);
    const pbmpm_solver solver = world->settings.solver == PBMPM_SOLVER_CONVERGENT ? solver_for(world, kinds) : world->settings.solver;
    const pbmpm_solver last = world->record.solver; /* the solvers' own rules ask for it */
    world->record.solver = solver;
    const pbmpm_effective effective = of_material(world, solver, &world->materials.def[slot], substep);
    world->record.solver = last;
    *count = particles;
    return effective;
}

/* Of a material in islands of several kinds: what the softest hold. */
static pbmpm_effective of_islands(World *world, uint32_t slot, const Substep *substep, bool built)
{
    pbmpm_effective least = {.young_modulus = INFINITY, .bulk_modulus = INFINITY};
    for (int group = 0; group < world->islands.groups; group++) {
        islands_enter(world, group);
        const int32_t blocks = world->grid.particle_blocks;
        const bool here = world->particles.of_material[slot] > 0;
        if (!built) world->grid.particle_blocks = 0; /* another group's */
        const pbmpm_effective found = where_it_is(world, slot, substep);
        world->grid.particle_blocks = blocks;
        islands_leave(world, group);
        const bool softer = found.bulk_modulus > 0.0f && (least.bulk_modulus == 0.0f || found.bulk_modulus < least.bulk_modulus);
        if (here && (least.young_modulus == INFINITY || softer)) least = found;
    }
    return least;
}

static pbmpm_effective of_slot(World *world, uint32_t slot, const Substep *substep)
{
    const int groups = world->islands.groups; /* of the last substep, as its grids are */
    uint32_t kinds[ISLAND_GROUPS];
    memcpy(kinds, world->islands.kinds, sizeof kinds);
    const bool apart = world->particles.of_material[slot] > 0 && islands_wanted(world) && islands_foresee(world);
    const bool built = groups == world->islands.groups && memcmp(kinds, world->islands.kinds, (size_t)groups * sizeof *kinds) == 0;
    const pbmpm_effective effective = apart ? of_islands(world, slot, substep, built) : where_it_is(world, slot, substep);
    world->islands.groups = groups;
    return effective;
}

pbmpm_effective effective_modulus(World *world, uint32_t slot, const Substep *substep)
{
    const pbmpm_material_def *def = &world->materials.def[slot];
    const bool paper = world->settings.solver == PBMPM_SOLVER_PAPER;
    pbmpm_effective effective = paper ? of_paper(world, def, substep) : of_slot(world, slot, substep);
    effective.size = sizeof effective;
    const double speed = sqrt(wave_modulus(world, def, &effective) / (double)def->density);
    effective.courant = (float)(speed * substep->dt / (double)world->def.cell_size);
    return effective;
}
