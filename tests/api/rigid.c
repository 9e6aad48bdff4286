#include "rigid.h"

#include <string.h>

const double PI = 3.14159265358979323846;

pbmpm_world_id empty_world(int32_t dimension, float dx)
{
    const pbmpm_world_def def = default_world(dimension, dx, 16);
    return create_world(&def);
}

pbmpm_mass_properties mass_of(pbmpm_world_id world, pbmpm_shape shape, float density)
{
    pbmpm_mass_properties mass = {.size = sizeof mass};
    OK(pbmpm_shape_mass(world, &shape, density, &mass));
    return mass;
}

static pbmpm_collider_id add_body(pbmpm_world_id world, pbmpm_shape shape)
{
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    def.kinematic = def.measures_impulse = 1;
    def.friction = PBMPM_FRICTION_SLIP;
    OK(pbmpm_collider_create(world, &def, &shape, &collider));
    return collider;
}

rigid make_rigid(pbmpm_world_id world, pbmpm_shape shape, float density, void (*hold)(pbmpm_rigid_def *def))
{
    rigid body = {.world = world, .collider = add_body(world, shape), .state = {.size = sizeof body.state}};
    const pbmpm_mass_properties mass = mass_of(world, shape, density);
    OK(pbmpm_rigid_def_init(&body.def, sizeof body.def));
    body.def.mass = mass.mass;
    memcpy(body.def.centre, mass.centre, sizeof mass.centre);
    memcpy(body.def.inertia, mass.inertia, sizeof mass.inertia);
    memcpy(body.def.products, mass.products, sizeof mass.products);
    if (hold) hold(&body.def);
    OK(pbmpm_rigid_begin(world, body.collider, &body.def, &body.state));
    return body;
}

void hang_on_a_hinge(pbmpm_rigid_def *def)
{
    def->moves = PBMPM_FREEDOM_NONE;
    def->turns = PBMPM_FREEDOM_AXIS;
    def->turn_axis[0] = 0.3;
    def->pivot[0] = 0.4;
    def->pivot[1] = 0.1;
}

void short_pendulum(pbmpm_rigid_def *def)
{
    hang_on_a_hinge(def);
    def->turn_axis[0] = 0;
    def->pivot[0] = 0;
    def->pivot[1] = 0.5;
}

rigid put_on_floor(int32_t dimension, pbmpm_shape shape, float of_body, float of_floor)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 16);
    def.domain_enabled = 1;
    def.domain_friction = of_floor;
    for (int a = 0; a < dimension; a++) def.domain_max[a] = 40;
    rigid body = {.world = create_world(&def), .state = {.size = sizeof body.state}};
    pbmpm_collider_def rough;
    OK(pbmpm_collider_def_init(&rough, sizeof rough));
    rough.kinematic = rough.measures_impulse = 1;
    rough.friction_coefficient = of_body;
    OK(pbmpm_collider_create(body.world, &rough, &shape, &body.collider));
    const pbmpm_mass_properties mass = mass_of(body.world, shape, 500);
    OK(pbmpm_rigid_def_init(&body.def, sizeof body.def));
    body.def.mass = mass.mass;
    memcpy(body.def.inertia, mass.inertia, sizeof mass.inertia);
    OK(pbmpm_rigid_begin(body.world, body.collider, &body.def, &body.state));
    set_gravity(body.world, 0, -10, 0);
    return body;
}

void advance(rigid *body) { OK(pbmpm_rigid_advance(body->world, body->collider, &body->def, &body->state, DT)); }

void step(rigid *body)
{
    advance(body);
    OK(pbmpm_world_step(body->world, DT));
}
