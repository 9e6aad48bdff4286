#include "services/advice_rules.h"

static void ignored(Adviser *adviser, pbmpm_material_id material, pbmpm_collider_id collider, float value, float plain, const char *text)
{
    if (value == plain) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_IGNORED, .material = material, .collider = collider, .figure = value, .bound = plain, .text = text};
    adviser_by_value(PBMPM_CHANGE_PARAMETER, (double)plain, 0.0, &advice);
    adviser_give(adviser, advice);
}

static void ignored_of_liquid(Adviser *adviser, uint32_t slot, pbmpm_solver solver)
{
    const pbmpm_material_def *def = &adviser->world->materials.def[slot], plain = material_defaults();
    const pbmpm_material_id id = adviser_id_of(adviser->world, slot);
    const pbmpm_collider_id none = {0, 0};
    if (solver == PBMPM_SOLVER_PAPER)
        ignored(adviser, id, none, def->bulk_modulus, plain.bulk_modulus, "bulk_modulus does nothing with the paper's solver: rate and iterations make its stiffness");
    else
        ignored(adviser, id, none, def->viscosity, plain.viscosity, "viscosity does nothing but with the paper's solver: kinematic_viscosity does");
}

static void ignored_of_solid(Adviser *adviser, uint32_t slot, pbmpm_solver solver)
{
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot], plain = material_defaults();
    const pbmpm_material_id id = adviser_id_of(world, slot);
    const pbmpm_collider_id none = {0, 0};
    const bool elastic = def->kind == PBMPM_ELASTIC;
    if (solver == PBMPM_SOLVER_PAPER) {
        ignored(adviser, id, none, def->young_modulus, plain.young_modulus, "young_modulus does nothing with the paper's solver: rate and iterations make its stiffness");
        ignored(adviser, id, none, def->poisson_ratio, plain.poisson_ratio, "poisson_ratio does nothing with the paper's solver");
    } else {
        ignored(adviser, id, none, def->elasticity_ratio, plain.elasticity_ratio, "elasticity_ratio does nothing but with the paper's solver: young_modulus and poisson_ratio do");
        ignored(adviser, id, none, def->rebound_max, plain.rebound_max, "rebound_max does nothing but with the paper's solver");
    }
    if (!adviser_may_solve(world, slot, PBMPM_SOLVER_PAPER) && !adviser_may_solve(world, slot, PBMPM_SOLVER_DUAL))
        ignored(adviser, id, none, def->relaxation, plain.relaxation, "relaxation does nothing for solids with the primal and the explicit solver");
    if (elastic && (solver == PBMPM_SOLVER_PAPER || solver == PBMPM_SOLVER_DUAL))
        ignored(adviser, id, none, (float)def->elastic_model, (float)plain.elastic_model, "elastic_model does nothing with this solver: the paper's has none, the dual's is fixed corotated");
}

static void ignored_of_settings(Adviser *adviser)
{
    const World *world = adviser->world;
    const pbmpm_settings *now = &world->settings, plain = settings_defaults();
    const pbmpm_material_id none = {0, 0};
    const pbmpm_collider_id nowhere = {0, 0};
    const bool liquid = adviser_any_present(world, PBMPM_LIQUID), by_dual = adviser_any_solved_with(world, PBMPM_SOLVER_DUAL), by_primal = adviser_any_solved_with(world, PBMPM_SOLVER_PRIMAL);
    if (!by_dual || !liquid)
        ignored(adviser, none, nowhere, (float)now->pressure, (float)plain.pressure, "settings.pressure does nothing here: only liquids of the dual solver have it");
    if (!by_primal)
        ignored(adviser, none, nowhere, (float)now->integrator, (float)plain.integrator, "settings.integrator does nothing here: only the primal solver has a second order");
    if (now->solver == PBMPM_SOLVER_PAPER || !liquid)
        ignored(adviser, none, nowhere, now->flip, plain.flip, "settings.flip does nothing here: only liquids have it, and not with the paper's solver");
    if (by_dual || by_primal) return;
    ignored(adviser, none, nowhere, now->target_error, plain.target_error, "settings.target_error does nothing here: only the dual and the primal solver predict an error");
    ignored(adviser, none, nowhere, now->time_budget_ms, plain.time_budget_ms, "settings.time_budget_ms does nothing here: only the dual and the primal solver keep one");
}

static void ignored_of_walls(Adviser *adviser)
{
    const World *world = adviser->world;
    const pbmpm_material_id none = {0, 0};
    const float plain = collider_defaults().friction_coefficient;
    if (!world->def.domain_enabled)
        ignored(adviser, none, (pbmpm_collider_id){0, 0}, world->def.domain_friction, 0.0f, "domain_friction does nothing: domain_enabled is 0");
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!collider_acts(collider) || collider->def.friction == PBMPM_FRICTION_COULOMB) continue;
        ignored(adviser, none, (pbmpm_collider_id){c, collider->generation}, collider->def.friction_coefficient, plain,
                "friction_coefficient does nothing but with PBMPM_FRICTION_COULOMB");
    }
}

void advise_ignored_parameters(Adviser *adviser)
{
    const World *world = adviser->world;
    ignored_of_settings(adviser);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!adviser_present(world, slot)) continue;
        if (adviser_flows(&world->materials.def[slot]))
            ignored_of_liquid(adviser, slot, adviser_solver_of(world, slot));
        else
            ignored_of_solid(adviser, slot, adviser_solver_of(world, slot));
    }
    ignored_of_walls(adviser);
}
