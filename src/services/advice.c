#include "services/advice.h"

#include "services/advice_rules.h"

static const struct {
    pbmpm_advice_code code;
    const char *name, *unit;
    void (*rule)(Adviser *adviser);
} rules[] = {
    {PBMPM_ADVICE_NO_GRAVITY, "PBMPM_ADVICE_NO_GRAVITY", "", advise_no_gravity},
    {PBMPM_ADVICE_FALLS_FOREVER, "PBMPM_ADVICE_FALLS_FOREVER", "", advise_falls_forever},
    {PBMPM_ADVICE_IGNORED, "PBMPM_ADVICE_IGNORED", "", advise_ignored_parameters},
    {PBMPM_ADVICE_POOL_TOO_DEEP, "PBMPM_ADVICE_POOL_TOO_DEEP", "", advise_pool_too_deep},
    {PBMPM_ADVICE_POOL_STIRS, "PBMPM_ADVICE_POOL_STIRS", "m/s", advise_pool_stirs},
    {PBMPM_ADVICE_POOL_STIRS, "PBMPM_ADVICE_POOL_STIRS", "m/s", advise_ball_stirs},
    {PBMPM_ADVICE_POOL_STIRS, "PBMPM_ADVICE_POOL_STIRS", "m/s", advise_pool_moves},
    {PBMPM_ADVICE_MODULUS_NOT_HELD, "PBMPM_ADVICE_MODULUS_NOT_HELD", "Pa", advise_modulus_not_held},
    {PBMPM_ADVICE_SAND_NOT_HELD, "PBMPM_ADVICE_SAND_NOT_HELD", "", advise_sand_not_held},
    {PBMPM_ADVICE_SAND_NOT_HELD, "PBMPM_ADVICE_SAND_NOT_HELD", "", advise_sand_lands},
    {PBMPM_ADVICE_SAND_NOT_HELD, "PBMPM_ADVICE_SAND_NOT_HELD", "", advise_sand_slides},
    {PBMPM_ADVICE_SAND_NOT_HELD, "PBMPM_ADVICE_SAND_NOT_HELD", "", advise_sand_runs},
    {PBMPM_ADVICE_BODY_TOO_THIN, "PBMPM_ADVICE_BODY_TOO_THIN", "cells", advise_body_too_thin},
    {PBMPM_ADVICE_BODY_TOO_THIN, "PBMPM_ADVICE_BODY_TOO_THIN", "cells", advise_rigid_sinks},
    {PBMPM_ADVICE_BOUNCE_DAMPED, "PBMPM_ADVICE_BOUNCE_DAMPED", "substeps", advise_bounce_damped},
    {PBMPM_ADVICE_BOUNCE_DAMPED, "PBMPM_ADVICE_BOUNCE_DAMPED", "substeps", advise_ball_damped},
    {PBMPM_ADVICE_BOUNCE_DAMPED, "PBMPM_ADVICE_BOUNCE_DAMPED", "substeps", advise_hit_damped},
    {PBMPM_ADVICE_ROLLING_BRAKED, "PBMPM_ADVICE_ROLLING_BRAKED", "cells", advise_rolling_braked},
    {PBMPM_ADVICE_COLLIDER_TOO_FAST, "PBMPM_ADVICE_COLLIDER_TOO_FAST", "cells", advise_collider_too_fast},
    {PBMPM_ADVICE_COLLIDER_TOO_THIN, "PBMPM_ADVICE_COLLIDER_TOO_THIN", "cells", advise_collider_too_thin},
    {PBMPM_ADVICE_STEP_TOO_LONG, "PBMPM_ADVICE_STEP_TOO_LONG", "cells per substep", advise_step_too_long},
    {PBMPM_ADVICE_STEP_TOO_LONG, "PBMPM_ADVICE_STEP_TOO_LONG", "cells per substep", advise_enters_bodies},
    {PBMPM_ADVICE_VOLUME_LOST, "PBMPM_ADVICE_VOLUME_LOST", "", advise_volume_lost},
    {PBMPM_ADVICE_STRAIN_CLAMPED, "PBMPM_ADVICE_STRAIN_CLAMPED", "", advise_strain_clamped},
    {PBMPM_ADVICE_NOT_SOLVED, "PBMPM_ADVICE_NOT_SOLVED", "cells", advise_not_solved},
    {PBMPM_ADVICE_OVERLAPS, "PBMPM_ADVICE_OVERLAPS", "", advise_overlaps},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", advise_known_limits},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", advise_soft_bounce},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", advise_rigid_thrown_off},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", advise_rigid_on_sand},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", advise_rigid_enters},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", advise_rigid_turns},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", advise_rigid_stays_down},
    {PBMPM_ADVICE_NO_FRICTION, "PBMPM_ADVICE_NO_FRICTION", "", advise_no_friction},
    {PBMPM_ADVICE_NO_FRICTION, "PBMPM_ADVICE_NO_FRICTION", "", advise_slips},
    {PBMPM_ADVICE_NO_FRICTION, "PBMPM_ADVICE_NO_FRICTION", "", advise_rigid_glides},
    {PBMPM_ADVICE_EMITTER_OUTSIDE, "PBMPM_ADVICE_EMITTER_OUTSIDE", "cells", advise_emitter_outside},
    {PBMPM_ADVICE_EMITTER_REFUSED, "PBMPM_ADVICE_EMITTER_REFUSED", "", advise_emitter_refused},
    {PBMPM_ADVICE_COLLIDER_TOO_COARSE, "PBMPM_ADVICE_COLLIDER_TOO_COARSE", "cells", advise_collider_too_coarse},
};

pbmpm_result advice_give(World *world, double dt, pbmpm_advice *array, uint32_t capacity, uint32_t *count)
{
    Adviser adviser = {.world = world, .substep = world_substep(world, dt / world->settings.substeps), .array = array, .capacity = capacity};
    const pbmpm_result result = survey_make(world, &adviser.survey);
    if (result != PBMPM_OK) return result;
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) rules[i].rule(&adviser);
    *count = adviser.count;
    return PBMPM_OK;
}

const char *advice_name(pbmpm_advice_code code)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].code == code) return rules[i].name;
    return "PBMPM_ADVICE_UNKNOWN";
}

const char *advice_unit(pbmpm_advice_code code)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].code == code) return rules[i].unit;
    return "";
}
