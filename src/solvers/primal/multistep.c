#include "solvers/primal/multistep.h"

#include <string.h>

#include "base/result.h"

static const float BDF2_SHARE = 4.0f / 9.0f; /* of all forces: follows from the formula in multistep.h */

static bool is_on(const World *world)
{
    return world->record.solver == PBMPM_SOLVER_PRIMAL && world->settings.integrator == PBMPM_INTEGRATOR_BDF2 &&
           world->particles.deformation[0];
}

void multistep_expire(World *world)
{
    Particles *p = &world->particles;
    const uint32_t first = world->grid.first_row, end = world->grid.end_row; /* what sleeps has no past, see sleep.c */
    if (p->past_dt) memset(p->past_dt + first, 0, (end - first) * sizeof *p->past_dt);
}

pbmpm_result multistep_prepare(World *world)
{
    static const FieldTag past[] = {FIELD_PAST_VELOCITY, FIELD_PAST_AFFINE, FIELD_PAST_WAY, FIELD_PAST_TURN, FIELD_PAST_DT};
    Particles *p = &world->particles;
    if (!is_on(world)) {
        multistep_expire(world);
        return PBMPM_OK;
    }
    for (size_t i = 0; i < sizeof past / sizeof *past; i++) {
        const pbmpm_result result = particles_enable(p, &world->memory, past[i]);
        if (result != PBMPM_OK) return result;
    }
    PrimalState *state = &world->primal;
    if (array_reserve(&world->memory, &state->block_share, (size_t)world->grid.node_blocks, sizeof(float)) &&
        array_reserve(&world->memory, &state->body_share, (size_t)world->grid.bodies, sizeof(float)))
        return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for BDF2 on %d blocks", world->grid.node_blocks);
}

void multistep_free(World *world)
{
    array_free(&world->memory, &world->primal.block_share);
    array_free(&world->memory, &world->primal.body_share);
}

/* Whether all particles of a block are elastic, do not yield (what F forgets is no motion) and have a past of steps like this one. */
static bool has_past(const World *world, int32_t block)
{
    const uint32_t *block_run = world->grid.block_run.data;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
        const KernelMaterial *material = &world->materials.kernel[world->grid.run_key[run] >> K_RUN_CELL_BITS];
        if (material->kind != K_SOLID || material->yields != K_NO_YIELD) return false;
        for (uint32_t row = world->grid.run_begin[run]; row < world->grid.run_begin[run + 1]; row++)
            if (world->particles.past_dt[row] != (float)world->substep.dt) return false;
    }
    return true;
}

void multistep_bind(World *world)
{
    const Particles *p = &world->particles;
    const int32_t *body = world->grid.body.data;
    float *of_body = world->primal.body_share.data, *share = world->primal.block_share.data;
    KernelArgs *a = &world->args;
    if (!is_on(world)) return;
    a->particles.past_dt = p->past_dt;
    a->primal.block_share = share;
    memcpy(a->particles.past_velocity, p->past_velocity, sizeof a->particles.past_velocity);
    memcpy(a->particles.past_affine, p->past_affine, sizeof a->particles.past_affine);
    memcpy(a->particles.past_way, p->past_way, sizeof a->particles.past_way);
    memcpy(a->particles.past_turn, p->past_turn, sizeof a->particles.past_turn);
    for (int32_t i = 0; i < world->grid.bodies; i++) of_body[i] = BDF2_SHARE;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++)
        if (!has_past(world, block)) of_body[body[block]] = 1.0f;
    for (int32_t block = 0; block < world->grid.node_blocks; block++) share[block] = of_body[body[block]];
}

void multistep_predict(World *world, int32_t begin, int32_t end)
{
    const KernelArgs *a = &world->args;
    const size_t floats = (size_t)world->grid.block_cells * K_NODE_WIDTH;
    for (int32_t block = begin; block < end && a->primal.block_share; block++) {
        const float less = 1.0f - a->primal.block_share[block];
        if (less == 0.0f) continue;
        for (size_t i = (size_t)block * floats; i < ((size_t)block + 1) * floats; i += K_NODE_WIDTH) {
            if (a->grid.node_base[i + 3] == 0.0f) continue;
            for (size_t c = 0; c < 3; c++) {
                const float forces = a->grid.node_before ? a->grid.node_base[i + c] - a->grid.node_before[i + c] : 0.0f;
                a->grid.node_base[i + c] -= less * (a->gravity[c] + forces);
            }
        }
    }
}

void multistep_forget(World *world, int32_t block)
{
    if (world->args.primal.block_share) world->args.primal.block_share[block] = 0.0f;
}
