/* The library's table of layouts against the compiler's view of the public headers, field by field. The rows are
 * stated here once more, so that a mistake in the generator of the library's table shows. */
#include <stdio.h>
#include <string.h>

#include "support.h"

#define WHOLE(structure) {#structure, "", 0, (uint32_t)sizeof(structure)}
#define FIELD(structure, field) {#structure, #field, (uint32_t)offsetof(structure, field), (uint32_t)sizeof(((structure *)0)->field)}

static const pbmpm_layout_entry expected[] = {
    WHOLE(pbmpm_world_id),
    FIELD(pbmpm_world_id, index), FIELD(pbmpm_world_id, generation),
    WHOLE(pbmpm_material_id),
    FIELD(pbmpm_material_id, index), FIELD(pbmpm_material_id, generation),
    WHOLE(pbmpm_collider_id),
    FIELD(pbmpm_collider_id, index), FIELD(pbmpm_collider_id, generation),
    WHOLE(pbmpm_particle_id),
    FIELD(pbmpm_particle_id, index), FIELD(pbmpm_particle_id, generation),
    WHOLE(pbmpm_allocator),
    FIELD(pbmpm_allocator, size), FIELD(pbmpm_allocator, allocate), FIELD(pbmpm_allocator, release), FIELD(pbmpm_allocator, user),
    WHOLE(pbmpm_task_hooks),
    FIELD(pbmpm_task_hooks, size), FIELD(pbmpm_task_hooks, nests), FIELD(pbmpm_task_hooks, enqueue), FIELD(pbmpm_task_hooks, finish), FIELD(pbmpm_task_hooks, user),
    WHOLE(pbmpm_layout_entry),
    FIELD(pbmpm_layout_entry, structure), FIELD(pbmpm_layout_entry, field), FIELD(pbmpm_layout_entry, offset),
    FIELD(pbmpm_layout_entry, size),
    WHOLE(pbmpm_shape),
    FIELD(pbmpm_shape, size), FIELD(pbmpm_shape, kind), FIELD(pbmpm_shape, position), FIELD(pbmpm_shape, rotation),
    FIELD(pbmpm_shape, half_extents), FIELD(pbmpm_shape, radius), FIELD(pbmpm_shape, normal), FIELD(pbmpm_shape, baked),
    WHOLE(pbmpm_world_def),
    FIELD(pbmpm_world_def, size), FIELD(pbmpm_world_def, dimension), FIELD(pbmpm_world_def, cell_size),
    FIELD(pbmpm_world_def, particle_capacity), FIELD(pbmpm_world_def, origin), FIELD(pbmpm_world_def, memory_budget),
    FIELD(pbmpm_world_def, thread_count), FIELD(pbmpm_world_def, domain_enabled), FIELD(pbmpm_world_def, domain_min),
    FIELD(pbmpm_world_def, domain_max), FIELD(pbmpm_world_def, domain_friction), FIELD(pbmpm_world_def, allocator),
    FIELD(pbmpm_world_def, tasks), FIELD(pbmpm_world_def, domain_measures_impulse), FIELD(pbmpm_world_def, user_data),
    WHOLE(pbmpm_settings),
    FIELD(pbmpm_settings, size), FIELD(pbmpm_settings, substeps), FIELD(pbmpm_settings, iterations), FIELD(pbmpm_settings, gravity),
    FIELD(pbmpm_settings, max_displacement), FIELD(pbmpm_settings, solver), FIELD(pbmpm_settings, pressure),
    FIELD(pbmpm_settings, integrator), FIELD(pbmpm_settings, flip), FIELD(pbmpm_settings, target_error),
    FIELD(pbmpm_settings, time_budget_ms),
    FIELD(pbmpm_settings, sleeping),
    FIELD(pbmpm_settings, sleep_speed),
    FIELD(pbmpm_settings, sleep_time),
    WHOLE(pbmpm_material_def),
    FIELD(pbmpm_material_def, size), FIELD(pbmpm_material_def, kind), FIELD(pbmpm_material_def, density),
    FIELD(pbmpm_material_def, relaxation), FIELD(pbmpm_material_def, viscosity), FIELD(pbmpm_material_def, volume_feedback),
    FIELD(pbmpm_material_def, elasticity_ratio), FIELD(pbmpm_material_def, strain_policy), FIELD(pbmpm_material_def, strain_min),
    FIELD(pbmpm_material_def, strain_max), FIELD(pbmpm_material_def, condition_max), FIELD(pbmpm_material_def, rebound_max),
    FIELD(pbmpm_material_def, bulk_modulus), FIELD(pbmpm_material_def, kinematic_viscosity), FIELD(pbmpm_material_def, elastic_model),
    FIELD(pbmpm_material_def, young_modulus), FIELD(pbmpm_material_def, poisson_ratio), FIELD(pbmpm_material_def, friction_angle),
    FIELD(pbmpm_material_def, cohesion), FIELD(pbmpm_material_def, volume_correction), FIELD(pbmpm_material_def, yield_strain),
    FIELD(pbmpm_material_def, flow_rate), FIELD(pbmpm_material_def, key), FIELD(pbmpm_material_def, user_data),
    FIELD(pbmpm_material_def, groups), FIELD(pbmpm_material_def, reserved),
    WHOLE(pbmpm_effective),
    FIELD(pbmpm_effective, size), FIELD(pbmpm_effective, bulk_modulus), FIELD(pbmpm_effective, young_modulus),
    FIELD(pbmpm_effective, kinematic_viscosity), FIELD(pbmpm_effective, courant),
    WHOLE(pbmpm_particles_def),
    FIELD(pbmpm_particles_def, size), FIELD(pbmpm_particles_def, count), FIELD(pbmpm_particles_def, material),
    FIELD(pbmpm_particles_def, positions), FIELD(pbmpm_particles_def, velocities), FIELD(pbmpm_particles_def, volumes),
    FIELD(pbmpm_particles_def, volume), FIELD(pbmpm_particles_def, user_values),
    WHOLE(pbmpm_copy_def),
    FIELD(pbmpm_copy_def, size), FIELD(pbmpm_copy_def, stride), FIELD(pbmpm_copy_def, alpha), FIELD(pbmpm_copy_def, field_count),
    FIELD(pbmpm_copy_def, fields), FIELD(pbmpm_copy_def, pads_vectors), FIELD(pbmpm_copy_def, offset),
    WHOLE(pbmpm_fill_def),
    FIELD(pbmpm_fill_def, size), FIELD(pbmpm_fill_def, seed), FIELD(pbmpm_fill_def, material),
    FIELD(pbmpm_fill_def, particles_per_axis), FIELD(pbmpm_fill_def, jitter), FIELD(pbmpm_fill_def, velocity), FIELD(pbmpm_fill_def, user_value),
    WHOLE(pbmpm_view),
    FIELD(pbmpm_view, size), FIELD(pbmpm_view, count), FIELD(pbmpm_view, components), FIELD(pbmpm_view, component_stride),
    FIELD(pbmpm_view, stride), FIELD(pbmpm_view, data), FIELD(pbmpm_view, generation),
    WHOLE(pbmpm_region_share),
    FIELD(pbmpm_region_share, size), FIELD(pbmpm_region_share, material), FIELD(pbmpm_region_share, count), FIELD(pbmpm_region_share, mass),
    FIELD(pbmpm_region_share, volume), FIELD(pbmpm_region_share, rest_volume),
    WHOLE(pbmpm_surface_def),
    FIELD(pbmpm_surface_def, size), FIELD(pbmpm_surface_def, subdivision), FIELD(pbmpm_surface_def, materials), FIELD(pbmpm_surface_def, material_count),
    FIELD(pbmpm_surface_def, level), FIELD(pbmpm_surface_def, keeps_thin), FIELD(pbmpm_surface_def, index_bytes),
    WHOLE(pbmpm_surface_mesh),
    FIELD(pbmpm_surface_mesh, size), FIELD(pbmpm_surface_mesh, stride), FIELD(pbmpm_surface_mesh, positions), FIELD(pbmpm_surface_mesh, normals),
    FIELD(pbmpm_surface_mesh, velocities), FIELD(pbmpm_surface_mesh, weights), FIELD(pbmpm_surface_mesh, indices), FIELD(pbmpm_surface_mesh, vertex_capacity),
    FIELD(pbmpm_surface_mesh, index_capacity), FIELD(pbmpm_surface_mesh, vertex_count), FIELD(pbmpm_surface_mesh, index_count),
    WHOLE(pbmpm_point),
    FIELD(pbmpm_point, position), FIELD(pbmpm_point, radius), FIELD(pbmpm_point, velocity), FIELD(pbmpm_point, colour),
    WHOLE(pbmpm_points_def),
    FIELD(pbmpm_points_def, size), FIELD(pbmpm_points_def, material_count), FIELD(pbmpm_points_def, materials), FIELD(pbmpm_points_def, palette),
    FIELD(pbmpm_points_def, colour_from_user), FIELD(pbmpm_points_def, radius_scale), FIELD(pbmpm_points_def, spray_only), FIELD(pbmpm_points_def, reserved),
    WHOLE(pbmpm_ray),
    FIELD(pbmpm_ray, size), FIELD(pbmpm_ray, level), FIELD(pbmpm_ray, origin), FIELD(pbmpm_ray, direction),
    FIELD(pbmpm_ray, max_distance),
    WHOLE(pbmpm_ray_hit),
    FIELD(pbmpm_ray_hit, size), FIELD(pbmpm_ray_hit, hit), FIELD(pbmpm_ray_hit, distance), FIELD(pbmpm_ray_hit, position),
    FIELD(pbmpm_ray_hit, normal), FIELD(pbmpm_ray_hit, material), FIELD(pbmpm_ray_hit, particle),
    WHOLE(pbmpm_collider_def),
    FIELD(pbmpm_collider_def, size), FIELD(pbmpm_collider_def, friction), FIELD(pbmpm_collider_def, friction_coefficient),
    FIELD(pbmpm_collider_def, kinematic), FIELD(pbmpm_collider_def, measures_impulse), FIELD(pbmpm_collider_def, meets),
    FIELD(pbmpm_collider_def, key),
    FIELD(pbmpm_collider_def, user_data),
    WHOLE(pbmpm_domain_wall),
    FIELD(pbmpm_domain_wall, size), FIELD(pbmpm_domain_wall, open), FIELD(pbmpm_domain_wall, friction),
    FIELD(pbmpm_domain_wall, friction_coefficient),
    FIELD(pbmpm_collider_def, sensor), FIELD(pbmpm_collider_def, reports_touches),
    WHOLE(pbmpm_touch),
    FIELD(pbmpm_touch, size), FIELD(pbmpm_touch, state), FIELD(pbmpm_touch, collider), FIELD(pbmpm_touch, material),
    FIELD(pbmpm_touch, particles), FIELD(pbmpm_touch, reserved), FIELD(pbmpm_touch, impulse),
    WHOLE(pbmpm_line),
    FIELD(pbmpm_line, from), FIELD(pbmpm_line, to), FIELD(pbmpm_line, part),
    WHOLE(pbmpm_impulse),
    FIELD(pbmpm_impulse, size), FIELD(pbmpm_impulse, linear), FIELD(pbmpm_impulse, angular),
    WHOLE(pbmpm_mass_properties),
    FIELD(pbmpm_mass_properties, size), FIELD(pbmpm_mass_properties, reserved), FIELD(pbmpm_mass_properties, volume), FIELD(pbmpm_mass_properties, mass), FIELD(pbmpm_mass_properties, centre), FIELD(pbmpm_mass_properties, inertia), FIELD(pbmpm_mass_properties, products),
    WHOLE(pbmpm_submersion),
    FIELD(pbmpm_submersion, size), FIELD(pbmpm_submersion, reserved), FIELD(pbmpm_submersion, share), FIELD(pbmpm_submersion, volume), FIELD(pbmpm_submersion, centre), FIELD(pbmpm_submersion, density),
    WHOLE(pbmpm_rigid_def),
    FIELD(pbmpm_rigid_def, size), FIELD(pbmpm_rigid_def, stays_inside), FIELD(pbmpm_rigid_def, moves), FIELD(pbmpm_rigid_def, turns), FIELD(pbmpm_rigid_def, mass), FIELD(pbmpm_rigid_def, centre), FIELD(pbmpm_rigid_def, inertia), FIELD(pbmpm_rigid_def, products), FIELD(pbmpm_rigid_def, pivot), FIELD(pbmpm_rigid_def, move_axis), FIELD(pbmpm_rigid_def, turn_axis), FIELD(pbmpm_rigid_def, force), FIELD(pbmpm_rigid_def, torque),
    WHOLE(pbmpm_rigid_state),
    FIELD(pbmpm_rigid_state, size), FIELD(pbmpm_rigid_state, reserved), FIELD(pbmpm_rigid_state, position), FIELD(pbmpm_rigid_state, rotation), FIELD(pbmpm_rigid_state, velocity), FIELD(pbmpm_rigid_state, angular_velocity), FIELD(pbmpm_rigid_state, velocity_change), FIELD(pbmpm_rigid_state, angular_velocity_change), FIELD(pbmpm_rigid_state, point), FIELD(pbmpm_rigid_state, virtual_mass),
    WHOLE(pbmpm_baked_id),
    FIELD(pbmpm_baked_id, index), FIELD(pbmpm_baked_id, generation),
    WHOLE(pbmpm_mesh_def),
    FIELD(pbmpm_mesh_def, size), FIELD(pbmpm_mesh_def, dimension), FIELD(pbmpm_mesh_def, vertices), FIELD(pbmpm_mesh_def, elements),
    FIELD(pbmpm_mesh_def, vertex_count), FIELD(pbmpm_mesh_def, element_count), FIELD(pbmpm_mesh_def, resolution),
    WHOLE(pbmpm_heights_def),
    FIELD(pbmpm_heights_def, size), FIELD(pbmpm_heights_def, dimension), FIELD(pbmpm_heights_def, up), FIELD(pbmpm_heights_def, resolution),
    FIELD(pbmpm_heights_def, count), FIELD(pbmpm_heights_def, spacing), FIELD(pbmpm_heights_def, heights), FIELD(pbmpm_heights_def, thickness),
    WHOLE(pbmpm_baked_info),
    FIELD(pbmpm_baked_info, size), FIELD(pbmpm_baked_info, dimension), FIELD(pbmpm_baked_info, count), FIELD(pbmpm_baked_info, spacing),
    FIELD(pbmpm_baked_info, minimum), FIELD(pbmpm_baked_info, maximum), FIELD(pbmpm_baked_info, bytes),
    WHOLE(pbmpm_stats),
    FIELD(pbmpm_stats, size), FIELD(pbmpm_stats, particle_count), FIELD(pbmpm_stats, step_count), FIELD(pbmpm_stats, simulated_seconds),
    FIELD(pbmpm_stats, memory_bytes), FIELD(pbmpm_stats, particle_blocks), FIELD(pbmpm_stats, node_blocks), FIELD(pbmpm_stats, contacts),
    FIELD(pbmpm_stats, substeps), FIELD(pbmpm_stats, iterations), FIELD(pbmpm_stats, thread_count), FIELD(pbmpm_stats, ms_total),
    FIELD(pbmpm_stats, ms_sort), FIELD(pbmpm_stats, ms_scatter), FIELD(pbmpm_stats, ms_contacts), FIELD(pbmpm_stats, ms_iterate),
    FIELD(pbmpm_stats, ms_integrate), FIELD(pbmpm_stats, volume_error_rms), FIELD(pbmpm_stats, volume_error_max),
    FIELD(pbmpm_stats, max_speed), FIELD(pbmpm_stats, max_displacement), FIELD(pbmpm_stats, mass), FIELD(pbmpm_stats, momentum),
    FIELD(pbmpm_stats, angular_momentum), FIELD(pbmpm_stats, kinetic_energy), FIELD(pbmpm_stats, potential_energy),
    FIELD(pbmpm_stats, cell_changes), FIELD(pbmpm_stats, lane_occupancy), FIELD(pbmpm_stats, deleted_total),
    FIELD(pbmpm_stats, clamped_total), FIELD(pbmpm_stats, solver), FIELD(pbmpm_stats, stop), FIELD(pbmpm_stats, iterations_used),
    FIELD(pbmpm_stats, residual), FIELD(pbmpm_stats, predicted_error), FIELD(pbmpm_stats, energy_checks_failed),
    FIELD(pbmpm_stats, particles_asleep),
    FIELD(pbmpm_stats, blocks_asleep),
    FIELD(pbmpm_stats, blocks_drowsy),
    FIELD(pbmpm_stats, blocks_woken),
    WHOLE(pbmpm_event),
    FIELD(pbmpm_event, size), FIELD(pbmpm_event, kind), FIELD(pbmpm_event, count), FIELD(pbmpm_event, particle), FIELD(pbmpm_event, position),
    FIELD(pbmpm_event, substep), FIELD(pbmpm_event, step),
    WHOLE(pbmpm_emitter_id),
    FIELD(pbmpm_emitter_id, index), FIELD(pbmpm_emitter_id, generation),
    WHOLE(pbmpm_drain_id),
    FIELD(pbmpm_drain_id, index), FIELD(pbmpm_drain_id, generation),
    WHOLE(pbmpm_force_id),
    FIELD(pbmpm_force_id, index), FIELD(pbmpm_force_id, generation),
    WHOLE(pbmpm_emitter_def),
    FIELD(pbmpm_emitter_def, size), FIELD(pbmpm_emitter_def, seed), FIELD(pbmpm_emitter_def, material),
    FIELD(pbmpm_emitter_def, region), FIELD(pbmpm_emitter_def, enabled),
    FIELD(pbmpm_emitter_def, rate), FIELD(pbmpm_emitter_def, speed), FIELD(pbmpm_emitter_def, direction),
    FIELD(pbmpm_emitter_def, spread), FIELD(pbmpm_emitter_def, particles_per_axis), FIELD(pbmpm_emitter_def, fill_limit),
    FIELD(pbmpm_emitter_def, budget), FIELD(pbmpm_emitter_def, key), FIELD(pbmpm_emitter_def, user_data),
    FIELD(pbmpm_emitter_def, user_value), FIELD(pbmpm_emitter_def, reserved),
    WHOLE(pbmpm_emitter_status),
    FIELD(pbmpm_emitter_status, size), FIELD(pbmpm_emitter_status, reserved), FIELD(pbmpm_emitter_status, emitted),
    FIELD(pbmpm_emitter_status, emitted_mass), FIELD(pbmpm_emitter_status, refused_full),
    FIELD(pbmpm_emitter_status, refused_budget), FIELD(pbmpm_emitter_status, refused_capacity),
    WHOLE(pbmpm_drain_def),
    FIELD(pbmpm_drain_def, size), FIELD(pbmpm_drain_def, enabled), FIELD(pbmpm_drain_def, material),
    FIELD(pbmpm_drain_def, key), FIELD(pbmpm_drain_def, user_data),
    WHOLE(pbmpm_drain_status),
    FIELD(pbmpm_drain_status, size), FIELD(pbmpm_drain_status, reserved), FIELD(pbmpm_drain_status, drained),
    FIELD(pbmpm_drain_status, drained_mass),
    WHOLE(pbmpm_kill_bounds),
    FIELD(pbmpm_kill_bounds, size), FIELD(pbmpm_kill_bounds, enabled), FIELD(pbmpm_kill_bounds, low),
    FIELD(pbmpm_kill_bounds, high),
    WHOLE(pbmpm_flow),
    FIELD(pbmpm_flow, size), FIELD(pbmpm_flow, reserved), FIELD(pbmpm_flow, emitted), FIELD(pbmpm_flow, refused),
    FIELD(pbmpm_flow, drained), FIELD(pbmpm_flow, killed), FIELD(pbmpm_flow, emitted_mass), FIELD(pbmpm_flow, drained_mass),
    FIELD(pbmpm_flow, killed_mass),
    WHOLE(pbmpm_force_def),
    FIELD(pbmpm_force_def, size), FIELD(pbmpm_force_def, kind), FIELD(pbmpm_force_def, enabled),
    FIELD(pbmpm_force_def, everywhere), FIELD(pbmpm_force_def, falloff),
    FIELD(pbmpm_force_def, range), FIELD(pbmpm_force_def, strength), FIELD(pbmpm_force_def, direction),
    FIELD(pbmpm_force_def, velocity), FIELD(pbmpm_force_def, spin), FIELD(pbmpm_force_def, key), FIELD(pbmpm_force_def, user_data),
    WHOLE(pbmpm_force_status),
    FIELD(pbmpm_force_status, size), FIELD(pbmpm_force_status, nodes), FIELD(pbmpm_force_status, impulse),
    WHOLE(pbmpm_advice),
    FIELD(pbmpm_advice, size), FIELD(pbmpm_advice, code), FIELD(pbmpm_advice, material), FIELD(pbmpm_advice, collider),
    FIELD(pbmpm_advice, figure), FIELD(pbmpm_advice, bound), FIELD(pbmpm_advice, change), FIELD(pbmpm_advice, value),
    FIELD(pbmpm_advice, price), FIELD(pbmpm_advice, came_true), FIELD(pbmpm_advice, text),
};
enum { EXPECTED = sizeof expected / sizeof *expected };

static const pbmpm_layout_entry *table;
static uint32_t table_count;

void setUp(void)
{
    OK(pbmpm_layout_table(&table, &table_count));
}

void tearDown(void)
{
}

static const pbmpm_layout_entry *find(const pbmpm_layout_entry *rows, uint32_t count, const pbmpm_layout_entry *wanted)
{
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(rows[i].structure, wanted->structure) == 0 && strcmp(rows[i].field, wanted->field) == 0)
            return &rows[i];
    return NULL;
}

static void test_every_field_is_where_the_header_says(void)
{
    for (uint32_t i = 0; i < EXPECTED; i++) {
        char label[128];
        const pbmpm_layout_entry *row = find(table, table_count, &expected[i]);
        snprintf(label, sizeof label, "%s.%s", expected[i].structure, expected[i].field);
        TEST_ASSERT_NOT_NULL_MESSAGE(row, label);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(expected[i].offset, row->offset, label);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(expected[i].size, row->size, label);
    }
}

static void test_the_table_has_nothing_else(void)
{
    for (uint32_t i = 0; i < table_count; i++) {
        char label[128];
        snprintf(label, sizeof label, "%s.%s", table[i].structure, table[i].field);
        TEST_ASSERT_NOT_NULL_MESSAGE(find(expected, EXPECTED, &table[i]), label);
    }
    TEST_ASSERT_EQUAL_UINT32(EXPECTED, table_count); /* no row twice */
}

/* Bindings pass identifiers by value and rely on these sizes. */
static void test_sizes_that_bindings_rely_on(void)
{
    TEST_ASSERT_EQUAL_UINT64(8, sizeof(pbmpm_world_id));
    TEST_ASSERT_EQUAL_UINT64(8, sizeof(pbmpm_material_id));
    TEST_ASSERT_EQUAL_UINT64(8, sizeof(pbmpm_collider_id));
    TEST_ASSERT_EQUAL_UINT64(8, sizeof(pbmpm_particle_id));
    TEST_ASSERT_EQUAL_UINT64(8, sizeof(pbmpm_emitter_id));
    TEST_ASSERT_EQUAL_UINT64(8, sizeof(pbmpm_drain_id));
    TEST_ASSERT_EQUAL_UINT64(8, sizeof(pbmpm_force_id));
    TEST_ASSERT_EQUAL_UINT64(4, sizeof(pbmpm_result));
    TEST_ASSERT_EQUAL_UINT64(4, sizeof(pbmpm_field));
    TEST_ASSERT_EQUAL_UINT64(4, sizeof(pbmpm_shape_kind));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_field_is_where_the_header_says);
    RUN_TEST(test_the_table_has_nothing_else);
    RUN_TEST(test_sizes_that_bindings_rely_on);
    return UNITY_END();
}
