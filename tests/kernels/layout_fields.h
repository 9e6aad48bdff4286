/* The fields of the structures that C and ISPC share, in order; read by both languages. */
#define KERNEL_MATERIAL_FIELDS(FIELD)                                                                                          \
    FIELD(kind) FIELD(relaxation) FIELD(viscosity) FIELD(volume_feedback) FIELD(elasticity_ratio) FIELD(strain_min)           \
    FIELD(strain_max) FIELD(condition_max) FIELD(rebound_max) FIELD(growth_max) FIELD(head2) FIELD(pressure_max) FIELD(volume_share) FIELD(even_share) FIELD(inverse_density)  \
    FIELD(elastic_model) FIELD(shear) FIELD(dilation) FIELD(inverse_stiffness) FIELD(multiplier_per_pascal) FIELD(pascal_per_multiplier) FIELD(lightness) FIELD(viscous_share) \
    FIELD(yields) FIELD(friction) FIELD(cohesion) FIELD(looseness) FIELD(bulk_over_shear) FIELD(yield_strain) FIELD(excess_kept)

#define KERNEL_ARGS_FIELDS(FIELD)                                                                                             \
    FIELD(particles.fraction) FIELD(particles.cell) FIELD(particles.velocity) FIELD(particles.affine)                         \
    FIELD(particles.volume_ratio) FIELD(particles.mass) FIELD(particles.deformation) FIELD(particles.identity)                \
    FIELD(particles.past_velocity) FIELD(particles.past_affine) FIELD(particles.past_way) FIELD(particles.past_turn)          \
    FIELD(particles.past_dt) FIELD(particles.status) FIELD(grid.run_begin) FIELD(grid.run_key) FIELD(grid.block_run)          \
    FIELD(grid.neighbour) FIELD(grid.tile) FIELD(grid.tile_volume) FIELD(grid.node) FIELD(grid.node_base)                     \
    FIELD(grid.node_before) FIELD(grid.node_volume) FIELD(grid.node_density) FIELD(grid.node_reach) FIELD(grid.edged)         \
    FIELD(grid.clamped) FIELD(grid.moved) FIELD(grid.lost) FIELD(grid.travel) FIELD(grid.drift)                               \
    FIELD(grid.particle_blocks) FIELD(dual.pressure) FIELD(dual.pressure_old) FIELD(dual.second_order) FIELD(dual.stress) FIELD(dual.stress_old)       \
    FIELD(dual.node_push) FIELD(dual.change2) FIELD(dual.uphill) FIELD(dual.affine_kept) FIELD(dual.stage_last)               \
    FIELD(dual.stage_before) FIELD(dual.stage_change) FIELD(dual.momentum) FIELD(dual.fine_carried)                           \
    FIELD(dual.grains_carried) FIELD(dual.crushed_carried) FIELD(dual.growth_max) FIELD(primal.node_force)                    \
    FIELD(primal.block_share) FIELD(primal.block_energy) FIELD(primal.couple) FIELD(primal.among_liquid)                      \
    FIELD(primal.void_room) FIELD(primal.fed) FIELD(primal.held_pressure) FIELD(primal.sketch) FIELD(primal.node_gap) FIELD(primal.may_feed)          \
    FIELD(primal.held_stiffness) FIELD(cells.mass) FIELD(cells.growth) FIELD(cells.solid_growth)                             \
    FIELD(cells.second_order) FIELD(cells.softness)                                                                           \
    FIELD(cells.pressure) FIELD(cells.pressure_old) FIELD(cells.trace) FIELD(cells.change2) FIELD(cells.uphill)               \
    FIELD(cells.settle) FIELD(cells.elastic_guesses) FIELD(cells.probing) FIELD(cells.relaxation) FIELD(material)             \
    FIELD(iterations) FIELD(flip) FIELD(feedback_way) FIELD(quiet_way) FIELD(dt) FIELD(cells_per_metre) FIELD(gravity)        \
    FIELD(max_displacement) FIELD(max_cell) FIELD(salt) FIELD(check_strain)

/* The table a probe writes: the size of the structure, then offset and size of each field. */
enum { LAYOUT_VALUES = 1 + 2 * 128 };
