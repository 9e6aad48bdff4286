/* The exported functions of rigid.h. */
#include "pbmpm/pbmpm.h"

#include <string.h>

#include "api/api_call.h"
#include "base/numbers.h"
#include "base/result.h"
#include "services/rigid.h"
#include "services/submerged.h"
#include "shape/mass.h"

static pbmpm_result no_volume(void) { return api_invalid("a plane has no volume"); }

pbmpm_result pbmpm_shape_mass(pbmpm_world_id world, const pbmpm_shape *shape, float density, pbmpm_mass_properties *mass)
{
    READ(pbmpm_shape, own, shape, shape_defaults());
    REQUIRE_SIZE(pbmpm_mass_properties, mass);
    HOLD_READING(world);
    const char *problem = shape_problem_among(&own, w->def.dimension, &w->baked);
    if (!problem && !in_range(density, 1e-6, 1e9)) problem = "density must be in [1e-6, 1e9]";
    if (problem) LET_GO(api_invalid(problem));
    if (own.kind == PBMPM_PLANE) LET_GO(no_volume());
    const Solid solid = solid_among(&own, w->def.dimension, &w->baked);
    const pbmpm_mass_properties found = solid_mass(&solid, (double)density);
    WRITE(pbmpm_mass_properties, mass, &found);
    LET_GO(PBMPM_OK);
}

static pbmpm_result find_bounded(const World *world, pbmpm_collider_id id, Collider **collider)
{
    *collider = colliders_find(&world->colliders, id);
    if (!*collider) return api_gone(world, "this collider", id.generation);
    return (*collider)->shape.kind == PBMPM_PLANE ? no_volume() : PBMPM_OK;
}

pbmpm_result pbmpm_collider_submerged(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_material_id *material,
                                      pbmpm_submersion *submersion)
{
    REQUIRE_SIZE(pbmpm_submersion, submersion);
    HOLD(world);
    Collider *found;
    pbmpm_submersion own;
    pbmpm_result result = find_bounded(w, collider, &found);
    if (result == PBMPM_OK && material && !material_is_live(&w->materials, *material))
        result = api_gone(w, "this material", material->generation);
    if (result != PBMPM_OK) LET_GO(result);
    result = submerged_measure(w, found, material ? (int)material->index : ANY_MATERIAL, &own);
    if (result == PBMPM_OK) WRITE(pbmpm_submersion, submersion, &own);
    LET_GO(result);
}

pbmpm_result pbmpm_rigid_def_init(pbmpm_rigid_def *def, size_t size)
{
    INIT(pbmpm_rigid_def, def, size, rigid_defaults());
}

/* A collider that can be a body of this definition. */
static pbmpm_result find_body(const World *world, pbmpm_collider_id id, const pbmpm_rigid_def *def, Collider **collider)
{
    const pbmpm_result result = find_bounded(world, id, collider);
    if (result != PBMPM_OK) return result;
    if (!(*collider)->def.kinematic || !(*collider)->def.measures_impulse)
        return api_invalid("the collider of a rigid body is kinematic and measures its impulse: set collider.kinematic and measures_impulse");
    const char *problem = rigid_def_problem(def, world->def.dimension);
    return problem ? api_invalid(problem) : PBMPM_OK;
}

pbmpm_result pbmpm_rigid_begin(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_rigid_def *def, pbmpm_rigid_state *state)
{
    READ(pbmpm_rigid_def, own, def, rigid_defaults());
    REQUIRE_SIZE(pbmpm_rigid_state, state);
    HOLD_READING(world);
    Collider *found;
    const pbmpm_result result = find_body(w, collider, &own, &found);
    if (result != PBMPM_OK) LET_GO(result);
    const pbmpm_rigid_state begun = rigid_at(found, &own, w->def.dimension);
    WRITE(pbmpm_rigid_state, state, &begun);
    LET_GO(PBMPM_OK);
}

/* What matter gave in the last step, gravity, and the virtual mass by the law that the header states. */
static pbmpm_result find_push(World *world, pbmpm_collider_id id, Collider *collider, const double centre[3], RigidPush *push)
{
    const FreeBody *body = collider_body(collider, &world->memory);
    if (!body) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a rigid body");
    pbmpm_submersion under = {.volume = 0.0};
    const int dimension = world->def.dimension;
    const pbmpm_result result = body->walled || body->met ? PBMPM_OK : submerged_measure(world, collider, ANY_MATERIAL, &under);
    if (result != PBMPM_OK) return result;
    const pbmpm_impulse given = impulse_about(&world->colliders.impulses.sum[id.index], body->met ? body->begins : centre, dimension);
    *push = (RigidPush){.walled = body->walled != 0, .virtual_mass = under.density * under.volume * under.share};
    memcpy(push->yielded, body->yielded, sizeof push->yielded);
    memcpy(push->delayed, body->delayed, sizeof push->delayed);
    memcpy(push->went, body->went, sizeof push->went);
    memcpy(push->expects, body->expects, sizeof push->expects);
    push->met = body->met != 0;
    for (int a = 0; a < 3; a++) {
        push->gravity[a] = a < dimension ? (double)world->settings.gravity[a] : 0.0;
        push->linear[a] = a < dimension ? given.linear[a] : 0.0;
        push->angular[a] = given.angular[a];
    }
    return PBMPM_OK;
}

/* A wall pushes and does not pull: a body that matter lifts off it is not held. */
static bool is_lifted_off(const FreeBody *body, const RigidPush *push, const double unit[6], double dt)
{
    double impulse[6], change[6], along = 0.0;
    for (int a = 0; a < 6; a++) impulse[a] = dt * body->push[a];
    free_body_yields(body, impulse, change);
    for (int a = 0; a < 6; a++) along += unit[a] * (change[a] + push->later[a]);
    return push->walled && along <= 0.0;
}

/* What the world has to know of it during the step. */
static void keep_body(FreeBody *body, const RigidPush *push, const RigidStops *stops, double dt)
{
    memcpy(body->delayed, push->later, sizeof push->later);
    memcpy(body->expected, push->expected, sizeof push->expected);
    memcpy(body->open, body->way, sizeof body->open);
    for (int k = 0; k < stops->count; k++)
        if (!is_lifted_off(body, push, stops->unit[k], dt)) free_body_hold(body, stops->unit[k]);
    body->yields = !push->walled;
    if (stops->count == 0) memcpy(body->expects, push->expects, sizeof body->expects);
    for (int k = 0; k < body->ways && stops->count > 0; k++) { /* what walls stopped of it they took */
        double along = 0.0;
        for (int a = 0; a < 6; a++) along += body->open[k][a] * push->expected[a];
        for (int a = 0; a < 6; a++) body->expects[a] += along * body->open[k][a];
    }
}

/* Contacts push obstacles where they are when a substep begins. What yields within the step turns about where its centre is then, on average over the substeps. About where it
 * will be a ball that rolls was driven on by what carries it: the moment was v dt times its weight. What yields a step late turns where it is then: that keeps angular momentum. */
static void note_begin(FreeBody *body, const double begin[3], int32_t substeps)
{
    for (int a = 0; a < 3; a++) body->begins[a] = begin[a] + 0.5 * (1.0 - 1.0 / substeps) * (body->centre[a] - begin[a]);
}

/* Sends the obstacle where the body is. */
static void send(Collider *collider, const pbmpm_rigid_state *state)
{
    float position[3], rotation[4];
    for (int a = 0; a < 3; a++) position[a] = (float)state->position[a];
    for (int i = 0; i < 4; i++) rotation[i] = (float)state->rotation[i];
    collider_place(collider, position, rotation, false);
}

/* What 2D has not. */
static void flatten(pbmpm_rigid_state *state)
{
    state->position[2] = state->velocity[2] = state->velocity_change[2] = state->point[2] = 0.0;
    for (int a = 0; a < 2; a++) state->angular_velocity[a] = state->angular_velocity_change[a] = 0.0;
}

pbmpm_result pbmpm_rigid_advance(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_rigid_def *def, pbmpm_rigid_state *state, float dt)
{
    READ(pbmpm_rigid_def, own, def, rigid_defaults());
    READ(pbmpm_rigid_state, next, state, (pbmpm_rigid_state){.size = sizeof next});
    HOLD(world);
    if (w->def.dimension == 2) flatten(&next);
    Collider *found;
    RigidPush push;
    double begin[3];
    pbmpm_result result = find_body(w, collider, &own, &found);
    const char *problem = rigid_state_problem(&next, w->def.dimension);
    if (!problem) problem = api_step_problem(w, dt);
    if (result == PBMPM_OK && problem) result = api_invalid(problem);
    if (result == PBMPM_OK) {
        rigid_centre(&own, &next, w->def.dimension, begin);
        result = find_push(w, collider, found, begin, &push);
    }
    if (result != PBMPM_OK) LET_GO(result);
    RigidStops stops = {.count = 0};
    if (push.met) rigid_follow(&own, &next, push.went, w->def.dimension);
    rigid_centre(&own, &next, w->def.dimension, begin);
    rigid_change_velocity(&own, &next, &push, w->def.dimension, (double)dt);
    rigid_slow_at_walls(&own, &next, found, &w->domain, w->def.dimension, (double)dt, &stops); /* what friction holds does not start */
    rigid_change_pose(&own, &next, w->def.dimension, (double)dt);
    rigid_stop_at_walls(&own, &next, found, &w->domain, w->def.dimension, (double)dt, &stops);
    if (rigid_state_problem(&next, w->def.dimension)) LET_GO(api_invalid("the rigid body would go, or be, farther or faster than 1e9"));
    send(found, &next);
    *found->body = rigid_free_body(&own, &next, push.gravity, w->def.dimension);
    note_begin(found->body, begin, w->settings.substeps);
    keep_body(found->body, &push, &stops, (double)dt);
    WRITE(pbmpm_rigid_state, state, &next);
    LET_GO(PBMPM_OK);
}
