/* The fields of the structures that C and ISPC share, in order; read by both languages. */
#define KERNEL_MATERIAL_FIELDS(FIELD)                                                                                          \
    FIELD(kind) FIELD(relaxation) FIELD(viscosity) FIELD(volume_feedback) FIELD(elasticity_ratio) FIELD(strain_min)           \
    FIELD(strain_max) FIELD(condition_max) FIELD(rebound_max) FIELD(pressure_max) FIELD(volume_share) FIELD(even_share) FIELD(inverse_density)  \
    FIELD(elastic_model) FIELD(shear) FIELD(dilation) FIELD(inverse_stiffness) FIELD(carried) FIELD(pascal) FIELD(lightness) FIELD(viscous_share) \
    FIELD(yields) FIELD(friction) FIELD(cohesion) FIELD(looseness) FIELD(bulk_over_shear) FIELD(yield_strain) FIELD(excess_kept)

#define KERNEL_ARGS_FIELDS(FIELD)                                                                                             \
    FIELD(fraction) FIELD(cell) FIELD(velocity) FIELD(affine) FIELD(volume_ratio) FIELD(mass) FIELD(deformation)      \
    FIELD(identity) FIELD(past_velocity) FIELD(past_affine) FIELD(past_way) FIELD(past_turn) FIELD(past_dt) FIELD(status) FIELD(run_begin) FIELD(run_key) FIELD(block_run) FIELD(neighbour) FIELD(particle_blocks) FIELD(tile) FIELD(tile_volume)   \
    FIELD(node) FIELD(node_base) FIELD(node_before) FIELD(node_volume) FIELD(node_density) FIELD(node_reach) FIELD(edged) FIELD(clamped) FIELD(moved) FIELD(lost) FIELD(travel) FIELD(drift) FIELD(pressure) FIELD(pressure_old) FIELD(stress) FIELD(stress_old) FIELD(node_push) \
    FIELD(change2) FIELD(uphill) FIELD(node_force) FIELD(block_share) FIELD(affine_kept) FIELD(block_energy) FIELD(couple) FIELD(among_liquid) FIELD(fed) FIELD(may_feed) FIELD(held_pressure) FIELD(sketch) FIELD(held_stiffness) FIELD(node_gap) FIELD(cell_mass) FIELD(cell_growth) FIELD(cell_strain) FIELD(settle) FIELD(elastic_guesses) FIELD(cell_softness) \
    FIELD(cell_pressure) FIELD(cell_pressure_old) FIELD(cell_trace) FIELD(cell_change2) FIELD(cell_uphill) FIELD(probing) FIELD(cell_relaxation) FIELD(stage_last) FIELD(stage_before) \
    FIELD(stage_change) FIELD(momentum) FIELD(fine_carried) FIELD(grains_carried) FIELD(grains_free) FIELD(crushed_carried) FIELD(growth_max) FIELD(material) FIELD(iterations) FIELD(flip) FIELD(feedback_way) FIELD(quiet_way) FIELD(dt) \
    FIELD(cells_per_metre) FIELD(gravity) FIELD(max_displacement) FIELD(max_cell) FIELD(salt) FIELD(check_strain)

/* The table a probe writes: the size of the structure, then offset and size of each field. */
enum { LAYOUT_VALUES = 1 + 2 * 128 };
