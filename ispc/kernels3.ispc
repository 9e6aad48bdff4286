// The 3D kernels. Bodies: kernels.isph.
#define DIM 3
#include "kernels.isph"
#include "cells.isph"
#include "viscosity.isph"
#include "primal.isph"
#include "flight.isph"

export void scatter3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    scatter_blocks(*args, begin, end);
}
export void predict_nodes3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    predict_node_blocks(*args, begin, end);
}
export void iterate3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    iterate_blocks(*args, begin, end);
}
export void update_nodes3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    update_node_blocks(*args, begin, end);
}
export void integrate3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    integrate_blocks(*args, begin, end);
}
export void fly3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    fly_blocks(*args, begin, end);
}
export void drift3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    drift_blocks(*args, begin, end);
}
export void dual_begin3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    dual_begin_blocks(*args, begin, end);
}
export void dual_iterate3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    dual_iterate_blocks(*args, begin, end);
}
export void push_nodes3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    push_node_blocks(*args, begin, end);
}
export void cells_begin3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_begin_blocks(*args, begin, end);
}
export void cells_mean3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_mean_blocks(*args, begin, end);
}
export void solids_begin3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    solids_begin_blocks(*args, begin, end);
}
export void solids_mean3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    solids_mean_blocks(*args, begin, end);
}
export void cells_push3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_push_blocks(*args, begin, end);
}
export void cells_carry3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_carry_blocks(*args, begin, end);
}
export void cells_add3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_add_blocks(*args, begin, end);
}
export void cells_trace3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_trace_blocks(*args, begin, end);
}
export void second_order3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    second_order_blocks(*args, begin, end);
}
export void cells_update3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_update_blocks(*args, begin, end);
}
export void viscous3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    viscous_blocks(*args, begin, end);
}
export void viscous_nodes3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    viscous_node_blocks(*args, begin, end);
}
export void respond_nodes3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    respond_node_blocks(*args, begin, end);
}
export void cells_respond3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    cells_respond_blocks(*args, begin, end);
}
export void force_first3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    force_first_blocks(*args, begin, end);
}
export void force3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    force_blocks(*args, begin, end);
}
export void force_nodes3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    force_node_blocks(*args, begin, end);
}
export void hold_pressure3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    hold_pressure_blocks(*args, begin, end);
}
export void end_sketch3(uniform struct KernelArgs *uniform args, uniform int begin, uniform int end) {
    end_sketch_blocks(*args, begin, end);
}
